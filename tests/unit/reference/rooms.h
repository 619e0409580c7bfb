#pragma once

#include <array>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// Index of a wall of box_scene: the order of the reference files.
enum Wall { x0, x1, y0, y1, floor_z0, ceiling_z1 };

/// The closed box [0,x] x [0,y] x [0,z], fronts inwards; wall w has material w.
Scene box_scene(const Vec3& size, const std::array<Rgb, 6>& reflectance);

/// Adds a quad with a material of its own.
Material& add_quad(Scene& scene, const Quad& quad, const Rgb& reflectance);

/// Adds the six faces of a solid axis-parallel block, fronts outwards.
void add_block(Scene& scene, const Vec3& low, const Vec3& high, const Rgb& reflectance);

Visibility visibility_of(const Scene& scene);

inline PointLight lamp_at(const Vec3& position, const Rgb& intensity = Rgb::Constant(100)) {
    return {"lamp", position, intensity};
}

}  // namespace lightwell
