#pragma once

#include <vector>

#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/quad.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// Where a sensor stands among the quads of a scene.
struct SensorStand {
    /// The sensor's point, moved onto the quad that it lies on, or just off the quad that it lies
    /// on without facing along its normal [m].
    Vec3 point = Vec3::Zero();
    int quad = free_point;  ///< the quad that the sensor lies on, or free_point
    bool front = true;      ///< whether it faces as the quad's front does
};

/// Finds the quad under a point, so that rays from there do not meet it.
///
/// A sensor lies on a quad if it is in its outline and no farther from its plane than a
/// hundred-thousandth of the scene's diagonal (coordinates in users' files are rounded), and its
/// normal is the quad's, either way, to within a degree. Of several such quads it lies on the
/// nearest. A sensor that touches a quad but looks aslant hangs free, as far off as that tolerance.
class SurfaceLookup {
  public:
    /// Keeps references to both.
    SurfaceLookup(const std::vector<Quad>& quads, const OccluderTree& occluders);

    /// @param normal unit length
    SensorStand stand(const Vec3& point, const Vec3& normal) const;

    /// How far from a quad's plane a point may be and yet lie on it [m].
    double tolerance() const { return tolerance_; }

  private:
    const std::vector<Quad>& quads_;
    const OccluderTree& occluders_;
    double tolerance_ = 0;
};

}  // namespace lightwell
