#pragma once

#include <memory>
#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// What a ray met first.
struct Hit {
    int quad = -1;        ///< index of the quad, -1: nothing was met
    double distance = 0;  ///< along the unit direction [m]
    bool front = false;   ///< whether the front of the quad was met

    explicit operator bool() const { return quad >= 0; }
};

/// No quad: the end of a segment, or the start of a ray, that hangs free in space.
constexpr int free_point = -1;

/// Who sees whom among a fixed set of opaque quads.
///
/// Rays never meet the quads their ends lie on: those are known by index and passed over, whatever
/// the scale. Against coplanar neighbours and shared edges, both ends are moved off along the ray's
/// own quad by a multiple of the rounding error of the coordinates (never by a fixed length), after
/// the scene has been moved to its centre and scaled to unit size. All methods are const and may be
/// called from many threads at once.
class Visibility {
  public:
    /// Builds the search structure over the quads, which are planar and convex.
    /// @throws SystemError if memory does not suffice.
    explicit Visibility(const std::vector<Quad>& quads);
    ~Visibility();
    Visibility(Visibility&&) noexcept;
    Visibility& operator=(Visibility&&) noexcept;

    /// Whether something stands between a (on quad `on_a`) and b (on quad `on_b`).
    bool occluded(const Vec3& a, int on_a, const Vec3& b, int on_b) const;

    /// The first quad that the ray from `origin` (on quad `on_origin`) along the unit `direction`
    /// meets.
    Hit nearest(const Vec3& origin, int on_origin, const Vec3& direction) const;

    int quad_count() const;

  private:
    struct Tracer;
    std::unique_ptr<Tracer> tracer_;
};

}  // namespace lightwell
