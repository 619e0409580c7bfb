#pragma once

#include "viewer/images/image.h"

namespace lightwell {

/// The curve from exposed light to the light of a display.
enum class ToneCurve {
    clip,   ///< as it is; what exceeds 1 is cut off
    filmic  ///< see filmic()
};

/// How light becomes a picture for a display.
struct Development {
    double exposure = 0;  ///< EV: light is multiplied by 2^exposure; any finite number
    ToneCurve curve = ToneCurve::filmic;
};

/// A filmic curve from [0,inf) to [0,1): a soft toe, a nearly straight middle and a shoulder that
/// holds highlights, x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), cut at 1. Source: Narkowicz
/// 2016, "ACES filmic tone mapping curve", a fit to the reference rendering of the Academy Color
/// Encoding System. Negative light counts as none.
double filmic(double light);

/// The sRGB transfer function (IEC 61966-2-1) from linear [0,1] to [0,1]; arguments outside count
/// as the nearer end.
double srgb_encoded(double linear);
/// Its inverse.
double srgb_decoded(double encoded);

/// Exposes the light and bends it by the curve, each channel by itself. The result is the linear
/// light of a display in [0,1], ready for write_png. NaN stays NaN, to be counted there.
Image develop(const Image& light, const Development& development);

/// The exposure [EV] that brings the picture's log-average luminance, taken over its pixels of
/// positive finite luminance, to 0.18, photography's middle grey (Reinhard et al. 2002, eq. 1).
/// 0 for a picture without such a pixel.
double automatic_exposure(const Image& light);

}  // namespace lightwell
