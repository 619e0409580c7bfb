#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "solver/reading/scene_reader.h"
#include "tests/commands/program.h"
#include "tests/window/virtual_display.h"
#include "viewer/images/image_file.h"

namespace lightwell {
namespace {

using Json = nlohmann::json;

/// Libraries that a program loads when it starts.
std::string libraries_of(const std::string& program) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
        popen(("LD_TRACE_LOADED_OBJECTS=1 '" + program + "'").c_str(), "r"), pclose);
    std::string text;
    std::array<char, 256> block;
    while (pipe && fgets(block.data(), block.size(), pipe.get()))
        text += block.data();
    return text;
}

TEST(Window, ProgramsLoadOnlyTheOpenGlTheyDrawWith) {
    const std::string headless = libraries_of(LIGHTWELL_PROGRAM);
    ASSERT_NE(headless.find("libOSMesa"), std::string::npos) << headless;
    for (const char* library : {"libGL.", "libOpenGL.", "libglfw", "libX11", "libwayland"})
        EXPECT_EQ(headless.find(library), std::string::npos) << library;
    const std::string window = libraries_of(LIGHTWELL_VIEW_PROGRAM);
    ASSERT_NE(window.find("libglfw"), std::string::npos) << window;
    for (const char* library : {"libGL.", "libOpenGL.", "libOSMesa"})
        EXPECT_EQ(window.find(library), std::string::npos) << library;
}

TEST(Window, WithoutADisplayItSaysSoAndEndsWith2) {
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY"})
        unsetenv(variable);
    const ScratchFolder folder;
    const ProgramRun run = lightwell({"view", folder / "none.gto"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err.rfind("lightwell: there is no display", 0), 0u) << run.err;
    EXPECT_EQ(run.out, "");
}

TEST(Window, HelpNeedsNoDisplay) {
    unsetenv("DISPLAY");
    const ProgramRun run = lightwell({"view", "--help"});
    EXPECT_EQ(run.status, 0);
    EXPECT_NE(run.out.find("--replay"), std::string::npos);
    EXPECT_EQ(lightwell({"view"}).status, 1);
    EXPECT_EQ(lightwell({"view", "a.gto", "--size", "big"}).status, 1);
    EXPECT_EQ(lightwell({"view", "a.obj", "--unit", "yard"}).status, 1);
    EXPECT_EQ(lightwell({"view", "a.obj", "--up", "w"}).status, 1);
}

/// A window on the Cornell box, with input that was written down.
class CornellBoxWindow : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!display_.is_there()) GTEST_SKIP() << "Xvfb is not installed";
        file_ = precomputed(folder_, sample_scene("cornell-box"));
        std::filesystem::current_path(folder_.path());
    }
    ~CornellBoxWindow() override {
        std::filesystem::current_path(std::filesystem::temp_directory_path());
    }

    /// What the visit has come to after the input, in a window of 400 x 300.
    Json replayed(const std::string& input, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words = {
            "view", file_, "--size", "400x300", "--replay", folder_.write("replay.txt", input)};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = lightwell(words);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.err, "");
        return Json::parse(run.out, nullptr, false);
    }

    VirtualDisplay display_;
    ScratchFolder folder_;
    std::string file_;
};

/// A key that is pressed and let go.
std::string tap(const std::string& key) {
    return fmt::format("key {0} down\nkey {0} up\nframe 0.02\n", key);
}
std::string with_control(const std::string& key) {
    return "key control down\n" + tap(key) + "key control up\n";
}
std::string click(int x, int y) {
    return fmt::format(
        "cursor {} {}\nframe 0.02\nbutton left down\nframe 0.02\nbutton left up\nframe 0.02\n", x,
        y);
}
std::string drag(int x0, int y0, int x1, int y1, const std::string& button = "left") {
    return fmt::format(
        "cursor {0} {1}\nframe 0.02\nbutton {4} down\nframe 0.02\ncursor {5} {6}\nframe "
        "0.02\ncursor {2} {3}\nframe 0.02\nbutton {4} up\nframe 0.02\n",
        x0, y0, x1, y1, button, (x0 + x1) / 2, (y0 + y1) / 2);
}

TEST_F(CornellBoxWindow, WalksAndStopsAtTheBackWallUnlessTold) {
    // From 8 m before the box to its back wall, 5.59 m behind the front, at 4 times 2 m/s.
    const std::string walk = "key shift down\nkey w down\nframes 8 0.25\nkey w up\nframe 0.02\n";
    Json visit = replayed(tap("tab") + walk);
    EXPECT_NEAR(visit["eye"][1].get<double>(), 5.592 - 0.19, 0.02);
    EXPECT_NEAR(visit["eye"][2].get<double>(), 2.73, 1e-6);
    visit = replayed(tap("tab") + tap("n") + walk);
    EXPECT_NEAR(visit["eye"][1].get<double>(), -8 + 8 * 0.25 * 8, 1e-9);
}

