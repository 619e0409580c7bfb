#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A perspective of what a lamp sees: the point d [m], relative to the lamp, is seen at
/// (s_x, s_y) / s_z of the square [-1,1]^2, where s = seen d, in the depth s_z [m].
struct LampView {
    Eigen::Matrix3d seen = Eigen::Matrix3d::Identity();

    /// Whether a quad given relative to the lamp, or a part of it, may be seen.
    bool reaches(const Quad& quad) const;
};

/// The six faces of a cube about the lamp, which see everything; turned in space, so that the edges
/// of shadows in a room are not parallel to rows of pixels.
std::array<LampView, 6> cube_views();

/// A view that a quad, given relative to the lamp, fills as far as a view can that is turned, for
/// the same reason: along the quad's horizontal and across it, and `margin` wider on each side, as
/// a share of its width.
/// @return none if a corner is seen more than 37 degrees from its middle, since the pixels of such
///         a view take up too different parts of the lamp's sky, or if the lamp is in its plane.
std::optional<LampView> close_view(const Quad& quad, double margin);

}  // namespace lightwell
