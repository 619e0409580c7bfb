#include <limits>

#include <gtest/gtest.h>

#include "radiance4d/failure.h"
#include "radiance4d/operator/operator_file.h"
#include "radiance4d/operator/provenance_chunk.h"
#include "tests/scratch_folder.h"
#include "tests/unit/operator_file/sample_transport.h"

namespace lightwell::testing {

namespace {

class RoundTrip : public ::testing::Test {
  protected:
    GlobalTransport through_file(const GlobalTransport& transport) const {
        write_operator_file(path_, transport);
        return read_operator_file(path_);
    }

    std::size_t chunks_of(const GlobalTransport& transport) const {
        write_operator_file(path_, transport);
        return inspect_operator_file(path_).chunks.size();
    }

    ScratchFolder folder_;
    std::string path_ = folder_ / "room.gto";
};

void expect_equal(const TransportOperator& a, const TransportOperator& b) {
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.column_start, b.column_start);
    EXPECT_EQ(a.row, b.row);
    EXPECT_EQ(a.value, b.value);
}

/// One wall with a fine tree: many functions, and rows far apart.
GlobalTransport fine_wall(int levels, std::uint32_t per_column) {
    GlobalTransport transport;
    transport.scene.materials.emplace_back();
    const Quad wall{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
    transport.scene.quads.push_back({wall, 0, 0, 0});
    Element element;
    element.geometry = wall;
    element.space = HaarBasis(
        wall, CellTree(std::vector<Split>(static_cast<std::size_t>(levels), Split::both)));
    transport.space = RadianceSpace({element});
    const std::uint32_t size = transport.space.functions();
    transport.bounce.upper = random_operator(size, per_column, true, 5);
    transport.indirect = {random_operator(size, per_column, false, 6)};
    return transport;
}

}  // namespace

TEST_F(RoundTrip, KeepsSurfaces) {
    const GlobalTransport transport = sample_transport();
    const Scene read = through_file(transport).scene;
    ASSERT_EQ(read.materials.size(), transport.scene.materials.size());
    for (std::size_t m = 0; m < read.materials.size(); ++m) {
        const Material &a = read.materials[m], &b = transport.scene.materials[m];
        EXPECT_EQ(a.name, b.name);
        EXPECT_TRUE((a.reflectance == b.reflectance).all());
        EXPECT_TRUE((a.emission == b.emission).all());
        EXPECT_EQ(a.reflecting, b.reflecting);
        EXPECT_EQ(a.emitting, b.emitting);
    }
    ASSERT_EQ(read.quads.size(), transport.scene.quads.size());
    for (std::size_t q = 0; q < read.quads.size(); ++q) {
        const SceneQuad &a = read.quads[q], &b = transport.scene.quads[q];
        EXPECT_EQ(a.quad.vertex, b.quad.vertex);
        EXPECT_EQ(a.material, b.material);
        EXPECT_EQ(a.face, b.face);
        EXPECT_EQ(a.line, b.line);
    }
}

TEST_F(RoundTrip, KeepsLobes) {
    GlobalTransport transport = sample_transport();
    const std::size_t chunks = chunks_of(transport);
    transport.scene.materials[0].reflectance = Rgb(0.1, 0.2, 0.3);
    transport.scene.materials[0].lobe = GgxLobe{Rgb(0.5, 0.25, 0.125), 0.3};
    EXPECT_EQ(chunks_of(transport), chunks + 1);
    transport.scene.materials[1].lobe = PhongLobe{Rgb(0.75, 0.5, 0.25), 1.0 / 3};
    const Scene read = through_file(transport).scene;
    const auto& ggx = std::get<GgxLobe>(read.materials[0].lobe);
    EXPECT_TRUE((ggx.reflectance == Rgb(0.5, 0.25, 0.125)).all());
    EXPECT_EQ(ggx.roughness, 0.3);
    const auto& phong = std::get<PhongLobe>(read.materials[1].lobe);
    EXPECT_TRUE((phong.reflectance == Rgb(0.75, 0.5, 0.25)).all());
    EXPECT_EQ(phong.exponent, 1.0 / 3);
}

TEST_F(RoundTrip, KeepsSurroundings) {
    const GlobalTransport transport = sample_transport();
    const Scene read = through_file(transport).scene;
    EXPECT_EQ(read.name, "a room");
    EXPECT_EQ(read.geometry_file, transport.scene.geometry_file);
    EXPECT_EQ(read.up, Vec3(Vec3::UnitY()));
    ASSERT_EQ(read.lights.size(), 2U);
    const auto& bulb = std::get<PointLight>(read.lights[0]);
    EXPECT_EQ(bulb.name, "bulb");
    EXPECT_EQ(bulb.position, Vec3(1, 2, 3));
    EXPECT_TRUE((bulb.intensity == Rgb(10, 20, 30)).all());
    const auto& spot = std::get<SpotLight>(read.lights[1]);
    EXPECT_EQ(spot.name, "spot");
    EXPECT_EQ(spot.position, Vec3(0, 1, 0.1));
    EXPECT_TRUE((spot.intensity == Rgb(5, 5, 5)).all());
    EXPECT_EQ(spot.direction, Vec3(Vec3::UnitX()));
    EXPECT_EQ(spot.inner_angle, 10.5);
    EXPECT_EQ(spot.outer_angle, 45);
    ASSERT_TRUE(read.camera);
    EXPECT_EQ(read.camera->position, Vec3(1, 1, 1));
    EXPECT_EQ(read.camera->target, Vec3(2, 2, 2));
    EXPECT_EQ(read.camera->up, Vec3(Vec3::UnitY()));
    EXPECT_EQ(read.camera->vertical_angle, 60);
    ASSERT_EQ(read.sensor_grids.size(), 2U);
    const SensorGrid& desk = read.sensor_grids[0];
    EXPECT_EQ(desk.name, "desk");
    EXPECT_EQ(desk.origin, Vec3(0, 0.8, 0));
    EXPECT_EQ(desk.along, Vec3(Vec3::UnitX()));
    EXPECT_EQ(desk.across, Vec3(Vec3::UnitZ()));
    EXPECT_EQ(desk.normal, Vec3(Vec3::UnitY()));
    EXPECT_EQ(desk.columns, 7);
    EXPECT_EQ(desk.rows, 5);
}

// The sample's lights: a bulb that is off, at 40 %, and a spot at a third.
std::vector<DimmedLight> dimmed(GlobalTransport& transport) {
    std::vector<DimmedLight> lights = undimmed(transport.scene.lights);
    lights[0].dimmer = 0.4;
    lights[0].on = false;
    lights[1].dimmer = 1.0 / 3;
    transport.scene.lights = shining(lights);
    return lights;
}

TEST_F(RoundTrip, KeepsHowLightsAreDimmed) {
    GlobalTransport transport = sample_transport();
    const std::vector<DimmedLight> lights = dimmed(transport);
    write_operator_file(path_, transport, "{}", lights);
    std::vector<DimmedLight> read;
    const Scene scene = read_operator_file(path_, &read).scene;
    EXPECT_TRUE((std::get<PointLight>(scene.lights[0]).intensity == 0).all());
    EXPECT_TRUE((std::get<SpotLight>(scene.lights[1]).intensity == 5 * (1.0 / 3)).all());
    ASSERT_EQ(read.size(), 2U);
    EXPECT_TRUE((std::get<PointLight>(read[0].light).intensity == Rgb(10, 20, 30)).all());
    EXPECT_EQ(read[0].dimmer, 0.4);
    EXPECT_FALSE(read[0].on);
    EXPECT_TRUE((std::get<SpotLight>(read[1].light).intensity == 5).all());
    EXPECT_EQ(read[1].dimmer, 1.0 / 3);
    EXPECT_TRUE(read[1].on);
    EXPECT_EQ(inspect_operator_file(path_).lights[0].dimmer, 0.4);
}

TEST_F(RoundTrip, SpendsNothingOnLightsThatShineInFull) {
    const GlobalTransport transport = sample_transport();
    write_operator_file(path_, transport);
    const std::string bytes = bytes_of(path_);
    write_operator_file(path_, transport, "{}", undimmed(transport.scene.lights));
    EXPECT_EQ(bytes_of(path_), bytes);
    std::vector<DimmedLight> read;
    static_cast<void>(read_operator_file(path_, &read));
    ASSERT_EQ(read.size(), 2U);
    EXPECT_TRUE(read[1].on);
    EXPECT_EQ(read[1].dimmer, 1);
    EXPECT_TRUE((std::get<SpotLight>(read[1].light).intensity == 5).all());
}

TEST_F(RoundTrip, RefusesToWriteDimmersOfOtherLights) {
    GlobalTransport transport = sample_transport();
    std::vector<DimmedLight> lights = dimmed(transport);
    lights[1].dimmer = 0.5;
    EXPECT_THROW(write_operator_file(path_, transport, "{}", lights), BrokenInvariant);
    lights.pop_back();
    EXPECT_THROW(write_operator_file(path_, transport, "{}", lights), BrokenInvariant);
}

TEST_F(RoundTrip, KeepsElementsAndTheirBases) {
    const GlobalTransport transport = sample_transport();
    const RadianceSpace read = through_file(transport).space;
    ASSERT_EQ(read.elements().size(), transport.space.elements().size());
    EXPECT_EQ(read.functions(), transport.space.functions());
    for (std::size_t e = 0; e < read.elements().size(); ++e) {
        const Element &a = read.element(e), &b = transport.space.element(e);
        EXPECT_EQ(a.quad, b.quad);
        EXPECT_EQ(a.front, b.front);
        EXPECT_EQ(a.first, b.first);
        EXPECT_EQ(a.geometry.vertex, b.geometry.vertex);
        EXPECT_EQ(a.space.tree(), b.space.tree());
        EXPECT_EQ(a.angle, b.angle);
        EXPECT_EQ(a.open, b.open);
        for (std::uint32_t p = 0; p < a.space.tree().positions(); ++p)
            EXPECT_EQ(a.space.area(a.space.tree().at(p)), b.space.area(b.space.tree().at(p)));
    }
}

TEST_F(RoundTrip, KeepsOperatorsAndProvenance) {
    const GlobalTransport transport = sample_transport();
    const GlobalTransport read = through_file(transport);
    expect_equal(read.bounce.upper, transport.bounce.upper);
    ASSERT_EQ(read.indirect.size(), 2U);
    expect_equal(read.indirect[0], transport.indirect[0]);
    expect_equal(read.indirect[1], transport.indirect[1]);
    EXPECT_EQ(read.channel, transport.channel);
    const Provenance &a = read.provenance, &b = transport.provenance;
    EXPECT_EQ(a.program, b.program);
    EXPECT_EQ(a.oracle, b.oracle);
    EXPECT_EQ(a.error_asked, b.error_asked);
    EXPECT_EQ(a.error_estimated, b.error_estimated);
    EXPECT_EQ(a.cell_size, b.cell_size);
    EXPECT_EQ(a.oracle_tolerance, b.oracle_tolerance);
    EXPECT_EQ(a.truncation, b.truncation);
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.links, b.links);
    EXPECT_EQ(a.bounces, b.bounces);
    EXPECT_EQ(a.energy_dropped, b.energy_dropped);
    EXPECT_EQ(a.error_bound, b.error_bound);
    EXPECT_EQ(a.error_basis, b.error_basis);
}

