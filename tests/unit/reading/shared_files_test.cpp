// Reads every mesh file that is kept beside the checkout: broken ones and real ones.

#include <chrono>
#include <set>

#include <gtest/gtest.h>

#include "radiance4d/scene/brdf.h"
#include "solver/reading/scene_reader.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using Clock = std::chrono::steady_clock;

/// [s] Sanitizers slow everything down.
#ifdef __SANITIZE_ADDRESS__
constexpr double time_limit = 10;
#else
constexpr double time_limit = 1;
#endif

/// Everything later stages rely on.
void expect_sound(const Scene& scene, const std::string& file) {
    ASSERT_FALSE(scene.quads.empty()) << file;
    for (std::size_t i = 0; i < scene.quads.size(); ++i) {
        const SceneQuad& quad = scene.quads[i];
        const double size = (quad.quad.vertex[2] - quad.quad.vertex[0]).norm();
        EXPECT_GT(quad.quad.area(), 0) << file << " " << scene.describe(static_cast<int>(i));
        EXPECT_LE(quad.quad.out_of_plane(), 1e-9 * size) << file;
        EXPECT_GE(quad.material, 0) << file;
        EXPECT_LT(quad.material, static_cast<int>(scene.materials.size())) << file;
    }
}

/// The scene, or nothing where an InputError says why not; in under a second either way.
std::optional<ReadScene> read_in_time(const std::filesystem::path& file) {
    const auto start = Clock::now();
    std::optional<ReadScene> read;
    try {
        read = read_scene(file.string());
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(':'), std::string::npos) << error.what();
    }
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), time_limit) << file;
    return read;
}

TEST(SharedFiles, HostileFilesEndInAReadOrAnInputError) {
    const auto shared = testing::shared_folder();
    if (!shared) GTEST_SKIP() << "no shared folder beside the checkout (LIGHTWELL_SHARED)";
    const std::set<std::string> kinds = {".obj", ".ply", ".off", ".stl"};
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*shared / "hostile")) {
        if (kinds.count(entry.path().extension().string()) == 0) continue;
        ++files;
        if (const auto read = read_in_time(entry.path()))
            expect_sound(read->scene, entry.path().string());
    }
    EXPECT_GE(files, 100);
}

/// Elements and dropped faces a hostile file must give; 0 elements: it must be refused.
struct Expectation {
    const char* file;
    int elements;
};

class HostileFile : public ::testing::TestWithParam<Expectation> {};

TEST_P(HostileFile, GivesWhatItSays) {
    const auto shared = testing::shared_folder();
    if (!shared) GTEST_SKIP() << "no shared folder beside the checkout (LIGHTWELL_SHARED)";
    const auto read = read_in_time(*shared / "hostile" / GetParam().file);
    EXPECT_EQ(read ? read->report.counts.elements : 0, GetParam().elements);
}

// Checked by hand against what each file says.
INSTANTIATE_TEST_SUITE_P(
    SharedFiles, HostileFile,
    ::testing::Values(
        Expectation{"probes/bom.obj", 1}, Expectation{"probes/cont.obj", 1},
        Expectation{"probes/comma.obj", 0}, Expectation{"probes/dup.obj", 3},
        Expectation{"probes/dupface.obj", 1}, Expectation{"probes/flip.obj", 2},
        Expectation{"probes/nonman.obj", 3}, Expectation{"probes/fakebin.ply", 0},
        Expectation{"probes/qf.ply", 1}, Expectation{"assimp/box_UTF16BE.obj", 0},
        Expectation{"assimp/box.obj", 6}, Expectation{"assimp/box_longline.obj", 6},
        Expectation{"assimp/testmixed.obj", 6}, Expectation{"assimp/cube_binary.ply", 6},
        Expectation{"assimp/cube_binary_header_with_RN_newline.ply", 6},
        Expectation{"assimp/cube_binary_starts_with_nl.ply", 6},
        Expectation{"tinyobj/issue-138.obj", 6},
        Expectation{"tinyobj/issue-161-inconsistent-f.obj", 6},
        Expectation{"tinyobj/usemtl-issue-104.obj", 3}, Expectation{"tinyobj/line-prim.obj", 0},
        Expectation{"tinyobj/cornell_box.obj", 23}, Expectation{"trimesh/nancolor.obj", 6},
        Expectation{"trimesh/negative_indices.obj", 6},
        Expectation{"trimesh/polygonfaces.obj", 9}));

TEST(SharedFiles, HolesThatAreJoinedToTheRimStayOpen) {
    const auto shared = testing::shared_folder();
    if (!shared) GTEST_SKIP() << "no shared folder beside the checkout (LIGHTWELL_SHARED)";
    // A ring between two circles, written as one outline that walks the bridge between them twice.
    const auto read = read_in_time(*shared / "hostile/assimp/concave_polygon.obj");
    ASSERT_TRUE(read);
    double area = 0;
    for (const SceneQuad& quad : read->scene.quads)
        area += quad.quad.area();
    const auto polygon = [](double radius) {  // regular, of 32 corners
        return 16 * radius * radius * std::sin(2 * M_PI / 32);
    };
    EXPECT_NEAR(area, polygon(0.7425) - polygon(0.6875), 2e-4);
}

struct Counts {
    const char* file;
    int faces, quads, triangles, bent;
};

