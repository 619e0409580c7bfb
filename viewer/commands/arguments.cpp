#include "viewer/commands/arguments.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "solver/reading/input_file.h"
#include "solver/reading/number_text.h"

namespace lightwell {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& text,
                         const std::string& wanted) {
    throw InputError(Place{option}, fmt::format("{} is not {}", in_quotes(text), wanted));
}

/// Letters to insert, delete, replace or swap with a neighbour on the way from a to b (optimal
/// string alignment).
std::size_t distance_between(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> steps(a.size() + 1,
                                                std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                steps[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = steps[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            steps[i][j] = std::min({replaced, steps[i - 1][j] + 1, steps[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                steps[i][j] = std::min(steps[i][j], steps[i - 2][j - 2] + 1);
        }
    return steps[a.size()][b.size()];
}

}  // namespace

double number_argument(const std::string& option, const std::string& text) {
    return number_from(text, Place{option});
}

double positive_argument(const std::string& option, const std::string& text) {
    const double number = number_argument(option, text);
    if (!(number > 0)) refuse(option, text, "greater than 0");
    return number;
}

double non_negative_argument(const std::string& option, const std::string& text) {
    const double number = number_argument(option, text);
    if (!(number >= 0)) refuse(option, text, "0 or greater");
    return number;
}

int whole_argument(const std::string& option, const std::string& text, int low, int high) {
    const std::int64_t number = whole_number_from(text, Place{option});
    if (number < low || number > high)
        refuse(option, text, fmt::format("a whole number from {} to {}", low, high));
    return static_cast<int>(number);
}

double error_argument(const std::string& option, const std::string& text) {
    const double error = number_argument(option, text);
    if (!(error > 0 && error <= 0.5))
        refuse(option, text, "a relative error greater than 0 and at most 0.5 (0.05 is 5 %)");
    return error;
}

OracleKind oracle_argument(const std::string& option, const std::string& text) {
    if (text == "geometric") return OracleKind::geometric;
    if (text == "variation") return OracleKind::variation;
    refuse(option, text, "an oracle: geometric or variation");
}

std::uint64_t memory_argument(const std::string& option, const std::string& text) {
    constexpr double least = 1 << 20, most = 0x1p62;
    const std::string wanted = "a size of memory, at least 1M (such as 8G or 512M)";
    std::size_t letters = text.size();
    while (letters > 0 && std::isalpha(static_cast<unsigned char>(text[letters - 1])) != 0)
        --letters;
    std::string suffix = text.substr(letters);
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    for (const std::string ending : {"IB", "B"})
        if (suffix.size() == 1 + ending.size() && suffix.substr(1) == ending) suffix.resize(1);
    const std::string units = "KMGT";
    double bytes_per_unit = 1;
    if (!suffix.empty() && suffix != "B") {
        const std::size_t unit = units.find(suffix);
        if (unit == std::string::npos || letters == 0) refuse(option, text, wanted);
        bytes_per_unit = std::exp2(10.0 * static_cast<double>(unit + 1));
    }
    const double bytes = number_argument(option, text.substr(0, letters)) * bytes_per_unit;
    if (!(bytes >= least && bytes <= most)) refuse(option, text, wanted);
    return static_cast<std::uint64_t>(bytes);
}

double unit_argument(const std::string& option, const std::string& text) {
    if (const std::optional<double> metres = metres_in(text)) return *metres;
    const bool is_number = text.find_first_of("0123456789") != std::string::npos;
    const double metres = is_number ? number_argument(option, text) : 0;
    if (!is_unit(metres))
        refuse(option, text, "m, cm, mm, in, ft or a number of metres within 1e-9 and 1e9");
    return metres;
}

Vec3 axis_argument(const std::string& option, const std::string& text) {
    const std::optional<Vec3> axis = axis_called(text);
    if (!axis) refuse(option, text, "x, y or z");
    return *axis;
}

std::string assumption_text(const std::string& path, const BareGeometry& bare) {
    const std::string assumed = assumed_of(path, bare);
    return assumed.empty()
               ? ""
               : fmt::format("{}: assumed that {}; --unit and --up say otherwise", path, assumed);
}

PixelSize size_argument(const std::string& option, const std::string& text) {
    constexpr int longest = 16384;
    const std::size_t cross = text.find_first_of("xX");
    if (cross == std::string::npos) refuse(option, text, "WIDTHxHEIGHT (such as 960x720)");
    return {whole_argument(option, text.substr(0, cross), 1, longest),
            whole_argument(option, text.substr(cross + 1), 1, longest)};
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
    std::string nearest;
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t steps = distance_between(word, candidate);
        if (steps < least) {
            least = steps;
            nearest = candidate;
        }
    }
    return nearest;
}

}  // namespace lightwell