TEST_F(CornellBoxWindow, IsExposedForThePictureBesideThePanel) {
    const auto exposure_after = [&](const std::string& input) {
        const ProgramRun run = lightwell(
            {"view", file_, "--size", "900x300", "--replay", folder_.write("r.txt", input)});
        return Json::parse(run.out)["exposure"].get<double>();
    };
    EXPECT_EQ(exposure_after("frames 3 0.02\n"), exposure_after("frames 3 0.02\n" + tap("x")));
}

TEST_F(CornellBoxWindow, LooksAroundWhereTheMouseDrags) {
    const Json visit =
        replayed(tap("tab") + drag(200, 250, 350, 250, "right") + drag(200, 270, 200, 220));
    const double yaw = 150 * 0.2 * M_PI / 180, pitch = 50 * 0.2 * M_PI / 180;
    EXPECT_NEAR(visit["forward"][0].get<double>(), std::sin(yaw) * std::cos(pitch), 1e-6);
    EXPECT_NEAR(visit["forward"][2].get<double>(), std::sin(pitch), 1e-6);
}

TEST_F(CornellBoxWindow, DragsALampUndoesSavesAndLoads) {
    const std::string camera =
        folder_.write("eye.toml",
                      "[camera]\nposition = [4.6, -8, 3.6]\ntarget = [4.6, 0, 3.6]\nvertical_angle "
                      "= 40\n");
    // The lamp is in the middle of the picture.
    const std::string dragged = tap("tab") + drag(200, 150, 230, 150);
    Json visit = replayed(dragged + with_control("s"), {"--camera", camera});
    const double metres_per_pixel = 9.2 * std::tan(20 * M_PI / 180) / 150;
    EXPECT_NEAR(visit["lights"][0]["position"][0].get<double>(), 4.6 + 30 * metres_per_pixel, 1e-6);
    EXPECT_NEAR(visit["lights"][0]["position"][2].get<double>(), 3.6, 1e-6);
    const std::vector<Light> saved = read_lights("scene.lights.toml");
    ASSERT_EQ(saved.size(), 1u);
    EXPECT_NEAR(position_of(saved[0])[0], 4.6 + 30 * metres_per_pixel, 1e-6);

    visit = replayed(dragged + with_control("z"), {"--camera", camera});
    EXPECT_EQ(visit["lights"][0]["position"][0], 4.6);
    visit = replayed(with_control("o"), {"--camera", camera});
    EXPECT_NEAR(visit["lights"][0]["position"][0].get<double>(), 4.6 + 30 * metres_per_pixel, 1e-6);
    EXPECT_NEAR(visit["eye"][0].get<double>(), 4.6, 1e-9);
}

TEST_F(CornellBoxWindow, ALampThatIsLoadedCanBeSwitchedAtOnceAndIsAsDimAsItWas) {
    const std::string lamps = folder_.write(
        "lamps.toml",
        "[[light]]\nname = \"dim\"\ntype = \"point\"\nposition = [2, 2, 3]\nintensity = 80\n"
        "dimmer = 0.3\non = false\n");
    const std::string drop = "drop " + lamps + "\nframe 0.02\n";
    Json visit = replayed(drop);
    EXPECT_EQ(visit["lights"][0]["on"], false);
    EXPECT_EQ(visit["lights"][0]["dimmer"], 0.3);
    visit = replayed(drop + tap("space") + with_control("s"));
    EXPECT_EQ(visit["lights"][0]["on"], true);
    EXPECT_EQ(visit["lights"][0]["dimmer"], 0.3);
    EXPECT_NEAR(luminance(std::get<PointLight>(read_lights(lamps)[0]).intensity), 24, 1e-9);
}

TEST_F(CornellBoxWindow, AddsSwitchesAndDeletesLamps) {
    Json visit = replayed(tap("l") + tap("space"));
    ASSERT_EQ(visit["lights"].size(), 2u);
    EXPECT_EQ(visit["lights"][1]["name"], "lamp 2");
    EXPECT_EQ(visit["lights"][1]["on"], false);
    EXPECT_NEAR(visit["lights"][1]["position"][1].get<double>(), -7, 1e-9);
    visit = replayed(tap("l") + tap("delete") + with_control("z") + with_control("z"));
    EXPECT_EQ(visit["lights"].size(), 1u);
}

