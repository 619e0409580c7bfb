#pragma once

namespace lightwell {

/// What a frame shows.
enum class Picture {
    total,         ///< luminance with all light [cd/m2]
    direct,        ///< luminance with direct light alone [cd/m2]
    indirect,      ///< luminance with indirect light alone, lamps dark [cd/m2]
    lux,           ///< illuminance [lx], as false colours
    level,         ///< the wavelet mesh: the finest cells, coloured by their level
    coefficients,  ///< coefficients of the operator that end on each side of a quad
    difference     ///< relative difference of the illuminance to that by the exact product
};

/// The rows of a picture to draw, of its height: a picture that takes long is drawn from below in
/// several parts, so that nobody waits for all of it.
struct PictureRows {
    double from = 0, to = 1;
};

/// How a frame is shown.
struct FrameView {
    Picture picture = Picture::total;
    double exposure = 0;     ///< EV: luminance is multiplied by 2^exposure before the tone curve
    bool tone_curve = true;  ///< the filmic curve, or what exceeds 1 is cut off
    bool bilinear = true;    ///< indirect light between the centres of texels, or texel by texel
    int samples = 1;         ///< a side in every pixel, 1 to 4: samples^2 are averaged
    /// Pixels a side that share one sample, 1 to 8, for a quick look while things move; with more
    /// than 1 `samples` must be 1.
    int coarseness = 1;
    double lux_maximum = 1000;       ///< illuminance at the top of the ramp [lx], positive
    int lux_divisions = 10;          ///< parts of the ramp between contour lines, at least 1
    bool contours = true;            ///< contour lines in Picture::lux
    double difference_range = 0.05;  ///< difference that has full colour, positive
};

}  // namespace lightwell
