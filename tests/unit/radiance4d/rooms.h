#pragma once

#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// The six walls of the box [low, high], normals inwards: x low, x high, y low, y high, z low, z
/// high.
inline std::vector<Quad> box_walls(const Vec3& low, const Vec3& high) {
    const auto at = [&](int x, int y, int z) -> Vec3 {
        return {x == 0 ? low[0] : high[0], y == 0 ? low[1] : high[1], z == 0 ? low[2] : high[2]};
    };
    return {Quad{{at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}},
            Quad{{at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}},
            Quad{{at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}},
            Quad{{at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}},
            Quad{{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}},
            Quad{{at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}}};
}

/// The rectangle [x0,x1] x [y0,y1] at height z; its front looks up.
inline Quad level_rectangle(double x0, double x1, double y0, double y1, double z) {
    return {{Vec3(x0, y0, z), Vec3(x1, y0, z), Vec3(x1, y1, z), Vec3(x0, y1, z)}};
}

/// The quad turned by a rotation and then shifted.
inline Quad placed(const Quad& quad, const Eigen::Matrix3d& turn, const Vec3& shift) {
    Quad result = quad;
    for (Vec3& vertex : result.vertex)
        vertex = turn * vertex + shift;
    return result;
}

/// A rotation about no particular axis.
inline Eigen::Matrix3d some_turn() {
    return Eigen::AngleAxisd(37 * M_PI / 180, Vec3(1, 2, 3).normalized()).toRotationMatrix();
}

/// A point in the unit cube, each coordinate uniform in [0,1].
inline Vec3 random_point(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

/// A unit vector, about uniform on the sphere.
inline Vec3 random_direction(std::mt19937& random) {
    for (;;) {
        const Vec3 v = 2 * random_point(random) - Vec3::Ones();
        if (v.squaredNorm() < 1 && v.squaredNorm() > 1e-4) return v.normalized();
    }
}

/// A random parallelogram with its centre in the unit cube and sides up to `size`.
inline Quad random_parallelogram(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> length(0.2 * size, size);
    const Vec3 centre = random_point(random);
    const Vec3 a = 0.5 * length(random) * random_direction(random);
    const Vec3 raw = random_direction(random);
    const Vec3 b = 0.5 * length(random) * (raw - 0.8 * raw.dot(a) / a.squaredNorm() * a);
    return {{centre - a - b, centre + a - b, centre + a + b, centre - a + b}};
}

}  // namespace lightwell
