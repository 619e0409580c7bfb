#include "solver/reading/scene_tables.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/polygon_soup.h"

namespace lightwell {

namespace {

/// More columns or rows than this are taken as a slip.
constexpr std::int64_t most_sensors_in_line = 100'000;
constexpr std::int64_t most_sensors = 10'000'000;

std::string text_of(const Rgb& colour) {
    return fmt::format("[{}, {}, {}]", colour[0], colour[1], colour[2]);
}

Rgb non_negative_colour(const TomlTable& table, const std::string& key) {
    const Rgb value = table.colour(key);
    if ((value < 0).any() || (value > brightest).any())
        table.fail(key, key + " " + text_of(value) + " is negative or too large");
    return value;
}

/// A place [m].
Vec3 position_from(const TomlTable& table, const std::string& key) {
    const Vec3 value = table.vector(key);
    if ((value.array().abs() > largest_coordinate).any())
        table.fail(key, fmt::format("{} is beyond {:g} metres", key, largest_coordinate));
    return value;
}

Rgb reflectance_from(const TomlTable& table, const std::string& key) {
    const Rgb value = table.colour(key);
    if ((value < 0).any() || (value > 1).any())
        table.fail(key, key + " " + text_of(value) + " is not within 0 and 1");
    return value;
}

double number_within(const TomlTable& table, const std::string& key, double lowest,
                     double highest) {
    const double value = table.number(key);
    if (!(value >= lowest && value <= highest))
        table.fail(key, fmt::format("{} {} is not within {} and {}", key, value, lowest, highest));
    return value;
}

/// What a material's table says about its lobe.
void lobe_from(const TomlTable& table, MaterialDescription& material) {
    if (table.has("specular")) material.specular = reflectance_from(table, "specular");
    if (table.has("exponent"))
        material.exponent = number_within(table, "exponent", 0, largest_exponent);
    if (table.has("roughness")) {
        if (material.exponent)
            table.fail("roughness",
                       "a lobe has an exponent (Phong) or a roughness (GGX), not both");
        material.roughness = number_within(table, "roughness", 0.01, 1);
    }
}

Sides sides_from(const TomlTable& table, const std::string& key) {
    const std::string value = table.text(key);
    if (value == "front") return Sides::front;
    if (value == "both") return Sides::both;
    table.fail(key, key + " must be \"front\" or \"both\", not " + in_quotes(value));
}

/// A vector that is not zero.
Vec3 direction_from(const TomlTable& table, const std::string& key) {
    const Vec3 value = table.vector(key);
    if (!(value.stableNorm() > 0)) table.fail(key, key + " has no length");
    return value;
}

/// A length in a direction [m].
Vec3 side_from(const TomlTable& table, const std::string& key) {
    direction_from(table, key);
    return position_from(table, key);
}

std::string name_from(const TomlTable& table, const std::string& otherwise) {
    return table.has("name") ? table.text("name") : otherwise;
}

/// An angle [degrees] within lowest and highest.
double angle_from(const TomlTable& table, const std::string& key, double lowest, double highest) {
    const double angle = table.number(key);
    if (!(angle >= lowest && angle <= highest))
        table.fail(
            key, fmt::format("{} {} is not within {} and {} degrees", key, angle, lowest, highest));
    return angle;
}

Light spot_from(const TomlTable& table, const std::string& name) {
    SpotLight spot;
    spot.name = name;
    spot.position = position_from(table, "position");
    spot.intensity = non_negative_colour(table, "intensity");
    spot.direction = direction_from(table, "direction").stableNormalized();
    spot.outer_angle = angle_from(table, "outer_angle", 0, 180);
    spot.inner_angle = angle_from(table, "inner_angle", 0, spot.outer_angle);
    if (spot.outer_angle == 0) table.fail("outer_angle", "outer_angle 0: the spot has no beam");
    return spot;
}

Light point_from(const TomlTable& table, const std::string& name) {
    return PointLight{name, position_from(table, "position"),
                      non_negative_colour(table, "intensity")};
}

int count_from(const TomlTable& table, const std::string& key) {
    const std::int64_t count = table.whole_number(key);
    if (count < 1 || count > most_sensors_in_line)
        table.fail(key,
                   fmt::format("{} {} is not within 1 and {}", key, count, most_sensors_in_line));
    return static_cast<int>(count);
}

SensorGrid sensor_grid_from(const TomlTable& table, const std::string& name) {
    SensorGrid grid;
    grid.name = name;
    grid.origin = position_from(table, "origin");
    grid.along = side_from(table, "along");
    grid.across = side_from(table, "across");
    grid.columns = count_from(table, "columns");
    grid.rows = count_from(table, "rows");
    if (static_cast<std::int64_t>(grid.columns) * grid.rows > most_sensors)
        table.fail("rows", fmt::format("{} x {} sensors; at most {} are taken", grid.columns,
                                       grid.rows, most_sensors));
    if (table.has("normal")) {
        grid.normal = direction_from(table, "normal").stableNormalized();
    } else {
        const Vec3 across_both =
            grid.along.stableNormalized().cross(grid.across.stableNormalized());
        if (!(across_both.norm() > 1e-9))
            table.fail("across", "across is parallel to along: the grid needs a normal");
        grid.normal = across_both.normalized();
    }
    table.refuse_unknown_keys();
    return grid;
}

}  // namespace

DimmedLight light_from(const TomlTable& table, const std::string& name) {
    const std::string type = table.text("type");
    if (type != "point" && type != "spot")
        table.fail("type", "type must be \"point\" or \"spot\", not " + in_quotes(type));
    DimmedLight dimmed{type == "spot" ? spot_from(table, name) : point_from(table, name)};
    if (table.has("dimmer")) dimmed.dimmer = number_within(table, "dimmer", 0, 1);
    if (table.has("on")) dimmed.on = table.flag("on");
    table.refuse_unknown_keys();
    return dimmed;
}

std::vector<DimmedLight> lights_from(const TomlTable& file) {
    std::vector<DimmedLight> lights;
    for (const TomlTable& table : file.tables("light")) {
        const std::string name = name_from(table, fmt::format("light {}", lights.size() + 1));
        lights.push_back(light_from(table, name));
    }
    return lights;
}

Camera camera_from(const TomlTable& table, const Vec3& up) {
    Camera camera;
    camera.position = position_from(table, "position");
    camera.target = position_from(table, "target");
    camera.up = table.has("up") ? direction_from(table, "up") : up;
    if (table.has("vertical_angle")) {
        camera.vertical_angle = angle_from(table, "vertical_angle", 0, 180);
        if (camera.vertical_angle == 0 || camera.vertical_angle == 180)
            table.fail("vertical_angle", "vertical_angle must lie between 0 and 180 degrees");
    }
    const Vec3 axis = camera.target - camera.position;
    if (!(axis.stableNorm() > 0)) table.fail("target", "target is where the camera stands");
    const double sine = axis.stableNormalized().cross(camera.up.stableNormalized()).norm();
    if (!(sine > 1e-6))
        table.fail(table.has("up") ? "up" : "target",
                   "the camera looks along its up direction; give another up");
    table.refuse_unknown_keys();
    return camera;
}

std::vector<SensorGrid> sensor_grids_from(const TomlTable& file) {
    std::vector<SensorGrid> grids;
    for (const TomlTable& table : file.tables("sensors")) {
        const std::string name = name_from(table, fmt::format("sensors {}", grids.size() + 1));
        grids.push_back(sensor_grid_from(table, name));
    }
    return grids;
}

std::vector<MaterialDescription> materials_from(const TomlTable& file) {
    std::vector<MaterialDescription> materials;
    if (!file.has("material")) return materials;
    const TomlTable all = file.table("material");
    for (const std::string& name : all.keys()) {
        const TomlTable table = all.table(name);
        MaterialDescription material;
        material.name = name;
        material.place = table.place();
        if (table.has("reflectance")) material.reflectance = reflectance_from(table, "reflectance");
        lobe_from(table, material);
        if (table.has("emission")) material.emission = non_negative_colour(table, "emission");
        if (table.has("sides")) material.reflecting = sides_from(table, "sides");
        if (table.has("emission_sides")) material.emitting = sides_from(table, "emission_sides");
        table.refuse_unknown_keys();
        materials.push_back(material);
    }
    return materials;
}

}  // namespace lightwell
