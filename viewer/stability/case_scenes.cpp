#include "viewer/stability/case_scenes.h"

#include <cmath>

namespace lightwell::stability {

namespace {

/// Faces of an axis-parallel box, fronts inwards.
std::array<Quad, 6> faces(const Vec3& low, const Vec3& high) {
    const Vec3 x(high[0] - low[0], 0, 0), y(0, high[1] - low[1], 0), z(0, 0, high[2] - low[2]);
    return {rectangle(low, y, z),     rectangle(low + x, z, y), rectangle(low, z, x),
            rectangle(low + y, x, z), rectangle(low, x, y),     rectangle(low + z, y, x)};
}

}  // namespace

Quad rectangle(const Vec3& corner, const Vec3& along, const Vec3& across) {
    return {{corner, corner + along, corner + along + across, corner + across}};
}

Material& add_quad(Scene& scene, const Quad& quad, double reflectance) {
    Material material;
    material.reflectance.setConstant(reflectance);
    scene.quads.push_back({quad, static_cast<int>(scene.materials.size()), 0, 0});
    scene.materials.push_back(material);
    return scene.materials.back();
}

Scene room(const Vec3& size, const std::array<double, 6>& reflectance) {
    Scene scene;
    const std::array<Quad, 6> walls = faces(Vec3::Zero(), size);
    for (std::size_t w = 0; w < walls.size(); ++w)
        add_quad(scene, walls[w], reflectance[w]);
    return scene;
}

Scene room(const Vec3& size, double reflectance) {
    std::array<double, 6> all;
    all.fill(reflectance);
    return room(size, all);
}

Scene office() {
    return room({5, 4, 3}, {0.5, 0.6, 0.65, 0.3, 0.25, 0.8});
}

Quad level(const Rectangle& r, double z) {
    return rectangle({r.x0, r.y0, z}, {r.x1 - r.x0, 0, 0}, {0, r.y1 - r.y0, 0});
}

void add_block(Scene& scene, const Vec3& low, const Vec3& high, double reflectance) {
    for (const Quad& face : faces(low, high))
        add_quad(scene, face.reversed(), reflectance);
}

void make_furnace(Scene& scene) {
    for (Material& material : scene.materials) {
        material.emission = (1 - material.reflectance) / M_PI;
        material.reflecting = material.emitting = Sides::front;
    }
}

Scene moved(Scene scene, const Eigen::Affine3d& by) {
    for (SceneQuad& one : scene.quads)
        for (Vec3& corner : one.quad.vertex)
            corner = by * corner;
    return scene;
}

PointLight lamp(const Vec3& position, double candela) {
    return {"lamp", position, Rgb::Constant(candela)};
}

}  // namespace lightwell::stability
