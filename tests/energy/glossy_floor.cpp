#include "tests/energy/glossy_floor.h"

#include <array>

#include "tests/unit/reference/rooms.h"

namespace lightwell {

Scene box_with_floor(const Lobe& lobe, double diffuse) {
    std::array<Rgb, 6> rho;
    rho.fill(Rgb(0.6, 0.5, 0.4));
    rho[floor_z0] = Rgb::Constant(diffuse);
    Scene scene = box_scene({3, 2, 2.5}, rho);
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    scene.materials[floor_z0].lobe = lobe;
    return scene;
}

}  // namespace lightwell
