#pragma once

#include <cmath>
#include <vector>

#include "radiance4d/scene/quad.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// The room [0,3] x [0,4] x [0,2.5] with its normals inwards (quads 0 to 5: x low, x high, y low, y
/// high, floor, ceiling), a tall block, turned about the vertical, on the left, and a low one on
/// the right, both without a bottom (quads 6 to 10 and 11 to 15, tops last).
inline std::vector<Quad> room_with_blocks() {
    const auto at = [](double x, double y, double z) { return Vec3(3 * x, 4 * y, 2.5 * z); };
    std::vector<Quad> quads = {Quad{{at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}},
                               Quad{{at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}},
                               Quad{{at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}},
                               Quad{{at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}},
                               Quad{{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}},
                               Quad{{at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}}};
    const auto add_block = [&](const Vec3& centre, double side, double height, double turn) {
        std::vector<Vec3> foot, top;
        for (int k = 0; k < 4; ++k) {
            const double angle = turn + k * std::acos(0.0);
            foot.push_back(centre +
                           side / std::sqrt(2.0) * Vec3(std::cos(angle), std::sin(angle), 0));
            top.push_back(foot.back() + Vec3(0, 0, height));
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t next = (k + 1) % 4;
            quads.push_back(Quad{{foot[k], foot[next], top[next], top[k]}});
        }
        quads.push_back(Quad{{top[0], top[1], top[2], top[3]}});
    };
    add_block(Vec3(0.9, 2.6, 0), 0.9, 1.5, 0.3);
    add_block(Vec3(2.1, 1.9, 0), 0.8, 0.6, 1.1);
    return quads;
}

/// Stands at the wall y = 0, a little right of the middle, and looks along y.
inline Camera camera_in_room() {
    Camera camera;
    camera.position = Vec3(1.6, 0.1, 1.8);
    camera.target = Vec3(1.5, 4, 1.0);
    camera.vertical_angle = 65;
    return camera;
}

}  // namespace lightwell