TEST_F(CornellBoxWindow, TheProbeReadsWhatIsMeasuredThere) {
    const Json visit = replayed(tap("tab") + click(200, 285));
    ASSERT_TRUE(visit.contains("probe")) << visit.dump();
    const Json at = visit["probed"];
    EXPECT_NEAR(at[2].get<double>(), 0, 1e-6);  // the floor
    const std::string sensors = folder_.write(
        "s.csv", fmt::format("{},{},0,0,0,1\n", at[0].get<double>(), at[1].get<double>()));
    const ProgramRun run = lightwell({"measure", file_, "--no-gather", "--sensors", sensors});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto row = table_from(run.out).at(0);
    const auto lux = [&row](const std::string& part) {
        return 0.2126 * row.at(part + "_r") + 0.7152 * row.at(part + "_g") +
               0.0722 * row.at(part + "_b");
    };
    const Json& probe = visit["probe"];
    EXPECT_NEAR(probe["direct"].get<double>(), lux("direct"), 1e-4 * lux("direct"));
    EXPECT_NEAR(probe["indirect"].get<double>(), lux("indirect"), 0.01 * lux("indirect"));
    // Each bounce is weaker than the one before, once light is all over the room.
    const auto bounces = probe["bounces"].get<std::vector<double>>();
    ASSERT_GE(bounces.size(), 5u);
    for (std::size_t k = 2; k < bounces.size(); ++k)
        EXPECT_LT(bounces[k], bounces[k - 1]);
}

TEST_F(CornellBoxWindow, ShowsEveryPictureAndWritesIt) {
    std::string input = tap("tab");
    for (int k = 1; k <= 7; ++k)
        input +=
            tap(fmt::format("digit_{}", k)) +
            fmt::format("picture p{0}.png\npicture p{0}.exr\nwindow w{0}.png\nframe 0.02\n", k);
    const Json visit = replayed(input);
    EXPECT_EQ(visit["picture"], 7);
    const char* units[] = {"cd/m2", "cd/m2", "cd/m2", "lx", "display", "display", "display"};
    for (int k = 1; k <= 7; ++k) {
        const ExrPicture picture = read_exr(fmt::format("p{}.exr", k));
        EXPECT_EQ(picture.image.width(), 400);
        EXPECT_EQ(picture.image.height(), 300);
        EXPECT_EQ(picture.unit, units[k - 1]);
        for (const char* name : {"p", "w"})
            EXPECT_EQ(contents(fmt::format("{}{}.png", name, k)).substr(1, 3), "PNG");
        for (int other = 1; other < k; ++other)
            EXPECT_NE(contents(fmt::format("w{}.png", k)), contents(fmt::format("w{}.png", other)));
    }
}

TEST_F(CornellBoxWindow, ThePanelTakesTheInputThatIsMeantForIt) {
    // A drag and letters on the panel neither look around nor walk.
    const Json visit =
        replayed("frames 2 0.02\n" + drag(320, 60, 380, 75) + "text 63\nframe 0.02\n");
    EXPECT_NEAR(visit["forward"][1].get<double>(), 1, 1e-9);
    EXPECT_EQ(visit["help"], true);
}

TEST_F(CornellBoxWindow, AMistakeInAFileIsSaidBeforeAnythingIsShown) {
    EXPECT_EQ(lightwell({"view", folder_ / "none.gto"}).status, 1);
    const std::string replay = folder_.write("bad.txt", "frame 0.1\nkey nothing down\n");
    const ProgramRun run = lightwell({"view", file_, "--replay", replay});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err.rfind("lightwell: " + replay + ":2:5: ", 0), 0u) << run.err;
}

TEST_F(CornellBoxWindow, ASceneIsComputedWhileOneLooks) {
    file_ = sample_scene("cornell-box");
    const Json visit = replayed("frame 0.02\n", {"--error", "0.3"});
    ASSERT_FALSE(visit["messages"].empty());
    EXPECT_NE(visit["messages"][0].get<std::string>().find("30 %"), std::string::npos);
}

TEST_F(CornellBoxWindow, ALampThatIsOffInTheSceneComesBackInItsFile) {
    const std::string box =
        std::filesystem::path(sample_scene("cornell-box")).parent_path() / "cornell-box.obj";
    file_ = precomputed(folder_, folder_.write("off.toml", "geometry = '" + box +
                                                               "'\n[[light]]\ntype = \"point\"\n"
                                                               "position = [1, 2, 3]\nintensity = "
                                                               "40\ndimmer = 0.5\non = false\n"));
    const Json visit = replayed(tap("space"));
    ASSERT_EQ(visit["lights"].size(), 1u);
    EXPECT_EQ(visit["lights"][0]["on"], true);
    EXPECT_EQ(visit["lights"][0]["dimmer"], 0.5);
    EXPECT_EQ(visit["lights"][0]["intensity"][0], 40);
    EXPECT_EQ(replayed("frame 0.02\n")["lights"][0]["on"], false);
    const ProgramRun resumed = lightwell(
        {"precompute", "--resume", file_, "--error", "0.25", "--attempts", "0", "--quiet"});
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(replayed(tap("space"))["lights"][0]["intensity"][0], 40);
}

