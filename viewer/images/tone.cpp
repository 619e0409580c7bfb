#include "viewer/images/tone.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

double filmic(double light) {
    // Beyond this the curve is cut at 1 anyway; the quotient of infinities would be NaN.
    const double x = std::clamp(light, 0.0, 1e6);
    return std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
}

double srgb_encoded(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

double srgb_decoded(double encoded) {
    const double x = std::clamp(encoded, 0.0, 1.0);
    return x <= 12.92 * 0.0031308 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

Image develop(const Image& light, const Development& development) {
    const double factor = std::exp2(development.exposure);
    Image display = light;
    for (Image::Pixel& pixel : display.pixels())
        for (float& component : pixel) {
            const double exposed = factor * static_cast<double>(component);
            if (std::isnan(exposed)) continue;
            component = static_cast<float>(development.curve == ToneCurve::filmic
                                               ? filmic(exposed)
                                               : std::clamp(exposed, 0.0, 1.0));
        }
    return display;
}

double automatic_exposure(const Image& light) {
    double sum = 0;
    std::size_t count = 0;
    for (const Image::Pixel& pixel : light.pixels()) {
        const double value = static_cast<double>(luminance(pixel));
        if (!(value > 0) || !std::isfinite(value)) continue;
        sum += std::log2(value);
        ++count;
    }
    return count == 0 ? 0 : std::log2(0.18) - sum / static_cast<double>(count);
}

}  // namespace lightwell
