#include "tests/unit/operator_file/sample_transport.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <sstream>

#include "radiance4d/operator/operator_chunks.h"
#include "radiance4d/operator/provenance_chunk.h"
#include "radiance4d/operator/scene_chunks.h"

namespace lightwell::testing {

namespace {

Quad rectangle(const Vec3& corner, const Vec3& along, const Vec3& across) {
    return {{corner, corner + along, corner + along + across, corner + across}};
}

Scene sample_scene() {
    Scene scene;
    scene.name = "a room";
    scene.geometry_file = "models/r\xC3\xB6om.obj";
    scene.up = Vec3::UnitY();
    scene.materials = {{"paint", Rgb(0.1, 0.5, 1.0), Rgb::Zero(), Sides::both, Sides::front},
                       {"lamp #2", Rgb::Zero(), Rgb(100, 90, 1.0 / 3), Sides::front, Sides::both}};
    scene.quads = {
        {rectangle(Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 1, 0)), 0, 0, 12},
        {rectangle(Vec3(0, 0, 2), Vec3(1.0 / 3, 0, 0), Vec3(0, 1, 0)), 1, 1, 13},
        {{{Vec3(0, 0, 1), Vec3(1, 0.1, 1), Vec3(0.9, 1.2, 1), Vec3(0.1, 0.7, 1)}}, 0, 2, 14},
        {rectangle(Vec3(5, 5, 5), Vec3(0, 2, 0), Vec3(0, 0, 1)), 0, 2, 14},
        {rectangle(Vec3(7, 5, 5), Vec3(0, 2, 0), Vec3(0, 0, 1)), 0, 3, 0}};
    scene.lights = {PointLight{"bulb", Vec3(1, 2, 3), Rgb(10, 20, 30)},
                    SpotLight{"spot", Vec3(0, 1, 0.1), Rgb(5, 5, 5), Vec3::UnitX(), 10.5, 45}};
    scene.camera = Camera{Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3::UnitY(), 60};
    scene.sensor_grids = {
        {"desk", Vec3(0, 0.8, 0), Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY(), 7, 5},
        {"", Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY(), 1, 1}};
    return scene;
}

Element element_of(const Scene& scene, int quad, bool front, std::vector<Split> space,
                   std::vector<Split> angle, std::vector<OpenMask> open = {}) {
    const Quad& geometry = scene.quads[static_cast<std::size_t>(quad)].quad;
    Element element;
    element.quad = quad;
    element.front = front;
    element.geometry = front ? geometry : geometry.reversed();
    element.set_space(CellTree(std::move(space)), std::move(open));
    element.angle = CellTree(std::move(angle));
    return element;
}

}  // namespace

TransportOperator random_operator(std::uint32_t size, std::uint32_t per_column, bool upper_half,
                                  std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> magnitude(-6.0F, 3.0F);
    TransportOperator result;
    result.size = size;
    result.column_start.push_back(0);
    std::set<std::uint32_t> rows;
    for (std::uint32_t column = 0; column < size; ++column) {
        rows.clear();
        for (auto k = random() % (per_column + 1); k > 0; --k)
            rows.insert(static_cast<std::uint32_t>(random()) % (upper_half ? column + 1 : size));
        for (const std::uint32_t row : rows) {
            result.row.push_back(row);
            const float value = std::exp(magnitude(random));
            result.value.push_back(random() % 2 == 0 ? value : -value);
        }
        result.column_start.push_back(result.row.size());
    }
    return result;
}

GlobalTransport sample_transport(std::uint32_t per_column) {
    using S = Split;
    GlobalTransport transport;
    transport.scene = sample_scene();
    const Scene& scene = transport.scene;
    transport.space = RadianceSpace(
        {element_of(scene, 0, true, {S::u, S::both}, {}),
         element_of(scene, 0, false, {}, {S::both}),
         element_of(scene, 2, true, {S::both, S::v}, {S::both, S::both},
                    {all_open, 0, 1, 0xff00ff, all_open, all_open, 7, all_open}),
         element_of(scene, 1, false, {S::v}, {}), element_of(scene, 3, true, {}, {})});
    const std::uint32_t size = transport.space.functions();
    transport.bounce.upper = random_operator(size, per_column, true, 1);
    transport.indirect = {random_operator(size, per_column, false, 2),
                          random_operator(size, per_column, false, 3)};
    transport.channel = {0, 1, 0};
    transport.provenance = {
        "lightwell 0.1.0",     "geometric", 0.05, 0.1 / 3, 0.25, 1e-4,          1e-300,
        18446744073709551615U, 123456789,   14,   5e-3,    0.07, "path tracing"};
    return transport;
}

std::string fingerprint(const GlobalTransport& transport) {
    std::ostringstream text;
    text << surfaces_bytes(transport.scene) << surroundings_bytes(transport.scene);
    text << std::hexfloat;
    for (const Element& element : transport.space.elements()) {
        text << "element " << element.quad << element.front << ' ' << element.first << ' '
             << element.functions();
        for (const Vec3& vertex : element.geometry.vertex)
            text << ' ' << vertex.transpose();
        for (std::uint32_t p = 0; p < element.space.tree().positions(); ++p)
            text << ' ' << element.space.area(element.space.tree().at(p));
        for (const OpenMask mask : element.open)
            text << " mask " << mask;
        for (const Split split : element.angle.splits())
            text << " split " << static_cast<int>(split);
    }
    text << transport.space.functions() << transport.space.area();
    for (const int number : transport.channel)
        text << " channel " << number;
    text << index_bytes(transport.bounce.upper) << value_bytes(transport.bounce.upper);
    for (const TransportOperator& channel : transport.indirect)
        text << "channel" << index_bytes(channel) << value_bytes(channel);
    text << provenance_bytes(transport.provenance, "{}");
    return text.str();
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void put_bytes(const std::string& path, const std::string& bytes) {
    // A file that is cut to nothing and filled again would be forced to the disk by some systems.
    std::filesystem::remove(path);
    std::ofstream file(path, std::ios::binary);
    file << bytes;
}

}  // namespace lightwell::testing
