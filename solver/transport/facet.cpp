#include "solver/transport/facet.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "radiance4d/failure.h"

namespace lightwell {

Facet Facet::of(const Quad& quad, const Vec3& normal) {
    Facet facet;
    std::copy(quad.vertex.begin(), quad.vertex.end(), facet.vertex.begin());
    facet.count = 4;
    facet.normal = normal;
    return facet;
}

Facet Facet::in_front_of(const Vec3& n, double d, double tolerance) const {
    std::array<double, 8> height{};
    double lowest = 0, highest = 0;
    for (int i = 0; i < count; ++i) {
        height[i] = n.dot(vertex[i]) - d;
        lowest = std::min(lowest, height[i]);
        highest = std::max(highest, height[i]);
    }
    if (lowest >= -tolerance) return highest > tolerance ? *this : Facet{};
    if (highest <= tolerance) return Facet{};

    Facet kept;
    kept.normal = normal;
    for (int i = 0; i < count; ++i) {
        const int j = (i + 1) % count;
        if (height[i] >= 0) kept.vertex[kept.count++] = vertex[i];
        if ((height[i] < 0) != (height[j] < 0)) {
            const double t = height[i] / (height[i] - height[j]);
            LIGHTWELL_CHECK_OP(kept.count, <, 8);
            kept.vertex[kept.count++] = vertex[i] + t * (vertex[j] - vertex[i]);
        }
    }
    return kept.count < 3 ? Facet{} : kept;
}

double Facet::area() const {
    Vec3 doubled = Vec3::Zero();
    for (int i = 2; i < count; ++i)
        doubled += (vertex[i - 1] - vertex[0]).cross(vertex[i] - vertex[0]);
    return 0.5 * doubled.norm();
}

Vec3 Facet::centre() const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < count; ++i)
        sum += vertex[i];
    return sum / std::max(count, 1);
}

double Facet::reach() const {
    const Vec3 middle = centre();
    double farthest = 0;
    for (int i = 0; i < count; ++i)
        farthest = std::max(farthest, (vertex[i] - middle).squaredNorm());
    return std::sqrt(farthest);
}

}  // namespace lightwell
