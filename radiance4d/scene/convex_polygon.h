#pragma once

#include <array>
#include <utility>

#include "radiance4d/failure.h"
#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The plane normal . x = offset. Its inside is normal . x >= offset.
struct Plane {
    Vec3 normal = Vec3::UnitZ();  ///< unit length
    double offset = 0;            ///< [m]

    /// Signed distance of a point, positive inside [m].
    double height(const Vec3& point) const { return normal.dot(point) - offset; }
};

/// A convex planar polygon of up to `capacity` vertices [m], held without heap memory. Its front is
/// the side from which the vertices run counter-clockwise. It may be empty.
class ConvexPolygon {
  public:
    /// A quad that is cut by a plane gains one vertex, so 16 is a quad cut twelve times at corners.
    /// One vertex more is a broken invariant: halve the polygon before that.
    static constexpr int capacity = 16;

    ConvexPolygon() = default;
    explicit ConvexPolygon(const Quad& quad);

    int size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const Vec3& operator[](int i) const { return vertex_[static_cast<std::size_t>(i)]; }
    /// The vertex after vertex i, going round.
    const Vec3& after(int i) const { return (*this)[i + 1 == size_ ? 0 : i + 1]; }
    const Vec3* begin() const { return vertex_.data(); }
    const Vec3* end() const { return vertex_.data() + size_; }

    /// Adds a vertex behind the last one.
    void append(const Vec3& vertex) {
        LIGHTWELL_CHECK_OP(size_, <, capacity);
        vertex_[static_cast<std::size_t>(size_++)] = vertex;
    }

    /// Points to the front; its length is the area [m2].
    Vec3 vector_area() const;
    /// [m2]
    double area() const { return vector_area().norm(); }
    /// Mean of the vertices; the polygon must not be empty.
    Vec3 centre() const;
    /// Largest distance of a vertex from the first one [m]: at least half the diameter.
    double extent() const;
    /// Largest distance of a vertex from the centre [m]; the polygon must not be empty.
    double reach() const;

    /// The same polygon shifted.
    ConvexPolygon moved(const Vec3& by) const;
    /// The same polygon seen from behind.
    ConvexPolygon reversed() const;

  private:
    std::array<Vec3, capacity> vertex_;
    int size_ = 0;
};

/// A polygon cut by a plane.
struct CutPolygon {
    ConvexPolygon inside;
    ConvexPolygon outside;
};

/// Cuts a polygon by a plane. Vertices within `tolerance` [m] of the plane count as lying on it,
/// and a part narrower than `tolerance` vanishes; a polygon that lies all in the plane is outside.
CutPolygon cut(const ConvexPolygon& polygon, const Plane& plane, double tolerance);

/// As above with a tolerance of 1e-14 of the polygon's extent.
CutPolygon cut(const ConvexPolygon& polygon, const Plane& plane);

/// The inside part of cut(polygon, plane, tolerance).
ConvexPolygon clipped(const ConvexPolygon& polygon, const Plane& plane, double tolerance);

/// The inside part of cut(polygon, plane).
ConvexPolygon clipped(const ConvexPolygon& polygon, const Plane& plane);

/// Cuts a polygon of four vertices or more along a diagonal, into parts of about equal vertex
/// count.
std::pair<ConvexPolygon, ConvexPolygon> halved(const ConvexPolygon& polygon);

}  // namespace lightwell
