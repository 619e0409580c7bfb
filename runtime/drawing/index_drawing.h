#pragma once

#include <vector>

#include "radiance4d/scene/quad.h"
#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/drawing/plane_quads.h"

namespace lightwell {

/// From where and how the quads are seen.
struct IndexView {
    Vec3 eye = Vec3::Zero();  ///< in the coordinates of the quads
    /// Rows: unit vectors right, top and forward.
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    double across = 1, up = 1;  ///< tangents of half the angle of view
    int left = 0, bottom = 0;   ///< corner of the viewport [pixels]
    int width = 1, height = 1;  ///< of the viewport [pixels]
};

/// Draws the indices of quads, opaque and from both sides, into an integer image with a
/// floating-point depth buffer. Depth is taken from the quads' planes themselves and not
/// interpolated, nearest / distance along the axis, which keeps the same relative precision from
/// the eye to the horizon.
class IndexDrawing {
  public:
    /// @param quads planar and convex, in coordinates of about 1. Keeps a reference to `gl`.
    IndexDrawing(const GlFunctions& gl, const std::vector<Quad>& quads);

    /// Nothing nearer than this along the axis is seen.
    static constexpr float nearest = 1e-5F;

    /// Sets -1 and infinitely far in the framebuffer that is bound, and the state that draw()
    /// depends on; but where the scissor test is, is left to others (LimitedRows).
    void clear(int width, int height) const;
    /// Draws into the framebuffer that is bound.
    void draw(const IndexView& view) const;

  private:
    const GlFunctions& gl_;
    std::size_t count_;  ///< quads
    GlObject program_;
    PlaneQuads quads_;
};

}  // namespace lightwell
