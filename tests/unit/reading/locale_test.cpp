// Numbers must be read the same whatever the program's locale says of decimal points.

#include <locale>

#include <gtest/gtest.h>

#include "solver/reading/scene_reader.h"
#include "solver/reading/sensor_reader.h"
#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

/// Numbers as Germans write them.
class CommaPunctuation : public std::numpunct<char> {
  protected:
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

class Locale : public ::testing::Test {
  protected:
    Locale()
        : before_(std::locale::global(std::locale(std::locale::classic(), new CommaPunctuation))) {}
    ~Locale() override { std::locale::global(before_); }

  private:
    std::locale before_;
};

TEST_F(Locale, DoesNotMatter) {
    const testing::ScratchFolder folder;
    folder.write("a.mtl", "newmtl m\nKd 0.25 0.5 0.75\n");
    const std::string obj =
        folder.write("a.obj",
                     "mtllib a.mtl\nv 0.5 0 0\nv 1.5 0 0\nv 1.5 1.25 0\nv 0.5 1.25 0\nusemtl m\n"
                     "f 1 2 3 4\n");
    folder.write("a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0.5 0 0\n1.5 0 0\n1.5 1.25 0\n0.5 1.25 0\n4 0 1 2 3\n");
    const std::string toml =
        folder.write("a.toml",
                     "geometry = \"a.ply\"\nunit = 0.5\n[[light]]\ntype = \"point\"\n"
                     "position = [1000.25, 0.5, 0]\nintensity = 1.5\n");
    EXPECT_DOUBLE_EQ(read_scene(obj).scene.quads[0].quad.area(), 1.25);
    EXPECT_TRUE((read_scene(obj).scene.materials[0].reflectance == Rgb(0.25, 0.5, 0.75)).all());
    const ReadScene scene = read_scene(toml);
    EXPECT_DOUBLE_EQ(scene.scene.quads[0].quad.area(), 1.25 / 4);
    EXPECT_EQ(position_of(scene.scene.lights[0]), Vec3(1000.25, 0.5, 0));
    const std::string csv = folder.write("a.csv", "0.5,1.5,2.5,0,0,1\n");
    EXPECT_EQ(read_sensors_csv(csv)[0].position, Vec3(0.5, 1.5, 2.5));
    const std::string bad = folder.write("bad.toml", "geometry = \"a.ply\"\nunit = -2000.5\n");
    EXPECT_EQ(testing::input_error_of([&] { read_scene(bad); }),
              "bad.toml:2:8: unit -2000.5 is not within 1e-9 and 1e9 metres");
}

}  // namespace
}  // namespace lightwell
