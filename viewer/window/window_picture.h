#pragma once

#include <string>

#include "runtime/drawing/gl_functions.h"

namespace lightwell {

/// Writes what was drawn into the window, the panel with it, to a .png.
/// @throws as write_png
void write_window_picture(const GlFunctions& gl, int width, int height, const std::string& path);

}  // namespace lightwell
