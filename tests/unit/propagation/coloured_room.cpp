#include "tests/unit/propagation/coloured_room.h"

#include <cmath>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/scene/scene_quads.h"
#include "solver/precompute.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell::testing {

PackedField ColouredRoom::lamp_at(const Vec3& position) const {
    const std::vector<Light> lamp = {PointLight{"lamp", position, Rgb::Constant(100)}};
    return packed(projected_lights(transport.space, lamp, quads, occluders));
}

const ColouredRoom& coloured_room() {
    static const ColouredRoom room = [] {
        const Rgb white(0.7, 0.7, 0.7), red(0.6, 0.1, 0.1), green(0.1, 0.5, 0.15);
        Scene scene = box_scene(Vec3(3, 4, 2.5), {red, green, white, white, white, white});
        add_block(scene, Vec3(1, 1.5, 0), Vec3(1.8, 2.3, 1.2), white);
        PrecomputeOptions options;
        options.error = 0.1;
        options.cell_size = 0.25;
        options.most_attempts = 0;
        PrecomputeReport report;
        GlobalTransport transport = precompute(scene, options, {}, report);
        std::vector<Quad> quads = quads_of(scene);
        OccluderTree occluders(quads);
        return ColouredRoom{std::move(transport), std::move(quads), std::move(occluders)};
    }();
    return room;
}

std::vector<LightPath> light_paths(int frames) {
    std::vector<LightPath> paths(3);
    for (int f = 0; f < frames; ++f) {
        const double way = 0.01 * f;  // [m]
        paths[0].emplace_back(0.5 + 0.5 * way, 0.8 + 0.8 * way, 1.9 - 0.3 * way);
        const double angle = way / 1.3;
        paths[1].emplace_back(1.4 + 1.1 * std::cos(angle), 1.9 + 1.5 * std::sin(angle), 1.0);
        // Three steps of four to and fro, the fourth at rest; from one end to the other in 40.
        const double walk = 0.01 * std::abs(std::remainder(f - f / 4, 80));
        paths[2].emplace_back(0.3 + 0.7 * walk, 3.4 - 0.7 * walk, 2.2);
    }
    return paths;
}

}  // namespace lightwell::testing
