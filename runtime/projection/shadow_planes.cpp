#include "runtime/projection/shadow_planes.h"

#include <algorithm>

namespace lightwell {

ShadowPlanes::ShadowPlanes(const Shadow& shadow, const Vec3& origin) {
    const Vec3 shift = origin - shadow.apex();
    const auto add = [&](const Plane& plane) {
        const Eigen::Vector3f normal = plane.normal.cast<float>();
        side_[static_cast<std::size_t>(count_++)] = {
            normal[0], normal[1], normal[2],
            static_cast<float>(plane.normal.dot(shift) - plane.offset)};
    };
    add(shadow.behind());
    for (int k = 0; k < shadow.edges(); ++k)
        add(shadow.edge(k));
}

Eigen::Array4f ShadowPlanes::heights(int plane, const FourPoints& points) const {
    const Side& side = side_[static_cast<std::size_t>(plane)];
    return side.x * points.x + side.y * points.y + side.z * points.z + side.offset;
}

Cover ShadowPlanes::cover(const FourPoints& corners, float tolerance) const {
    Cover cover = Cover::all;
    for (int plane = 0; plane < count_; ++plane) {
        const Eigen::Array4f height = heights(plane, corners);
        if (height.maxCoeff() <= tolerance) return Cover::none;
        if (height.minCoeff() < -tolerance) cover = Cover::part;
    }
    return cover;
}

int ShadowPlanes::straddling(const FourPoints& corners, float tolerance, Cover& cover,
                             Straddle* straddles) const {
    int count = 0;
    cover = Cover::all;
    for (int plane = 0; plane < count_; ++plane) {
        const Eigen::Array4f height = heights(plane, corners);
        if (height.maxCoeff() <= tolerance) {
            cover = Cover::none;
            return 0;
        }
        if (height.minCoeff() >= -tolerance) continue;
        cover = Cover::part;
        const Straddle straddle{height / height.abs().maxCoeff()};
        const auto is_known = [&](const Straddle& known) { return straddle.is_same_line(known); };
        if (std::none_of(straddles, straddles + count, is_known)) straddles[count++] = straddle;
    }
    return count;
}

Eigen::Array4f ShadowPlanes::hides(const FourPoints& points) const {
    Eigen::Array4f lowest = heights(0, points);
    for (int plane = 1; plane < count_; ++plane)
        lowest = lowest.min(heights(plane, points));
    return (lowest > 0.0F).select(Eigen::Array4f::Ones(), Eigen::Array4f::Zero());
}

}  // namespace lightwell
