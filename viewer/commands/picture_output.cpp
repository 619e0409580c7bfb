#include "viewer/commands/picture_output.h"

#include <fmt/format.h>

#include "viewer/commands/output.h"
#include "viewer/images/false_colour.h"
#include "viewer/images/image_file.h"
#include "viewer/images/tone.h"

namespace lightwell {

namespace {

const char* unit_of(View view) {
    switch (view) {
        case View::lux:
            return "lx";
        case View::level:
        case View::coefficients:
            return "display";
        default:
            return "cd/m2";
    }
}

}  // namespace

PictureOutput::PictureOutput(View view, double exposure, bool contours)
    : view_(view), exposure_(exposure), contours_(contours) {}

Image PictureOutput::for_display(const Image& light) {
    switch (view_) {
        case View::lux: {
            if (!maximum_) maximum_ = automatic_maximum(light);
            FalseColour style;
            style.maximum = maximum_;
            style.contours = contours_;
            return false_coloured(light, style);
        }
        case View::level:
        case View::coefficients:
            return light;
        default:
            if (!automatic_exposure_) automatic_exposure_ = automatic_exposure(light);
            return develop(light, {*automatic_exposure_ + exposure_, ToneCurve::filmic});
    }
}

void PictureOutput::write(const Image& light, const std::string& path) {
    const WriteReport report = image_format(path) == ImageFormat::png
                                   ? write_png(for_display(light), path)
                                   : write_exr(light, unit_of(view_), path);
    if (report.non_finite_pixels > 0)
        print_message(fmt::format("{}: warning: {} pixels were not finite and are black", path,
                                  report.non_finite_pixels));
}

}  // namespace lightwell