TEST(Provenance, OfFilesWithoutABoundIsRead) {
    Provenance provenance;
    provenance.error_bound = 0.07;
    provenance.error_basis = "path tracing";
    std::string bytes = provenance_bytes(provenance, "{}");
    for (const std::string& later :
         {std::string("\"error_bound\":0.07,"), std::string("\"error_basis\":\"path tracing\",")}) {
        ASSERT_NE(bytes.find(later), std::string::npos);
        bytes.erase(bytes.find(later), later.size());
    }
    ByteReader reader(bytes, "chunk PROV");
    std::string options;
    const Provenance read = read_provenance(reader, options);
    EXPECT_EQ(read.error_bound, 0);
    EXPECT_EQ(read.error_basis, "");
}

TEST_F(RoundTrip, KeepsExtremeValues) {
    GlobalTransport transport = fine_wall(1, 0);
    using Float = std::numeric_limits<float>;
    transport.indirect[0].row = {0, 1, 2, 3};
    transport.indirect[0].value = {Float::max(), -Float::max(), Float::denorm_min(), -0.0F};
    transport.indirect[0].column_start = {0, 4, 4, 4, 4};
    const TransportOperator read = through_file(transport).indirect[0];
    expect_equal(read, transport.indirect[0]);
    EXPECT_TRUE(std::signbit(read.value[3]));
}

