#include "viewer/images/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "viewer/images/lettering.h"

namespace lightwell {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Linear Rec. 709 of an Oklab colour given by lightness, chroma and hue [degrees].
Image::Pixel from_oklab(double lightness, double chroma, double hue) {
    const double a = chroma * std::cos(hue * pi / 180);
    const double b = chroma * std::sin(hue * pi / 180);
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
    const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
    const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    return Eigen::Array3d(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)
        .cast<float>()
        .max(0.0f)
        .min(1.0f);
}

double round_number_from(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
        if (step * decade >= value) return step * decade;
    return 10 * decade;
}

/// Which part of the ramp a value lies in, for contours.
double part_of(double value, double maximum, int divisions) {
    return std::floor(std::clamp(value / maximum, 0.0, 1.0) * divisions);
}

void draw_contours(Image& picture, const Image& light, double maximum, int divisions) {
    const auto part = [&](int x, int y) {
        return part_of(static_cast<double>(luminance(light.at(x, y))), maximum, divisions);
    };
    for (int y = 0; y + 1 < light.height(); ++y)
        for (int x = 0; x + 1 < light.width(); ++x) {
            if (!light.at(x, y).isFinite().all()) continue;
            const double here = part(x, y);
            if (part(x + 1, y) != here || part(x, y + 1) != here) picture.at(x, y).setZero();
        }
}

/// Whether a number is written with two digits and zeros at most.
bool has_two_digits(double value) {
    const double hundredfold = value / std::pow(10.0, std::floor(std::log10(value)) - 1);
    return std::abs(hundredfold - std::round(hundredfold)) < 1e-9 * hundredfold;
}

int divisions_of(const FalseColour& style, double maximum) {
    if (style.divisions) return *style.divisions;
    return !has_two_digits(maximum / 8) && has_two_digits(maximum / 10) ? 10 : 8;
}

bool exceeds(const Image& light, double maximum) {
    return std::any_of(light.pixels().begin(), light.pixels().end(), [=](const Image::Pixel& p) {
        return static_cast<double>(luminance(p)) > maximum;
    });
}

std::string label(double value) {
    return value >= 10000 ? fmt::format("{:.4g}k", value / 1000) : fmt::format("{:.4g}", value);
}

/// Where the legend's parts lie [pixels]; everything hangs on the size of a letter's dot.
struct LegendLayout {
    int dot;
    int margin, bar_width, bar_height, line_height;
    int text_left, width, height;
};

LegendLayout layout_of(int picture_height, const std::vector<std::string>& numbers,
                       const std::string& unit) {
    std::size_t longest = unit.size();
    for (const std::string& text : numbers)
        longest = std::max(longest, text.size());
    LegendLayout layout;
    layout.dot = std::max(1, picture_height / 360);
    layout.margin = 4 * layout.dot;
    layout.line_height = (glyph_height + 3) * layout.dot;
    layout.bar_width = 12 * layout.dot;
    layout.bar_height = std::max(static_cast<int>(numbers.size()) * layout.line_height,
                                 std::min(picture_height / 2, 250 * layout.dot));
    layout.text_left = 2 * layout.margin + layout.bar_width;
    layout.width =
        layout.text_left + static_cast<int>(longest) * glyph_width * layout.dot + layout.margin;
    layout.height = 2 * layout.margin + 2 * layout.line_height + layout.bar_height;
    return layout;
}

/// Draws the ramp with a number at every tick, from the bottom up, and the unit above.
void draw_legend(Image& picture, const std::vector<std::string>& numbers, const std::string& unit) {
    const int divisions = static_cast<int>(numbers.size()) - 1;
    const LegendLayout at = layout_of(picture.height(), numbers, unit);
    if (at.width > picture.width() || at.height > picture.height()) return;

    const Image::Pixel paper = Image::Pixel::Constant(0.01f);
    const Image::Pixel ink = Image::Pixel::Ones();
    fill_rectangle(picture, 0, 0, at.width, at.height, paper);
    draw_text(picture, at.text_left, at.margin, unit, ink, at.dot);
    const int top = at.margin + at.line_height + at.line_height / 2;
    for (int row = 0; row < at.bar_height; ++row)
        fill_rectangle(picture, at.margin, top + row, at.bar_width, 1,
                       ramp_colour(1 - (row + 0.5) / at.bar_height));
    for (int k = 0; k <= divisions; ++k) {
        const int y = top + at.bar_height - at.bar_height * k / divisions;
        fill_rectangle(picture, at.margin + at.bar_width, y, at.margin / 2, at.dot, ink);
        draw_text(picture, at.text_left, y - glyph_height * at.dot / 2,
                  numbers[static_cast<std::size_t>(k)], ink, at.dot);
    }
}

}  // namespace

Image::Pixel ramp_colour(double t) {
    const double x = std::clamp(t, 0.0, 1.0);
    // Chroma is lowest in the middle, where the display's gamut is narrow (teal).
    const double chroma = 0.095 + 0.075 * (2 * x - 1) * (2 * x - 1);
    return from_oklab(0.28 + 0.65 * x, chroma, 300 - 195 * x);
}

double automatic_maximum(const Image& light) {
    std::vector<float> values;
    for (const Image::Pixel& pixel : light.pixels()) {
        const float value = luminance(pixel);
        if (value > 0 && std::isfinite(value)) values.push_back(value);
    }
    if (values.empty()) return 1;
    // The smallest value that 95 % of the pixels do not exceed.
    const std::size_t rank = (values.size() * 95 + 99) / 100 - 1;
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), nth, values.end());
    return round_number_from(static_cast<double>(*nth));
}

Image false_coloured(const Image& light, const FalseColour& style) {
    const double maximum = style.maximum ? *style.maximum : automatic_maximum(light);
    LIGHTWELL_CHECK_OP(maximum, >, 0);
    const int divisions = divisions_of(style, maximum);
    LIGHTWELL_CHECK_OP(divisions, >=, 1);
    Image picture = light;
    for (Image::Pixel& pixel : picture.pixels())
        if (pixel.isFinite().all())
            pixel = ramp_colour(static_cast<double>(luminance(pixel)) / maximum);
    if (style.contours) draw_contours(picture, light, maximum, divisions);
    if (!style.legend) return picture;
    std::vector<std::string> numbers;
    for (int k = 0; k <= divisions; ++k)
        numbers.push_back(label(maximum * k / divisions));
    if (exceeds(light, maximum)) numbers.back() = ">" + numbers.back();
    draw_legend(picture, numbers, style.unit);
    return picture;
}

}  // namespace lightwell
