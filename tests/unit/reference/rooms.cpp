#include "tests/unit/reference/rooms.h"

namespace lightwell {

namespace {

/// Faces of an axis-parallel box in the order of Wall, normals inwards.
std::array<Quad, 6> faces(const Vec3& low, const Vec3& high) {
    const auto at = [&](int x, int y, int z) {
        return Vec3(x != 0 ? high[0] : low[0], y != 0 ? high[1] : low[1],
                    z != 0 ? high[2] : low[2]);
    };
    return {Quad{{at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}},
            Quad{{at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}},
            Quad{{at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}},
            Quad{{at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}},
            Quad{{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}},
            Quad{{at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}}};
}

}  // namespace

Material& add_quad(Scene& scene, const Quad& quad, const Rgb& reflectance) {
    Material material;
    material.reflectance = reflectance;
    scene.quads.push_back({quad, static_cast<int>(scene.materials.size()), 0, 0});
    scene.materials.push_back(material);
    return scene.materials.back();
}

Scene box_scene(const Vec3& size, const std::array<Rgb, 6>& reflectance) {
    Scene scene;
    const std::array<Quad, 6> walls = faces(Vec3::Zero(), size);
    for (std::size_t w = 0; w < walls.size(); ++w)
        add_quad(scene, walls[w], reflectance[w]);
    return scene;
}

void add_block(Scene& scene, const Vec3& low, const Vec3& high, const Rgb& reflectance) {
    for (const Quad& face : faces(low, high))
        add_quad(scene, face.reversed(), reflectance);
}

Visibility visibility_of(const Scene& scene) {
    std::vector<Quad> quads;
    for (const SceneQuad& one : scene.quads)
        quads.push_back(one.quad);
    return Visibility(quads);
}

}  // namespace lightwell
