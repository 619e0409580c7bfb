#pragma once

#include <optional>
#include <string>

#include "viewer/images/image.h"

namespace lightwell {

/// How a photometric picture becomes a false-colour picture.
struct FalseColour {
    /// The value at the top of the ramp, in the picture's unit, positive; automatic_maximum() where
    /// it is not given.
    std::optional<double> maximum;
    /// Parts of the ramp between numbers of the legend, and between contours, at least 1. Where it
    /// is not given: 8, or 10 if only that gives numbers of at most two digits (and zeros).
    std::optional<int> divisions;
    /// Draw a line where the value passes a number of the legend.
    bool contours = false;
    /// Draw the ramp with its numbers over the left of the picture.
    bool legend = true;
    std::string unit = "lx";  ///< for the legend; see draw_text for the letters there are
};

/// The ramp from t = 0, dark violet, over blue, teal and green to t = 1, light yellow, as linear
/// Rec. 709 in [0,1]; t outside counts as the nearer end. Lightness rises evenly with t, so the
/// order can be read in grey and by the colour-blind. It is a curve in Oklab (Ottosson 2020).
Image::Pixel ramp_colour(double t);

/// A round number (1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of ten) that is not below the luminance
/// of 95 % of the pixels that have a positive finite one; 1 if there are none. The brightest
/// twentieth, around lamps, is left out because it would darken all the rest.
double automatic_maximum(const Image& light);

/// Maps the luminance of every pixel, from 0 to the maximum, to the ramp. The result is the linear
/// light of a display in [0,1], ready for write_png. Non-finite pixels stay so, to be counted
/// there. The legend is left out where the picture is too small to hold it.
Image false_coloured(const Image& light, const FalseColour& style);

}  // namespace lightwell
