#pragma once

#include <string>

#include "runtime/drawing/frame_view.h"

namespace lightwell {

/// A triangle that covers the viewport.
const char* covering_vertex_shader();

/// Light of every pixel from the indices of the quads seen, in linear units: reads the surfaces'
/// records, the lamps, what they see, and the textures of indirect light.
std::string lighting_shader(Picture picture, bool glossy);

/// Linear light to the colours of a display, sRGB-encoded.
std::string developing_shader();

}  // namespace lightwell
