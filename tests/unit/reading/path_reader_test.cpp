#include "solver/reading/path_reader.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using testing::input_error_of;
using testing::ScratchFolder;

const std::string camera_keys = R"([[camera]]
time = 0
position = [1, 2, 3]
target = [1, 5, 3]

[[camera]]
time = 2.5
position = [2, 2, 3]
target = [1, 5, 3]
vertical_angle = 40
)";

std::string lamp_key(const std::string& time, const std::string& type = "point") {
    return "[[light]]\nname = \"lamp\"\ntype = \"" + type + "\"\ntime = " + time +
           "\nposition = [0, 0, 1]\nintensity = 10\n" +
           (type == "spot" ? "direction = [0, 0, -1]\ninner_angle = 10\nouter_angle = 20\n" : "");
}

TEST(PathReader, ReadsKeysOfACameraAndOfLights) {
    const ScratchFolder folder;
    const Keyframes keyframes = read_path(folder.write(
        "p.toml", "frames_per_second = 10\n" + camera_keys + lamp_key("1") + lamp_key("2")));
    EXPECT_EQ(keyframes.frames_per_second, 10);
    ASSERT_EQ(keyframes.camera.size(), 2U);
    EXPECT_EQ(keyframes.camera[1].time, 2.5);
    EXPECT_EQ(keyframes.camera[1].camera.position, Vec3(2, 2, 3));
    EXPECT_EQ(keyframes.camera[1].camera.vertical_angle, 40);
    ASSERT_EQ(keyframes.lights.size(), 1U);
    ASSERT_EQ(keyframes.lights[0].size(), 2U);
    EXPECT_EQ(keyframes.lights[0][1].time, 2);
    EXPECT_EQ(keyframes.frames(), 26);
}

TEST(PathReader, SaysWhereAPathIsWrong) {
    const ScratchFolder folder;
    const std::pair<std::string, std::string> cases[] = {
        {"", "no [[camera]] and no [[light]]"},
        {"frames_per_second = 0\n" + camera_keys, "p.toml:1:21: frames_per_second 0"},
        {camera_keys + camera_keys, "p.toml:12:8: time 0 is not after the key before, 2.5"},
        {lamp_key("-1"), "p.toml:4:8: time -1 is not within"},
        {lamp_key("1") + lamp_key("2", "spot"), "p.toml:9:8: 'lamp' has another type"},
        {lamp_key("1") + "colour = 3\n", "p.toml:7:1: unknown key 'colour'"},
        {"frames_per_second = 1000\n" + lamp_key("0") + lamp_key("1000"), "at most 100000"},
        {"[[camera]]\nposition = [1, 2, 3]\ntarget = [1, 5, 3]\n", "time"},
    };
    for (const auto& test : cases) {
        const std::string& text = test.first;
        const std::string error = input_error_of([&] { read_path(folder.write("p.toml", text)); });
        EXPECT_NE(error.find(test.second), std::string::npos)
            << error << "\nshould say: " << test.second;
    }
}

}  // namespace
}  // namespace lightwell