TEST_F(CornellBoxWindow, WhatMakesLightIsScaledOnRequest) {
    file_ = folder_.write("two.obj",
                          "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                          "v 1 1 1\nv 0 1 1\nusemtl mirror\nf 1 2 3 4\nf 8 7 6 5\n");
    folder_.write("two.mtl", "newmtl mirror\nKd 0.7 0.7 0.7\nKs 0.5 0.5 0.5\nNs 1\n");
    EXPECT_EQ(lightwell({"view", file_}).status, 1);
    const Json visit =
        replayed("frame 0.02\n", {"--error", "0.3", "--max-memory", "2G", "--scale-albedo"});
    EXPECT_NE(visit["messages"].dump().find("scaled by 0.8333"), std::string::npos)
        << visit["messages"];
}

TEST_F(CornellBoxWindow, TheLampThatAModelWithoutLampsGetsIsNobodysToUndo) {
    file_ = folder_.write("two.obj",
                          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
                          "v 0 1 1\nf 1 2 3 4\nf 8 7 6 5\n");
    const Json visit = replayed(with_control("z"), {"--error", "0.3"});
    ASSERT_EQ(visit["lights"].size(), 1u);
    EXPECT_EQ(visit["selected"], 0);
}

TEST_F(CornellBoxWindow, FilesAreDroppedOnIt) {
    const std::string lights = folder_.write(
        "two.toml",
        "[[light]]\ntype = \"point\"\nposition = [1, 1, 1]\nintensity = 5\n[[light]]\ntype = "
        "\"point\"\nposition = [2, 2, 2]\nintensity = 7\n");
    const Json visit = replayed("drop " + lights + "\nframes 2 0.02\ndrop none.gto\nframe 0.02\n");
    ASSERT_EQ(visit["lights"].size(), 2u);
    EXPECT_EQ(visit["lights"][1]["intensity"][0], 7);
    EXPECT_NE(visit["messages"].dump().find("2 lamps from"), std::string::npos);
    EXPECT_NE(visit["messages"].back().get<std::string>().find("none.gto"), std::string::npos);
}

TEST_F(CornellBoxWindow, WithoutOpenGl33ItSaysSoAndEndsWith2) {
    setenv("MESA_GL_VERSION_OVERRIDE", "3.2", 1);
    const ProgramRun run = lightwell({"view", file_});
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("OpenGL 3.3"), std::string::npos) << run.err;
}

TEST_F(CornellBoxWindow, ReadsTheFileAgainWhenAnotherTakesItsName) {
    if (!is_installed("xdotool")) GTEST_SKIP() << "xdotool is not installed";
    const ScratchFolder other;
    const std::string furnace = precomputed(other, sample_scene("furnace"));
    auto ended = std::async(std::launch::async, [&] {
        return lightwell({"view", file_, "--size", "200x150"});
    });
    EXPECT_NE(xdotool("search --sync --onlyvisible --name '^Lightwell: Cornell'"), "");
    std::filesystem::copy_file(furnace, file_ + ".new");
    std::filesystem::rename(file_ + ".new", file_);
    EXPECT_NE(xdotool("search --sync --onlyvisible --name '^Lightwell: [Ff]urnace'"), "");
    xdotool("mousemove 20 100 key ctrl+q");
    ASSERT_EQ(ended.wait_for(std::chrono::seconds(60)), std::future_status::ready);
    EXPECT_EQ(ended.get().status, 0);
}

/// Runs while real keys and a real mouse act on the window.
TEST_F(CornellBoxWindow, ObeysRealKeysAndARealMouse) {
    if (!is_installed("xdotool")) GTEST_SKIP() << "xdotool is not installed";
    const std::string record = folder_ / "recorded.txt";
    auto ended = std::async(std::launch::async, [&] {
        return lightwell({"view", file_, "--size", "400x300", "--record", record});
    });
    const std::string window = xdotool("search --sync --onlyvisible --name '^Lightwell: '");
    ASSERT_NE(window, "");
    // Pauses let a slow machine draw between what it must tell apart.
    xdotool("mousemove 300 200 key Tab sleep 1 mousemove 200 285 sleep 1 click 1 sleep 1");
    xdotool("keydown w sleep 1 keyup w key l sleep 1 key ctrl+s sleep 1 key ctrl+q");
    ASSERT_EQ(ended.wait_for(std::chrono::seconds(60)), std::future_status::ready);
    const ProgramRun run = ended.get();
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(read_lights("scene.lights.toml").size(), 2u);
    EXPECT_GT(read_camera("scene.lights.toml").position[1], -8);

    // What was recorded comes to the same when it is played again.
    const Json visit = replayed(contents(record));
    EXPECT_TRUE(visit.contains("probed")) << visit.dump();
    EXPECT_EQ(visit["lights"].size(), 2u);
}

}  // namespace
}  // namespace lightwell
