#include "solver/reading/number_text.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "solver/reading/input_file.h"

namespace lightwell {

namespace {

std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
        text.remove_prefix(1);
    return text;
}

}  // namespace

double number_from(std::string_view text, const Place& place) {
    const std::string_view digits = without_plus(text);
    const char* const end = digits.data() + digits.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error == std::errc::invalid_argument || stop != end)
        throw InputError(place, in_quotes(std::string(text)) + " is not a number");
    if (error == std::errc::result_out_of_range) {
        // from_chars says the same for too large and too small; only a negative exponent can make
        // a number of sensible length too small.
        if (digits.find("e-") == std::string_view::npos &&
            digits.find("E-") == std::string_view::npos)
            throw InputError(place, in_quotes(std::string(text)) + " is too large");
        return 0;
    }
    if (!std::isfinite(value))
        throw InputError(place, in_quotes(std::string(text)) + " is not a finite number");
    return value;
}

std::int64_t whole_number_from(std::string_view text, const Place& place) {
    const std::string_view digits = without_plus(text);
    const char* const end = digits.data() + digits.size();
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error == std::errc::invalid_argument || stop != end)
        throw InputError(place, in_quotes(std::string(text)) + " is not a whole number");
    if (error == std::errc::result_out_of_range)
        throw InputError(place, in_quotes(std::string(text)) + " is too large");
    return value;
}

}  // namespace lightwell