TEST_F(RoundTrip, KeepsAnEmptyScene) {
    GlobalTransport transport;
    transport.bounce.upper.column_start = {0};
    transport.indirect.emplace_back();
    transport.indirect[0].column_start = {0};
    const GlobalTransport read = through_file(transport);
    EXPECT_TRUE(read.scene.quads.empty());
    EXPECT_FALSE(read.scene.camera);
    EXPECT_EQ(read.space.functions(), 0U);
}

// Gaps between rows take one byte, two and three.
TEST_F(RoundTrip, KeepsRowsOfAnyDistance) {
    for (const int levels : {2, 5, 9}) {
        const GlobalTransport transport = fine_wall(levels, 3);
        const GlobalTransport read = through_file(transport);
        expect_equal(read.bounce.upper, transport.bounce.upper);
        expect_equal(read.indirect[0], transport.indirect[0]);
    }
}

// Nearly nothing in many columns packs better than a reader believes, and is stored plain.
TEST_F(RoundTrip, KeepsWhatPacksTooWell) {
    GlobalTransport transport = fine_wall(9, 0);
    transport.indirect.push_back(transport.indirect[0]);
    transport.channel = {0, 1, 1};
    EXPECT_EQ(through_file(transport).indirect[1].size, transport.space.functions());
}

