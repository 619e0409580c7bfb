#include "radiance4d/scene/convex_polygon.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// Width, relative to the extent, below which a part is a product of rounding.
constexpr double sliver = 1e-14;

/// Signed distances of a polygon's vertices from a plane; those within the tolerance are zero.
class Heights {
  public:
    Heights(const ConvexPolygon& polygon, const Plane& plane, double tolerance) {
        for (int i = 0; i < polygon.size(); ++i) {
            const double height = plane.height(polygon[i]);
            const double snapped = std::abs(height) <= tolerance ? 0 : height;
            height_[static_cast<std::size_t>(i)] = snapped;
            highest_ = std::max(highest_, snapped);
            lowest_ = std::min(lowest_, snapped);
        }
    }
    double operator[](int i) const { return height_[static_cast<std::size_t>(i)]; }
    double highest() const { return highest_; }
    double lowest() const { return lowest_; }

  private:
    std::array<double, ConvexPolygon::capacity> height_{};
    double highest_ = 0;
    double lowest_ = 0;
};

/// Sutherland and Hodgman's clip of the side whose heights times `side` are positive.
ConvexPolygon part_on_side(const ConvexPolygon& polygon, const Heights& heights, double side,
                           double tolerance) {
    ConvexPolygon part;
    for (int i = 0; i < polygon.size(); ++i) {
        const int next = i + 1 == polygon.size() ? 0 : i + 1;
        const double here = side * heights[i], there = side * heights[next];
        if (here >= 0) part.append(polygon[i]);
        if ((here > 0 && there < 0) || (here < 0 && there > 0))
            part.append(polygon[i] + (here / (here - there)) * (polygon[next] - polygon[i]));
    }
    const bool narrow = part.size() < 3 || part.area() <= tolerance * part.extent();
    return narrow ? ConvexPolygon() : part;
}

}  // namespace

ConvexPolygon::ConvexPolygon(const Quad& quad) : size_(4) {
    std::copy(quad.vertex.begin(), quad.vertex.end(), vertex_.begin());
}

Vec3 ConvexPolygon::vector_area() const {
    Vec3 doubled = Vec3::Zero();
    for (int i = 1; i + 1 < size_; ++i)
        doubled += ((*this)[i] - (*this)[0]).cross((*this)[i + 1] - (*this)[0]);
    return 0.5 * doubled;
}

Vec3 ConvexPolygon::centre() const {
    LIGHTWELL_CHECK_OP(size_, >, 0);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& vertex : *this)
        sum += vertex;
    return sum / size_;
}

double ConvexPolygon::extent() const {
    double squared = 0;
    for (const Vec3& vertex : *this)
        squared = std::max(squared, (vertex - (*this)[0]).squaredNorm());
    return std::sqrt(squared);
}

double ConvexPolygon::reach() const {
    const Vec3 middle = centre();
    double squared = 0;
    for (const Vec3& vertex : *this)
        squared = std::max(squared, (vertex - middle).squaredNorm());
    return std::sqrt(squared);
}

ConvexPolygon ConvexPolygon::moved(const Vec3& by) const {
    ConvexPolygon result;
    for (const Vec3& vertex : *this)
        result.append(vertex + by);
    return result;
}

ConvexPolygon ConvexPolygon::reversed() const {
    ConvexPolygon result;
    for (int i = size_ - 1; i >= 0; --i)
        result.append((*this)[i]);
    return result;
}

CutPolygon cut(const ConvexPolygon& polygon, const Plane& plane, double tolerance) {
    const Heights heights(polygon, plane, tolerance);
    if (heights.highest() <= 0) return {ConvexPolygon(), polygon};
    if (heights.lowest() >= 0) return {polygon, ConvexPolygon()};
    return {part_on_side(polygon, heights, 1, tolerance),
            part_on_side(polygon, heights, -1, tolerance)};
}

CutPolygon cut(const ConvexPolygon& polygon, const Plane& plane) {
    return cut(polygon, plane, sliver * polygon.extent());
}

ConvexPolygon clipped(const ConvexPolygon& polygon, const Plane& plane, double tolerance) {
    const Heights heights(polygon, plane, tolerance);
    if (heights.highest() <= 0) return {};
    if (heights.lowest() >= 0) return polygon;
    return part_on_side(polygon, heights, 1, tolerance);
}

ConvexPolygon clipped(const ConvexPolygon& polygon, const Plane& plane) {
    return clipped(polygon, plane, sliver * polygon.extent());
}

std::pair<ConvexPolygon, ConvexPolygon> halved(const ConvexPolygon& polygon) {
    LIGHTWELL_CHECK_OP(polygon.size(), >=, 4);
    const int middle = polygon.size() / 2;
    std::pair<ConvexPolygon, ConvexPolygon> halves;
    for (int i = 0; i <= middle; ++i)
        halves.first.append(polygon[i]);
    for (int i = middle; i < polygon.size(); ++i)
        halves.second.append(polygon[i]);
    halves.second.append(polygon[0]);
    return halves;
}

}  // namespace lightwell
