#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/precompute.h"
#include "solver/reading/bare_geometry.h"

namespace lightwell {

// What users type after an option, read whole, whatever the locale. Each function throws InputError
// with the option's name and the text where the text is not what the option takes.

/// A finite number.
double number_argument(const std::string& option, const std::string& text);
/// A finite number > 0.
double positive_argument(const std::string& option, const std::string& text);
/// A finite number >= 0.
double non_negative_argument(const std::string& option, const std::string& text);
/// A whole number from `low` to `high`, in decimal.
int whole_argument(const std::string& option, const std::string& text, int low, int high);

/// A relative error in (0, 0.5].
double error_argument(const std::string& option, const std::string& text);
/// "geometric" or "variation".
OracleKind oracle_argument(const std::string& option, const std::string& text);
/// A size in bytes, with the suffix K, M, G or T (powers of 1024, either case, "B" and "iB" may
/// follow): "8G", "512M", "1.5GiB". At least 1 MiB.
std::uint64_t memory_argument(const std::string& option, const std::string& text);

/// A unit of length [m]: "m", "cm", "mm", "in", "ft" or a number of metres, as in a scene file.
double unit_argument(const std::string& option, const std::string& text);
/// The axis "x", "y" or "z".
Vec3 axis_argument(const std::string& option, const std::string& text);
/// What to say of a file of bare geometry to those who gave no --unit or --up; empty if nothing.
std::string assumption_text(const std::string& path, const BareGeometry& bare);

/// Width and height of a picture [pixels], each in [1, 16384].
struct PixelSize {
    int width = 960;
    int height = 720;
};
/// "WIDTHxHEIGHT".
PixelSize size_argument(const std::string& option, const std::string& text);

/// The word of `known` that `word` was most probably meant to be, by the fewest letters inserted,
/// deleted, replaced or swapped with a neighbour; "" where none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace lightwell
