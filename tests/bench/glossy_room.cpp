#include "tests/bench/glossy_room.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/unit/reference/rooms.h"

namespace lightwell {

Scene room_with_floor(const Lobe& lobe) {
    std::array<Rgb, 6> rho;
    rho.fill(Rgb::Constant(0.5));
    rho[x0] = Rgb(0.63, 0.06, 0.05);
    rho[x1] = Rgb(0.14, 0.45, 0.09);
    rho[floor_z0] = Rgb::Constant(0.1);
    Scene scene = box_scene({3, 2, 2.5}, rho);
    add_block(scene, {0.75, 0.8, 0.0}, {1.5, 1.4, 1.0}, Rgb(0.2, 0.3, 0.7));
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    scene.materials[floor_z0].lobe = lobe;
    return scene;
}

std::vector<RadianceProbe> probes_of(const Visibility& visibility) {
    std::vector<RadianceProbe> probes;
    for (const Vec3& eye : {Vec3(0.3, 1.0, 1.6), Vec3(2.7, 0.3, 1.2), Vec3(1.5, 1.8, 2.2)})
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < 12; ++j) {
                const Vec3 at((i + 0.37) / 16 * 3, (j + 0.41) / 12 * 2, 0);
                const RadianceProbe probe{eye, (at - eye).normalized()};
                if (visibility.nearest(eye, free_point, probe.direction).quad == floor_z0)
                    probes.push_back(probe);
            }
    return probes;
}

double deviation(const std::vector<Rgb>& seen, const LightSurvey& survey) {
    double off = 0, squares = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        off += (seen[k] - survey.at[k].mean).square().sum() -
               survey.at[k].standard_error.square().sum();
        squares += survey.at[k].mean.square().sum();
    }
    return squares > 0 ? std::sqrt(std::max(0.0, off) / squares) : 0;
}

}  // namespace lightwell
