#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "radiance4d/scene/scene.h"
#include "viewer/stability/closed_forms.h"

namespace lightwell::stability {

/// The closed room [0,x] x [0,y] x [0,z], fronts inwards, a material each: walls x low, x high, y
/// low, y high, floor, ceiling.
Scene room(const Vec3& size, const std::array<double, 6>& reflectance);
Scene room(const Vec3& size, double reflectance);

/// 5 x 4 x 3 m, the green channel of the reference's office.
Scene office();
/// Where its lamp of 1,000 cd hangs [m].
inline Vec3 office_lamp() {
    return {1.4, 2.5, 1.9};
}

/// Adds a quad with a grey material of its own.
Material& add_quad(Scene& scene, const Quad& quad, double reflectance);

/// The rectangle with a corner and two sides.
Quad rectangle(const Vec3& corner, const Vec3& along, const Vec3& across);
/// The rectangle in the plane at height z, front upwards.
Quad level(const Rectangle& r, double z);

/// Adds the faces of a solid block, fronts outwards.
void add_block(Scene& scene, const Vec3& low, const Vec3& high, double reflectance);

/// Every front reflects what it does and emits the rest, so that illuminance is 1 lx everywhere,
/// whatever the shape, if the scene is closed.
void make_furnace(Scene& scene);

/// The scene turned, scaled and moved.
Scene moved(Scene scene, const Eigen::Affine3d& by);

PointLight lamp(const Vec3& position, double candela = 1000);

}  // namespace lightwell::stability
