#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/dimmed_light.h"
#include "radiance4d/scene/scene.h"
#include "solver/reading/bare_geometry.h"
#include "solver/reading/material_choice.h"
#include "solver/reading/reading_report.h"

namespace lightwell {

/// A scene and what reading it met with.
struct ReadScene {
    Scene scene;
    std::vector<DimmedLight> lights;  ///< of the scene, before they are dimmed
    ReadingReport report;
};

/// Reads a scene: a scene file (.toml) or bare geometry (.obj, .ply).
///
/// A scene file is TOML:
///
///     name = "office"                # default: the file's name
///     geometry = "office.obj"        # .obj or .ply, relative to this file
///     unit = "m"                     # "m", "cm", "mm", "in", "ft", or its length in metres; "m"
///     up = "z"                       # "x", "y" or "z"; the coordinates stay as they are
///     cut_along_walls = true         # whether quads are cut where walls stand on them; true
///     default_material = "plaster"   # for faces without a material or with an unknown one
///
///     [material.plaster]             # by the name that the geometry uses
///     reflectance = 0.7              # in [0,1], one number or [r, g, b]; default 0.5
///     specular = 0                   # of a glossy lobe, in [0,1], one number or [r, g, b]
///     exponent = 30                  # the lobe is Phong's, in [0, 10000] ...
///     roughness = 0.3                # ... or GGX, in [0.01, 1]; one of the two
///     emission = [0, 0, 0]           # luminance [cd/m2], one number or [r, g, b]
///     sides = "both"                 # sides that reflect: "both" or "front"
///     emission_sides = "front"       # sides that emit: "front" or "both"
///
///     [[light]]
///     name = "lamp"
///     type = "point"                 # or "spot"
///     position = [2.0, 1.5, 2.4]     # [m]
///     intensity = [100, 100, 100]    # [cd], one number or [r, g, b]
///     direction = [0, 0, -1]         # spot only
///     inner_angle = 20               # spot only: half-angle of full intensity [degrees]
///     outer_angle = 30               # spot only: half-angle where the light ends [degrees]
///     dimmer = 1                     # factor of the intensity, in [0,1]; default 1
///     on = true                      # false: switched off, at that dimmer; default true
///
///     [camera]
///     position = [5, 4, 1.6]         # [m]
///     target = [0, 0, 1]             # [m]
///     up = [0, 0, 1]                 # default: the scene's
///     vertical_angle = 50            # full vertical field of view [degrees]
///
///     [[sensors]]                    # columns x rows sensors, in the middles of their cells
///     name = "desk"
///     origin = [0, 0, 0.8]           # a corner [m]
///     along = [4, 0, 0]              # side that the columns divide [m]
///     across = [0, 3, 0]             # side that the rows divide [m]
///     normal = [0, 0, 1]             # where all sensors look; default: along x across
///     columns = 8
///     rows = 6
///
/// Only `geometry` must be there. Names with other letters than A-Z, a-z, 0-9, _ and - stand in
/// quotes: [material."wall.001"]. Lengths in the file itself are metres, whatever `unit` says of
/// the geometry. A material's table goes before the MTL file of an OBJ, which counts for what the
/// table leaves open.
/// @param bare  what to take bare geometry for; must say nothing for a scene file
/// @throws InputError with file, line and column for whatever is wrong with any of the files,
/// unknown keys and wrong types included, for a scene in which no surface is left, and, unless
/// `above_one` says otherwise, for a material that reflects more light than it receives
ReadScene read_scene(const std::string& path, AlbedoAboveOne above_one = AlbedoAboveOne::refuse,
                     const BareGeometry& bare = {});

/// The [[light]] tables of a lights file, before they are dimmed.
/// @throws InputError as read_scene
std::vector<DimmedLight> read_dimmed_lights(const std::string& path);

/// The [[light]] tables of a lights file, dimmed. The file may hold [camera] and [[sensors]], too.
/// A file without any light says so by `light = []`.
/// @throws InputError as read_scene
std::vector<Light> read_lights(const std::string& path);

/// The [camera] table of a camera file. The file may hold [[light]] and [[sensors]], too.
/// @param up the direction that is up unless the table says
/// @throws InputError as read_scene
Camera read_camera(const std::string& path, const Vec3& up = Vec3::UnitZ());

}  // namespace lightwell
