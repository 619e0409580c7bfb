#include "viewer/commands/output.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "solver/reading/reading_report.h"

namespace lightwell {

void print_result(std::string_view text) {
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw SystemError(fmt::format("standard output: cannot write: {}",
                                      std::generic_category().message(errno)));
}

void write_result(const std::string& path, std::string_view text) {
    if (path.empty())
        print_result(text);
    else
        write_atomically(path, text);
}

void require_not_read(const std::string& output, const std::vector<std::string>& read) {
    for (const std::string& one : read) {
        std::error_code error;
        if (std::filesystem::equivalent(output, one, error))
            throw InputError(output + ": is read by this very command; write to another file");
    }
}

void print_message(std::string_view message) {
    fmt::print(stderr, "lightwell: {}\n", message);
}

std::string grouped(std::uint64_t number) {
    return with_separators(static_cast<long long>(number));
}

std::string percent(double fraction) {
    const double value = 100 * fraction;
    // Three digits and more would be written with an exponent.
    return value < 99.5 ? fmt::format("{:.2g} %", value) : fmt::format("{:.0f} %", value);
}

std::string readable_bytes(std::uint64_t bytes) {
    constexpr const char* units[] = {"KiB", "MiB", "GiB"};
    if (bytes < 1024) return fmt::format("{} B", bytes);
    double size = static_cast<double>(bytes) / 1024;
    std::size_t unit = 0;
    for (; size >= 1024 && unit + 1 < std::size(units); ++unit)
        size /= 1024;
    return fmt::format("{:.1f} {}", size, units[unit]);
}

}  // namespace lightwell
