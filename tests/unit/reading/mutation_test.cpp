// Damages small sound files in thousands of ways and reads them: only an InputError may come out.

#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "solver/reading/scene_reader.h"
#include "solver/reading/sensor_reader.h"
#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

constexpr int mutations = 600;

/// A copy with a few bytes flipped, replaced by ones that mean something, repeated, or cut off.
std::string damaged(std::string bytes, std::mt19937& random) {
    static const std::string meaningful = "0123456789-+.e/# \n\\\"[]=,{}\0\xff\xfe";
    const auto below = [&](std::size_t n) { return random() % n; };
    for (std::size_t change = 1 + below(4); change > 0 && !bytes.empty(); --change) {
        const std::size_t at = below(bytes.size());
        switch (below(6)) {
            case 0:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            case 1:
                bytes[at] = meaningful[below(meaningful.size())];
                break;
            case 2:
                bytes.insert(at, 1, meaningful[below(meaningful.size())]);
                break;
            case 3:
                bytes.erase(at, 1 + below(8));
                break;
            case 4:
                bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(30)));
                break;
            default:
                if (below(4) == 0) bytes.resize(at);
        }
    }
    return bytes;
}

/// Reads many damaged copies; counts those that are refused, which must be some but not all.
void expect_only_input_errors(const std::string& name, const std::string& sound,
                              const testing::ScratchFolder& folder,
                              const std::function<void(const std::string&)>& read) {
    std::mt19937 random(20060626);
    int refused = 0;
    for (int i = 0; i < mutations; ++i) {
        const std::string bytes = damaged(sound, random);
        const std::string path = folder.write(name, bytes);
        try {
            read(path);
        } catch (const InputError&) {
            ++refused;
        } catch (const std::exception& other) {
            FAIL() << "mutation " << i << ": " << other.what() << "\n" << bytes;
        }
    }
    EXPECT_GT(refused, mutations / 10);
    EXPECT_LT(refused, mutations);
}

const std::string cube_vertices =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";

class Mutation : public ::testing::Test {
  protected:
    static void read_as_scene(const std::string& path) {
        const ReadScene read = read_scene(path);
        for (const SceneQuad& quad : read.scene.quads) {
            EXPECT_GT(quad.quad.area(), 0);
            EXPECT_TRUE(quad.quad.centre().allFinite());
        }
    }
    testing::ScratchFolder folder;
};

TEST_F(Mutation, OfAnObj) {
    expect_only_input_errors("a.obj",
                             "mtllib a.mtl\n" + cube_vertices +
                                 "usemtl red\nf 1 2 3 4\nf 8/1 7/1 6/1 5/1\nusemtl grey\n"
                                 "f 1//1 5//1 6//1\nf 1/1/1 6/1/1 2/1/1\nf -8 -5 -6 -2 -1\n",
                             folder, read_as_scene);
}

TEST_F(Mutation, OfAnMtl) {
    const std::string geometry =
        folder.write("a.obj", "mtllib a.mtl\n" + cube_vertices + "usemtl red\nf 1 2 3 4\n");
    expect_only_input_errors(
        "a.mtl", "newmtl red\nKd 0.8 0.1 0.1\nKe 1 2 3\nKs 0 0 0\nd 1\nnewmtl b\nKd 0.5\n", folder,
        [&](const std::string&) { read_as_scene(geometry); });
}

TEST_F(Mutation, OfATextPly) {
    expect_only_input_errors(
        "a.ply",
        "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty uchar f\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 3 0 1 2\n1 3 0 2 3\n",
        folder, read_as_scene);
}

TEST_F(Mutation, OfABinaryPly) {
    std::string bytes =
        "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty uchar x\nproperty uchar y\n"
        "property char z\nelement edge 1\nproperty list ushort uchar ends\nelement face 2\n"
        "property list uint uchar vertex_indices\nend_header\n";
    bytes += std::string("\0\0\0\5\0\0\5\5\0\0\5\0", 12) + std::string("\0\2\7\7", 4) +
             std::string("\0\0\0\3\0\1\2\0\0\0\3\0\2\3", 14);
    expect_only_input_errors("a.ply", bytes, folder, read_as_scene);
}

TEST_F(Mutation, OfASceneFile) {
    folder.write("a.obj", cube_vertices + "usemtl red\nf 1 2 3 4\n");
    expect_only_input_errors(
        "a.toml",
        "name = \"x\"\ngeometry = \"a.obj\"\nunit = \"m\"\nup = \"y\"\ndefault_material = \"red\"\n"
        "[material.red]\nreflectance = [0.1, 0.2, 0.3]\nsides = \"front\"\n"
        "[[light]]\ntype = \"spot\"\nposition = [1, 2, 3]\nintensity = 5\n"
        "direction = [0, 0, -1]\ninner_angle = 10\nouter_angle = 20\n"
        "[camera]\nposition = [1, 2, 3]\ntarget = [0, 0, 0]\n"
        "[[sensors]]\norigin = [0, 0, 0]\nalong = [1, 0, 0]\nacross = [0, 1, 0]\n"
        "columns = 2\nrows = 3\n",
        folder, read_as_scene);
}

TEST_F(Mutation, OfASensorFile) {
    expect_only_input_errors("a.csv", "x,y,z,nx,ny,nz\n0.5,1,2,0,0,1\n\n# c\n1,2,3,0.6,0,0.8\n",
                             folder, [](const std::string& path) {
                                 for (const Sensor& sensor : read_sensors_csv(path))
                                     EXPECT_NEAR(sensor.normal.norm(), 1, 1e-12);
                             });
}

}  // namespace
}  // namespace lightwell