TEST_F(RoundTrip, GivesEqualBytesForEqualInput) {
    const std::string other = folder_ / "other.gto";
    write_operator_file(path_, sample_transport(30), R"({"b": 1, "a": "x"})");
    write_operator_file(other, read_operator_file(path_), R"({"a":"x","b":1})");
    EXPECT_EQ(bytes_of(path_), bytes_of(other));
}

TEST_F(RoundTrip, InspectionTellsWhatIsInside) {
    const GlobalTransport transport = sample_transport(30);
    write_operator_file(path_, transport, R"({"error": 0.05, "threads": 2})");
    const OperatorFileInfo info = inspect_operator_file(path_);
    EXPECT_EQ(info.version, 1U);
    EXPECT_EQ(info.bytes, bytes_of(path_).size());
    EXPECT_EQ(info.scene_hash, scene_hash(transport.scene));
    EXPECT_EQ(info.scene.quads.size(), 5U);
    EXPECT_EQ(info.elements, 5U);
    EXPECT_EQ(info.functions, transport.space.functions());
    EXPECT_EQ(info.dto_coefficients, transport.bounce.coefficients());
    ASSERT_EQ(info.gto_coefficients.size(), 2U);
    EXPECT_EQ(info.gto_coefficients[1], transport.indirect[1].coefficients());
    EXPECT_EQ(info.channel, transport.channel);
    EXPECT_EQ(info.provenance.rays, transport.provenance.rays);
    EXPECT_EQ(info.options_json, R"({"error":0.05,"threads":2})");
    ASSERT_EQ(info.chunks.size(), 11U);
    EXPECT_EQ(info.chunks.front().tag, "SCEN");
    EXPECT_EQ(info.chunks.back().offset + info.chunks.back().stored, info.bytes);
}

TEST(SceneHash, IsOfSurfacesOnly) {
    const Scene scene = sample_transport().scene;
    Scene other = scene;
    other.lights.clear();
    other.geometry_file = "elsewhere.obj";
    EXPECT_EQ(scene_hash(other), scene_hash(scene));
    other.materials[0].reflectance[1] = 0.51;
    EXPECT_NE(scene_hash(other), scene_hash(scene));
    other = scene;
    other.materials[1].lobe = PhongLobe{Rgb::Constant(0.5), 10};
    EXPECT_NE(scene_hash(other), scene_hash(scene));
}

// What a reader would refuse is our own mistake when it is written.
TEST_F(RoundTrip, RefusesToWriteNonsense) {
    const auto expect_refusal = [&](const auto& spoil) {
        GlobalTransport transport = sample_transport();
        spoil(transport);
        EXPECT_THROW(write_operator_file(path_, transport), BrokenInvariant);
    };
    expect_refusal([](auto& t) { t.bounce.upper.value[0] = NAN; });
    expect_refusal([](auto& t) { t.indirect[1].row[3] = t.indirect[1].size; });
    expect_refusal([](auto& t) { t.indirect[1].row.pop_back(); });
    expect_refusal([](auto& t) { t.channel[2] = 2; });
    expect_refusal([](auto& t) { t.indirect.clear(); });
    expect_refusal([](auto& t) { t.scene.materials[0].reflectance[0] = 1.01; });
    expect_refusal([](auto& t) { t.scene.materials[1].lobe = PhongLobe{Rgb::Constant(0.5), -1}; });
    expect_refusal([](auto& t) { t.scene.materials[1].lobe = GgxLobe{Rgb::Constant(0.5), 0}; });
    expect_refusal([](auto& t) { t.scene.materials[1].lobe = GgxLobe{Rgb::Constant(1.5), 1}; });
    // Each part in [0,1], their sum is not.
    expect_refusal([](auto& t) { t.scene.materials[0].lobe = PhongLobe{Rgb::Constant(0.5), 9}; });
    expect_refusal([](auto& t) { t.scene.quads[0].quad.vertex[1][0] += 1e-9; });
    expect_refusal([](auto& t) { t.provenance.error_asked = INFINITY; });
    expect_refusal([](auto& t) {
        std::vector<Element> elements = t.space.elements();
        elements[2].open.clear();
        t.space = RadianceSpace(elements);
    });
    EXPECT_THROW(write_operator_file(path_, sample_transport(), "[1]"), BrokenInvariant);
    EXPECT_THROW(write_operator_file(path_, sample_transport(), "{"), BrokenInvariant);
    EXPECT_EQ(folder_.names().size(), 0U);
}

}  // namespace lightwell::testing
