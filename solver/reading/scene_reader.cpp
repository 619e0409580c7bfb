#include "solver/reading/scene_reader.h"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "solver/reading/copies.h"
#include "solver/reading/input_file.h"
#include "solver/reading/material_choice.h"
#include "solver/reading/mesh_reader.h"
#include "solver/reading/quads_from_polygons.h"
#include "solver/reading/scene_tables.h"
#include "solver/reading/wall_cutting.h"

namespace lightwell {

namespace {

/// What a scene file says about its geometry.
struct GeometryChoice {
    std::string file;
    double metres_per_unit = 1;
    bool cut_along_walls = true;
    std::vector<MaterialDescription> materials;
    std::string default_material;
};

double unit_from(const TomlTable& file) {
    if (!file.is_text("unit")) {
        const double unit = file.number("unit");
        if (!is_unit(unit))
            file.fail("unit", fmt::format("unit {} is not within 1e-9 and 1e9 metres", unit));
        return unit;
    }
    const std::string name = file.text("unit");
    const std::optional<double> metres = metres_in(name);
    if (!metres)
        file.fail("unit",
                  "unit must be \"m\", \"cm\", \"mm\", \"in\", \"ft\" or a number of "
                  "metres, not " +
                      in_quotes(name));
    return *metres;
}

Vec3 up_from(const TomlTable& file) {
    const std::string name = file.text("up");
    const std::optional<Vec3> axis = axis_called(name);
    if (!axis) file.fail("up", R"(up must be "x", "y" or "z", not )" + in_quotes(name));
    return *axis;
}

std::string default_material_from(const TomlTable& file,
                                  const std::vector<MaterialDescription>& materials) {
    std::string name = file.text("default_material");
    for (const MaterialDescription& material : materials)
        if (material.name == name) return name;
    file.fail("default_material",
              fmt::format("there is no [material.{}] in the file", in_quotes(name)));
}

/// Reads the scene file itself and says where the geometry is.
GeometryChoice read_scene_file(const std::string& path, ReadScene& read) {
    Scene& scene = read.scene;
    const TomlTable file = TomlTable::read(path);
    GeometryChoice geometry;
    if (file.has("name")) scene.name = file.text("name");
    geometry.file = (std::filesystem::path(path).parent_path() / file.text("geometry")).string();
    if (!is_mesh_file(geometry.file))
        file.fail("geometry",
                  "geometry must be an .obj or .ply file, not " + in_quotes(file.text("geometry")));
    if (file.has("unit")) geometry.metres_per_unit = unit_from(file);
    if (file.has("cut_along_walls")) geometry.cut_along_walls = file.flag("cut_along_walls");
    if (file.has("up")) scene.up = up_from(file);
    geometry.materials = materials_from(file);
    if (file.has("default_material"))
        geometry.default_material = default_material_from(file, geometry.materials);
    read.lights = lights_from(file);
    scene.lights = shining(read.lights);
    if (file.has("camera")) scene.camera = camera_from(file.table("camera"), scene.up);
    scene.sensor_grids = sensor_grids_from(file);
    file.refuse_unknown_keys();
    return geometry;
}

/// Cuts the quads along the walls that stand on them, and reports it.
void cut_quads(QuadsOfPolygons& made, const std::string& file) {
    const WallCutRule rule;
    CutAlongWalls cut = cut_along_walls(made.quads, rule);
    made.quads = std::move(cut.quads);
    made.counts.along_walls = cut.cut;
    made.counts.pieces = cut.pieces;
    made.counts.elements = static_cast<int>(made.quads.size());
    cut.unfinished.report(file,
                          fmt::format("walls cut this quad into more than {} pieces: some of them "
                                      "still lie on both sides of a wall, where light may leak",
                                      rule.most_pieces),
                          made.warnings);
}

void read_geometry(const GeometryChoice& geometry, AlbedoAboveOne above_one, ReadScene& read) {
    const PolygonSoup soup = read_mesh(geometry.file);
    std::vector<Warning>& warnings = read.report.warnings;
    warnings = soup.warnings;
    MaterialChoice choice =
        choose_materials(soup, geometry.materials, geometry.default_material, above_one, warnings);
    QuadsOfPolygons made = quads_from_polygons(soup, geometry.metres_per_unit);
    for (SceneQuad& quad : made.quads)
        quad.material = quad.material < 0 ? choice.of_unnamed
                                          : choice.of_soup[static_cast<std::size_t>(quad.material)];
    made.counts.copies =
        leave_out_copies(made.quads, choice.materials, geometry.file, made.warnings);
    made.counts.elements -= made.counts.copies;
    read.report.files.push_back(geometry.file);
    read.report.files.insert(read.report.files.end(), choice.files.begin(), choice.files.end());
    if (geometry.cut_along_walls) cut_quads(made, geometry.file);
    warnings.insert(warnings.end(), made.warnings.begin(), made.warnings.end());
    read.report.counts = made.counts;
    if (made.quads.empty())
        throw InputError(Place{geometry.file}, "no surface is left: " + to_string(made.counts));
    read.scene.geometry_file = geometry.file;
    read.scene.materials = std::move(choice.materials);
    read.scene.quads = std::move(made.quads);
}

/// A file of lights, a camera and sensors, all of them checked, whichever is wanted.
struct Extras {
    std::optional<std::vector<DimmedLight>> lights;
    std::optional<Camera> camera;
};

Extras read_extras(const TomlTable& file, const Vec3& up) {
    Extras extras;
    if (file.has("light")) extras.lights = lights_from(file);
    if (file.has("camera")) extras.camera = camera_from(file.table("camera"), up);
    sensor_grids_from(file);
    file.refuse_unknown_keys();
    return extras;
}

}  // namespace

ReadScene read_scene(const std::string& path, AlbedoAboveOne above_one, const BareGeometry& bare) {
    ReadScene read;
    read.scene.name = std::filesystem::path(path).stem().string();
    GeometryChoice geometry;
    geometry.file = path;
    if (std::filesystem::path(path).extension() == ".toml") {
        if (bare.says_anything())
            throw InputError(Place{path},
                             "is a scene file, which says itself what unit its geometry has and "
                             "which way is up; only bare geometry needs to be told");
        geometry = read_scene_file(path, read);
        read.report.files.push_back(path);
    } else if (!is_mesh_file(path)) {
        throw InputError(Place{path},
                         "a scene is a scene file (.toml) or a geometry file (.obj, "
                         ".ply); convert other formats to one of these");
    }
    if (bare.metres_per_unit) geometry.metres_per_unit = *bare.metres_per_unit;
    if (bare.up) read.scene.up = *bare.up;
    read_geometry(geometry, above_one, read);
    return read;
}

std::vector<DimmedLight> read_dimmed_lights(const std::string& path) {
    const Extras extras = read_extras(TomlTable::read(path), Vec3::UnitZ());
    if (!extras.lights)
        throw InputError(Place{path}, "no [[light]] in the file (for none at all say light = [])");
    return *extras.lights;
}

std::vector<Light> read_lights(const std::string& path) {
    return shining(read_dimmed_lights(path));
}

Camera read_camera(const std::string& path, const Vec3& up) {
    const Extras extras = read_extras(TomlTable::read(path), up);
    if (!extras.camera) throw InputError(Place{path}, "no [camera] in the file");
    return *extras.camera;
}

}  // namespace lightwell