class RealScene : public ::testing::TestWithParam<Counts> {};

TEST_P(RealScene, HasTheFacesOfItsFile) {
    const auto shared = testing::shared_folder();
    if (!shared) GTEST_SKIP() << "no shared folder beside the checkout (LIGHTWELL_SHARED)";
    const auto read = read_in_time(*shared / "scenes" / GetParam().file);
    ASSERT_TRUE(read);
    const PolygonCounts& counts = read->report.counts;
    EXPECT_EQ(counts.faces, GetParam().faces);
    EXPECT_EQ(counts.quads, GetParam().quads);
    EXPECT_EQ(counts.triangles, GetParam().triangles);
    EXPECT_EQ(counts.bent, GetParam().bent);
    EXPECT_EQ(counts.degenerate + counts.crossing, 0);
    // What is not kept is paired or cut, and nothing is lost.
    EXPECT_EQ(2 * counts.pairs + counts.cut, counts.triangles + 2 * counts.bent);
    EXPECT_EQ(counts.elements, counts.quads + counts.pairs + 3 * counts.cut - counts.copies -
                                   counts.along_walls + counts.pieces);
    expect_sound(read->scene, GetParam().file);
}

INSTANTIATE_TEST_SUITE_P(
    SharedFiles, RealScene,
    ::testing::Values(Counts{"hospital/hospital_floor_01_core.obj", 760, 710, 47, 3},
                      Counts{"hospital/hospital_floor_01.obj", 2575, 2504, 47, 24},
                      Counts{"lost-empire/crop_r12_2982.obj", 2982, 2982, 0, 0},
                      Counts{"freedoom/dm03.obj", 485, 476, 9, 0},
                      Counts{"freedoom/e1m1.obj", 2937, 2778, 159, 0},
                      Counts{"tb3-house/tb3_house.obj", 564, 564, 0, 0},
                      Counts{"cornell-mcguire/CornellBox-Original.obj", 18, 17, 0, 1},
                      Counts{"cornell-embree/cornell_box.obj", 17, 16, 0, 1}));

TEST(SharedFiles, TheMcGuireBoxKeepsItsMaterials) {
    const auto shared = testing::shared_folder();
    if (!shared) GTEST_SKIP() << "no shared folder beside the checkout (LIGHTWELL_SHARED)";
    const auto read = read_in_time(*shared / "scenes/cornell-mcguire/CornellBox-Original.obj");
    ASSERT_TRUE(read);
    for (const Material& material : read->scene.materials) {
        if (material.name == "light") {
            EXPECT_TRUE((material.emission == Rgb(17, 12, 4)).all());
        }
        if (material.name == "leftWall") {
            EXPECT_TRUE((material.reflectance == Rgb(0.63, 0.065, 0.05)).all());
        }
    }
}

// The box names the materials of its sister, in which the sphere has Kd 0.663 and Ks 0.9.
TEST(SharedFiles, TheGlossyMcGuireBoxIsRefusedOrScaled) {
    const auto shared = testing::shared_folder();
    if (!shared) GTEST_SKIP() << "no shared folder beside the checkout (LIGHTWELL_SHARED)";
    const std::string file =
        (*shared / "scenes/cornell-mcguire/CornellBox-Glossy-Floor.obj").string();
    const std::string refusal = testing::input_error_of([&] { read_scene(file); });
    EXPECT_NE(refusal.find("1.563 of the blue at 0 degrees"), std::string::npos) << refusal;
    const ReadScene read = read_scene(file, AlbedoAboveOne::scale);
    int phongs = 0;
    for (const Material& material : read.scene.materials) {
        EXPECT_LE(albedo_peak(material).albedo, 1 + 1e-9) << material.name;
        if (std::holds_alternative<PhongLobe>(material.lobe)) ++phongs;
    }
    EXPECT_EQ(phongs, 2);
}

// Its own materials, which it does not name: Kd 0.725 and Ks 0.3 of the floor make 1.025.
TEST(SharedFiles, TheGlossyMcGuireFloorIsScaled) {
    const auto shared = testing::shared_folder();
    if (!shared) GTEST_SKIP() << "no shared folder beside the checkout (LIGHTWELL_SHARED)";
    std::vector<Warning> warnings;
    const auto file = *shared / "scenes/cornell-mcguire/CornellBox-Glossy-Floor.mtl";
    PolygonSoup soup;
    soup.file = file.string();
    soup.material_libraries.push_back({"CornellBox-Glossy-Floor.mtl", Place{file.string()}});
    soup.materials.push_back({"floor", Place{file.string()}});
    EXPECT_THROW(choose_materials(soup, {}, "", AlbedoAboveOne::refuse, warnings), InputError);
    const MaterialChoice choice = choose_materials(soup, {}, "", AlbedoAboveOne::scale, warnings);
    ASSERT_EQ(choice.materials.size(), 1u);
    EXPECT_NEAR(choice.materials[0].reflectance[0], 0.725 / 1.025, 1e-9);
    const auto& phong = std::get<PhongLobe>(choice.materials[0].lobe);
    EXPECT_NEAR(phong.reflectance[0], 0.3 / 1.025, 1e-9);
    EXPECT_EQ(phong.exponent, 32);
}

}  // namespace
}  // namespace lightwell
