#include "radiance4d/operator/scene_chunks.h"

#include <variant>

#include "radiance4d/operator/file_flaws.h"

namespace lightwell {

namespace {

constexpr std::size_t material_bytes = 4 + 6 * 8 + 2;
constexpr std::size_t quad_bytes = 12 * 8 + 3 * 4;
constexpr std::size_t light_bytes = 1 + 4 + 6 * 8;
constexpr std::size_t grid_bytes = 4 + 12 * 8 + 2 * 4;

void write(ByteWriter& writer, const Material& material) {
    writer.text(material.name);
    writer.triple(material.reflectance);
    writer.triple(material.emission);
    writer.number(static_cast<std::uint8_t>(material.reflecting));
    writer.number(static_cast<std::uint8_t>(material.emitting));
}

Material read_material(ByteReader& reader) {
    Material material;
    material.name = reader.text();
    material.reflectance = reader.colour();
    material.emission = reader.colour();
    material.reflecting = static_cast<Sides>(reader.choice(2));
    material.emitting = static_cast<Sides>(reader.choice(2));
    return material;
}

void write(ByteWriter& writer, const Lobe& lobe) {
    writer.number(static_cast<std::uint8_t>(lobe.index()));
    if (const auto* phong = std::get_if<PhongLobe>(&lobe)) {
        writer.triple(phong->reflectance);
        writer.number(phong->exponent);
    } else if (const auto* ggx = std::get_if<GgxLobe>(&lobe)) {
        writer.triple(ggx->reflectance);
        writer.number(ggx->roughness);
    }
}

Lobe read_lobe(ByteReader& reader) {
    const int kind = reader.choice(static_cast<int>(std::variant_size_v<Lobe>));
    if (kind == 0) return NoLobe{};
    const Rgb reflectance = reader.colour();
    const auto shape = reader.number<double>();
    if (kind == 1) return PhongLobe{reflectance, shape};
    return GgxLobe{reflectance, shape};
}

void write(ByteWriter& writer, const SceneQuad& quad) {
    for (const Vec3& vertex : quad.quad.vertex)
        writer.triple(vertex);
    for (const int number : {quad.material, quad.face, quad.line})
        writer.count(static_cast<std::size_t>(number));
}

SceneQuad read_quad(ByteReader& reader) {
    SceneQuad quad;
    for (Vec3& vertex : quad.quad.vertex)
        vertex = reader.triple();
    for (int* number : {&quad.material, &quad.face, &quad.line})
        *number = reader.index();
    return quad;
}

const Rgb& intensity_of(const Light& light) {
    return std::visit([](const auto& any) -> const Rgb& { return any.intensity; }, light);
}

void write(ByteWriter& writer, const Light& light) {
    const auto* spot = std::get_if<SpotLight>(&light);
    writer.number(static_cast<std::uint8_t>(light.index()));
    writer.text(name_of(light));
    writer.triple(position_of(light));
    writer.triple(intensity_of(light));
    if (!spot) return;
    writer.triple(spot->direction);
    writer.number(spot->inner_angle);
    writer.number(spot->outer_angle);
}

Light read_light(ByteReader& reader) {
    const int kind = reader.choice(2);
    PointLight point;
    point.name = reader.text();
    point.position = reader.triple();
    point.intensity = reader.colour();
    if (kind == 0) return point;
    SpotLight spot;
    spot.name = point.name;
    spot.position = point.position;
    spot.intensity = point.intensity;
    spot.direction = reader.triple();
    spot.inner_angle = reader.number<double>();
    spot.outer_angle = reader.number<double>();
    return spot;
}

void write(ByteWriter& writer, const Camera& camera) {
    writer.triple(camera.position);
    writer.triple(camera.target);
    writer.triple(camera.up);
    writer.number(camera.vertical_angle);
}

Camera read_camera(ByteReader& reader) {
    Camera camera;
    camera.position = reader.triple();
    camera.target = reader.triple();
    camera.up = reader.triple();
    camera.vertical_angle = reader.number<double>();
    return camera;
}

void write(ByteWriter& writer, const SensorGrid& grid) {
    writer.text(grid.name);
    writer.triple(grid.origin);
    writer.triple(grid.along);
    writer.triple(grid.across);
    writer.triple(grid.normal);
    writer.count(static_cast<std::size_t>(grid.columns));
    writer.count(static_cast<std::size_t>(grid.rows));
}

SensorGrid read_grid(ByteReader& reader) {
    SensorGrid grid;
    grid.name = reader.text();
    grid.origin = reader.triple();
    grid.along = reader.triple();
    grid.across = reader.triple();
    grid.normal = reader.triple();
    grid.columns = reader.index();
    grid.rows = reader.index();
    return grid;
}

}  // namespace

std::string surfaces_bytes(const Scene& scene) {
    ByteWriter writer;
    writer.count(scene.materials.size());
    writer.count(scene.quads.size());
    for (const Material& material : scene.materials)
        write(writer, material);
    for (const SceneQuad& quad : scene.quads)
        write(writer, quad);
    return writer.bytes();
}

void read_surfaces(ByteReader& reader, Scene& scene) {
    const std::uint32_t materials = reader.count(material_bytes);
    const std::uint32_t quads = reader.count(quad_bytes);
    for (std::uint32_t m = 0; m < materials; ++m)
        scene.materials.push_back(read_material(reader));
    for (std::uint32_t q = 0; q < quads; ++q)
        scene.quads.push_back(read_quad(reader));
    reader.finish();
    reader.require_no(flaw_of_surfaces(scene));
}

std::string lobes_bytes(const Scene& scene) {
    ByteWriter writer;
    bool any = false;
    for (const Material& material : scene.materials) {
        any = any || !std::holds_alternative<NoLobe>(material.lobe);
        write(writer, material.lobe);
    }
    return any ? writer.bytes() : std::string();
}

void read_lobes(ByteReader& reader, Scene& scene) {
    for (Material& material : scene.materials)
        material.lobe = read_lobe(reader);
    reader.finish();
    reader.require_no(flaw_of_surfaces(scene));
}

std::string surroundings_bytes(const Scene& scene) {
    ByteWriter writer;
    writer.text(scene.name);
    writer.text(scene.geometry_file);
    writer.triple(scene.up);
    writer.count(scene.lights.size());
    for (const Light& light : scene.lights)
        write(writer, light);
    writer.number(static_cast<std::uint8_t>(scene.camera.has_value()));
    if (scene.camera) write(writer, *scene.camera);
    writer.count(scene.sensor_grids.size());
    for (const SensorGrid& grid : scene.sensor_grids)
        write(writer, grid);
    return writer.bytes();
}

void read_surroundings(ByteReader& reader, Scene& scene) {
    scene.name = reader.text();
    scene.geometry_file = reader.text();
    scene.up = reader.triple();
    const std::uint32_t lights = reader.count(light_bytes);
    for (std::uint32_t l = 0; l < lights; ++l)
        scene.lights.push_back(read_light(reader));
    if (reader.choice(2) == 1) scene.camera = read_camera(reader);
    const std::uint32_t grids = reader.count(grid_bytes);
    for (std::uint32_t g = 0; g < grids; ++g)
        scene.sensor_grids.push_back(read_grid(reader));
    reader.finish();
    reader.require_no(flaw_of_surroundings(scene));
}

std::string dimmers_bytes(const std::vector<DimmedLight>& lights) {
    ByteWriter writer;
    bool any = false;
    for (const DimmedLight& dimmed : lights) {
        any = any || !dimmed.on || dimmed.dimmer != 1;
        writer.triple(intensity_of(dimmed.light));
        writer.number(dimmed.dimmer);
        writer.number(static_cast<std::uint8_t>(dimmed.on));
    }
    return any ? writer.bytes() : std::string();
}

std::vector<DimmedLight> read_dimmers(ByteReader& reader, const Scene& scene) {
    std::vector<DimmedLight> lights = undimmed(scene.lights);
    for (DimmedLight& dimmed : lights) {
        const Rgb intensity = reader.colour();
        std::visit([&](auto& any) { any.intensity = intensity; }, dimmed.light);
        dimmed.dimmer = reader.number<double>();
        dimmed.on = reader.choice(2) == 1;
    }
    reader.finish();
    reader.require_no(flaw_of_dimmers(lights, scene));
    return lights;
}

}  // namespace lightwell
