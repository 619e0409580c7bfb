#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiance4d/failure.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/material.h"
#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A quad of the scene, its material, and where it came from.
struct SceneQuad {
    Quad quad;
    int material = 0;  ///< index into Scene::materials
    int face = 0;      ///< number of the polygon in the geometry file, from 0
    int line = 0;      ///< line of that polygon in the geometry file, 0 if not known
};

/// A pinhole camera.
struct Camera {
    Vec3 position = Vec3::Zero();  ///< [m]
    Vec3 target = Vec3::UnitY();   ///< a point on the optical axis [m], other than the position
    Vec3 up = Vec3::UnitZ();       ///< not parallel to the axis
    double vertical_angle = 50;    ///< full vertical field of view [degrees], in (0,180)
};

/// A rectangle of sensors: origin + (i+0.5)/columns * along + (j+0.5)/rows * across, all facing
/// `normal`.
struct SensorGrid {
    std::string name;
    Vec3 origin = Vec3::Zero();
    Vec3 along = Vec3::UnitX();
    Vec3 across = Vec3::UnitY();
    Vec3 normal = Vec3::UnitZ();
    int columns = 1;
    int rows = 1;
};

/// What light travels in: quads and their materials, with the lights, camera and sensors the author
/// put beside them. Lengths are metres, light is photometric, coordinates are right-handed.
struct Scene {
    std::string name;
    std::string geometry_file;  ///< as the user named it, for messages
    Vec3 up =
        Vec3::UnitZ();  ///< which way is up; the coordinates themselves stay as the file has them
    std::vector<Material> materials;
    std::vector<SceneQuad> quads;
    std::vector<Light> lights;
    std::optional<Camera> camera;
    std::vector<SensorGrid> sensor_grids;

    /// Index into `materials` of a quad's material.
    std::size_t material_number(int quad) const {
        return static_cast<std::size_t>(quads[static_cast<std::size_t>(quad)].material);
    }
    const Material& material_of(int quad) const { return materials[material_number(quad)]; }
    /// "quad 12 (room.obj:57)", for messages.
    std::string describe(int quad) const;
};

}  // namespace lightwell
