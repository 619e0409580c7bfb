#pragma once

#include <vector>

#include "runtime/drawing/camera_rays.h"
#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/drawing/surface_buffer.h"

namespace lightwell {

/// Draws a scene's quads, opaque and from both sides, to find what every pixel sees.
///
/// The context that the loader belongs to must be current whenever a method is called, and at the
/// end. Every method leaves framebuffer 0 and no program or vertex array bound.
class SurfaceDrawing {
  public:
    /// @param quads planar and convex.
    /// @throws SystemError if OpenGL lacks a function or does not accept the shaders.
    SurfaceDrawing(std::vector<Quad> quads, const GlLoader& loader);
    SurfaceDrawing(const SurfaceDrawing&) = delete;
    SurfaceDrawing& operator=(const SurfaceDrawing&) = delete;

    /// The longest side of a window that this OpenGL can draw [pixels].
    int longest_side() const { return longest_side_; }

    /// What the pixels of the window see. Surfaces nearer than a hundred-thousandth of the distance
    /// to the farthest vertex are not seen.
    /// @throws SystemError if OpenGL fails, for want of memory for instance.
    SurfaceBuffer draw(const CameraRays& camera, const PixelWindow& window) const;

  private:
    DrawnQuads draw_indices(const CameraRays& camera, const PixelWindow& window) const;
    void draw_elements(const CameraRays& camera, const PixelWindow& canvas) const;
    /// Uploads the quads as seen by the camera. @return the nearest distance that is drawn [m].
    float upload(const CameraRays& camera) const;

    std::vector<Quad> quads_;
    GlFunctions gl_;
    int longest_side_ = 0;
    GlObject program_;
    GlObject vertex_array_;
    GlObject vertices_;
    GlObject elements_;
};

}  // namespace lightwell
