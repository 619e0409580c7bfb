#include "radiance4d/failure.h"

#include <fmt/format.h>

namespace lightwell {

std::string Place::to_string() const {
    if (line <= 0) return file;
    if (column <= 0) return fmt::format("{}:{}", file, line);
    return fmt::format("{}:{}:{}", file, line, column);
}

InputError::InputError(const Place& place, const std::string& message)
    : std::runtime_error(place.file.empty() ? message : place.to_string() + ": " + message) {}

void detail::check_failed(const char* expression, const char* file, int line,
                          const std::string& values) {
    throw BrokenInvariant(fmt::format("{}:{}: broken invariant: {}{}{}", file, line, expression,
                                      values.empty() ? "" : ": ", values));
}

}  // namespace lightwell
