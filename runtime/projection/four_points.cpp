#include "runtime/projection/four_points.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

namespace lightwell {

FourPoints::FourPoints(const Quad& quad, const Vec3& origin) {
    for (Eigen::Index k = 0; k < 4; ++k) {
        const Eigen::Vector3f at =
            (quad.vertex[static_cast<std::size_t>(k)] - origin).cast<float>();
        x[k] = at[0];
        y[k] = at[1];
        z[k] = at[2];
    }
}

FourPoints quarter(const FourPoints& corners, int number) {
    const auto mixed = [number](const Eigen::Array4f& c) {
        Eigen::Array4f result;
        for (int k = 0; k < 4; ++k)
            result[k] = 0.5F * (c[number] + c[k]);
        // The corner opposite to `number` is the bilinear centre.
        result[(number + 2) % 4] = 0.25F * c.sum();
        return result;
    };
    FourPoints part;
    part.x = mixed(corners.x);
    part.y = mixed(corners.y);
    part.z = mixed(corners.z);
    return part;
}

FourPoints quarter_centres(const FourPoints& corners) {
    const auto centred = [](const Eigen::Array4f& c) -> Eigen::Array4f {
        return 0.5F * c + 0.125F * c.sum();
    };
    FourPoints centres;
    centres.x = centred(corners.x);
    centres.y = centred(corners.y);
    centres.z = centred(corners.z);
    return centres;
}

Eigen::Vector3f centroid(const FourPoints& corners) {
    return {0.25F * corners.x.sum(), 0.25F * corners.y.sum(), 0.25F * corners.z.sum()};
}

float area(const FourPoints& corners) {
    const Eigen::Vector3f first = corners[2] - corners[0], second = corners[3] - corners[1];
    return 0.5F * first.cross(second).norm();
}

float squared_size(const FourPoints& corners) {
    return std::max((corners[2] - corners[0]).squaredNorm(),
                    (corners[3] - corners[1]).squaredNorm());
}

OuterPart outer_part(const FourPoints& corners, const Eigen::Array4f& height) {
    // Triangles from the first vertex of the part; the outline holds at most five.
    std::array<Eigen::Vector3f, 6> outline;
    std::size_t count = 0;
    for (int k = 0; k < 4; ++k) {
        const int next = (k + 1) % 4;
        const float here = height[k], there = height[next];
        if (here < 0) outline[count++] = corners[k];
        if ((here < 0) != (there < 0))
            outline[count++] = corners[k] + here / (here - there) * (corners[next] - corners[k]);
    }
    float sum = 0;
    Eigen::Vector3f moment = Eigen::Vector3f::Zero();
    for (std::size_t k = 2; k < count; ++k) {
        const float part = (outline[k - 1] - outline[0]).cross(outline[k] - outline[0]).norm();
        sum += part;
        moment += part * (outline[0] + outline[k - 1] + outline[k]);
    }
    if (!(sum > 0)) return {};
    return {0.5F * sum / area(corners), moment / (3 * sum)};
}

}  // namespace lightwell
