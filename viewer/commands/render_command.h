#pragma once

#include <optional>
#include <string>

#include "viewer/commands/arguments.h"
#include "viewer/commands/picture_view.h"
#include "viewer/commands/projection_choice.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

/// Where a picture's indirect light comes from.
enum class IndirectLight {
    gathered,  ///< solved, and gathered once more at every cell: the most even
    smooth,    ///< solved, and read from the basis
    textures   ///< the stored operator's, from one texture per quad: what a moving lamp shows
};

/// What `lightwell render` was asked for.
struct RenderRequest {
    std::string operator_file;          ///< .gto
    std::optional<std::string> lights;  ///< a file of lights; the scene's own if not given
    std::optional<std::string> camera;  ///< a file with a camera; the scene's own if not given
    std::string output;                 ///< .png or .exr
    PixelSize size;
    double exposure = 0;  ///< of a PNG [EV], beside the automatic one
    int samples = 2;      ///< a side in every pixel
    View view = View::total;
    IndirectLight indirect = IndirectLight::gathered;
    bool live = false;                ///< drawn as a window draws it, see LivePictures
    std::optional<std::string> path;  ///< a file of keyframes: pictures along it, drawn live
    bool contours = false;            ///< contour lines in View::lux
    OffscreenGl opengl = OffscreenGl::osmesa;
    /// Of lamps in live pictures. Rays by default: the same bytes everywhere.
    ProjectionWay projection = ProjectionWay::rays;
};

/// Renders a picture into a file, or along a path into numbered files, without a display. A PNG is
/// exposed and toned for a screen; an EXR holds the light itself (cd/m2; lx for View::lux).
/// @throws InputError for files that cannot be used, SystemError if OpenGL or the disk fails
void run_render(const RenderRequest& request);

}  // namespace lightwell
