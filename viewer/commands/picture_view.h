#pragma once

#include <string>

#include "viewer/offscreen/gl_context.h"

namespace lightwell {

/// What a picture shows.
enum class View {
    total,        ///< luminance with all light [cd/m2]
    direct,       ///< luminance with direct light alone [cd/m2]
    indirect,     ///< luminance with indirect light alone, lamps dark [cd/m2]
    lux,          ///< illuminance [lx], as a false-colour picture
    level,        ///< the wavelet mesh: the finest cells, coloured by their level
    coefficients  ///< the operator's coefficients on every side of a quad, by colour
};

/// "total", "direct", "indirect", "lux", "level" or "coefficients".
/// @throws InputError for any other word
View view_argument(const std::string& option, const std::string& text);

/// "osmesa" or "egl".
/// @throws InputError for any other word
OffscreenGl opengl_argument(const std::string& option, const std::string& text);

}  // namespace lightwell
