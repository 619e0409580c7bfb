#include <cmath>
#include <csignal>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/commands/program.h"
#include "viewer/images/image_file.h"

namespace lightwell {
namespace {

using Words = std::vector<std::string>;

class RenderedCornellBox : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new ScratchFolder;
        file_ = precomputed(*folder_, sample_scene("cornell-box"), "0.2");
    }
    static void TearDownTestSuite() { delete folder_; }

    /// The picture in linear light.
    static ExrPicture rendered(const Words& more, const std::string& size = "64x48") {
        const std::string output = *folder_ / "p.exr";
        Words words = {"render", file_, "-o", output, "--size", size};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = lightwell(words);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.out + run.err, "");
        return read_exr(output);
    }

    static ScratchFolder* folder_;
    static std::string file_;
};
ScratchFolder* RenderedCornellBox::folder_ = nullptr;
std::string RenderedCornellBox::file_;

TEST_F(RenderedCornellBox, HasTheSizeAskedForAndTheUnitOfItsView) {
    for (const char* view : {"total", "direct", "indirect", "lux", "level"}) {
        const ExrPicture picture = rendered({"--view", view}, "40x30");
        EXPECT_EQ(picture.image.width(), 40);
        EXPECT_EQ(picture.image.height(), 30);
        const std::string unit = picture.unit;
        EXPECT_EQ(unit, std::string(view) == "lux"     ? "lx"
                        : std::string(view) == "level" ? "display"
                                                       : "cd/m2");
        const ProgramRun png =
            lightwell({"render", file_, "-o", *folder_ / (view + std::string(".png")), "--size",
                       "40x30", "--view", view});
        EXPECT_EQ(png.status, 0) << png.err;
        EXPECT_EQ(contents(*folder_ / (view + std::string(".png"))).substr(1, 3), "PNG");
    }
}

TEST_F(RenderedCornellBox, TotalIsDirectAndIndirect) {
    const Image total = rendered({}).image, direct = rendered({"--view", "direct"}).image,
                indirect = rendered({"--view", "indirect"}).image;
    double brightest = 0;
    for (int y = 0; y < total.height(); ++y)
        for (int x = 0; x < total.width(); ++x) {
            const Image::Pixel sum = direct.at(x, y) + indirect.at(x, y);
            EXPECT_TRUE((total.at(x, y) - sum).abs().maxCoeff() <= 1e-5f * (1 + sum.maxCoeff()));
            brightest = std::max(brightest, static_cast<double>(total.at(x, y)[0]));
        }
    // The luminaire is seen: 1,400 cd/m2 of its own, and a little that it reflects.
    EXPECT_GT(brightest, 1400);
    EXPECT_LT(brightest, 1500);
}

TEST_F(RenderedCornellBox, LuxIsWhatIsMeasuredThereAndLuminanceWhatTheFloorReflects) {
    // A camera that looks straight down on one point of the floor through a narrow angle.
    const std::string camera = folder_->write("down.toml",
                                              "[camera]\nposition = [1, 1.5, 2]\ntarget = [1, 1.5, "
                                              "0]\nup = [0, 1, 0]\nvertical_angle = 0.1\n");
    const ExrPicture picture =
        rendered({"--view", "lux", "--no-gather", "--camera", camera}, "1x1");
    const ProgramRun run = lightwell(
        {"measure", file_, "--no-gather", "--sensors", folder_->write("s.csv", "1,1.5,0,0,0,1\n")});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto row = table_from(run.out).at(0);
    const ExrPicture total = rendered({"--no-gather", "--camera", camera}, "1x1");
    const char channels[] = {'r', 'g', 'b'};
    const double white[] = {0.725, 0.71, 0.68};  // reflectance of the floor
    for (int c = 0; c < 3; ++c) {
        const double lux = row.at(fmt::format("direct_{}", channels[c])) +
                           row.at(fmt::format("indirect_{}", channels[c]));
        EXPECT_NEAR(picture.image.at(0, 0)[c], lux, 1e-3 * lux);
        EXPECT_NEAR(total.image.at(0, 0)[c], white[c] / M_PI * lux, 1e-3 * lux);
    }
}

TEST_F(RenderedCornellBox, GatheredLightIsTheSameLightMoreEven) {
    const Image plain = rendered({"--view", "indirect", "--no-gather"}).image;
    const Image gathered = rendered({"--view", "indirect"}).image;
    Eigen::Array3d plain_sum = Eigen::Array3d::Zero(), gathered_sum = Eigen::Array3d::Zero();
    for (std::size_t k = 0; k < plain.pixels().size(); ++k) {
        plain_sum += plain.pixels()[k].cast<double>();
        gathered_sum += gathered.pixels()[k].cast<double>();
    }
    EXPECT_LT(((gathered_sum - plain_sum) / plain_sum).abs().maxCoeff(), 0.05);
    EXPECT_GT((gathered_sum - plain_sum).abs().maxCoeff(), 0);
}

TEST_F(RenderedCornellBox, TexturesShowTheSameLightToTheErrorOfTheOperator) {
    const Image plain = rendered({"--view", "indirect", "--no-gather"}).image;
    const Image textured = rendered({"--view", "indirect", "--textures"}).image;
    double squares = 0, whole = 0;
    for (std::size_t k = 0; k < plain.pixels().size(); ++k) {
        squares += (plain.pixels()[k] - textured.pixels()[k]).cast<double>().square().sum();
        whole += plain.pixels()[k].cast<double>().square().sum();
    }
    EXPECT_LT(squares, 0.1 * 0.1 * whole);
    EXPECT_GT(squares, 0);
    const Words both = {"render", file_, "-o", *folder_ / "both.png", "--textures", "--no-gather"};
    EXPECT_EQ(lightwell(both).status, 1);
}

// Drawn by shaders or point by point, with the same indirect light: the same picture, but for the
// pixels that edges of shadows pass.
TEST_F(RenderedCornellBox, LivePicturesAreThoseDrawnPointByPoint) {
    for (const char* view : {"total", "direct", "indirect", "lux"}) {
        const Image plain = rendered({"--view", view, "--textures"}).image;
        const Image live = rendered({"--view", view, "--live"}).image;
        double off = 0, whole = 0;
        for (std::size_t k = 0; k < plain.pixels().size(); ++k) {
            off += static_cast<double>((plain.pixels()[k] - live.pixels()[k]).abs().sum());
            whole += static_cast<double>(plain.pixels()[k].sum());
        }
        EXPECT_LT(off, 0.004 * whole) << view;
    }
    const Image coefficients = rendered({"--view", "coefficients"}).image;
    EXPECT_GT(coefficients.at(32, 40).maxCoeff(), 0);
    EXPECT_EQ(
        lightwell({"render", file_, "--live", "--samples", "5", "-o", *folder_ / "5.png"}).status,
        1);
}

// A glossy floor that reflects an emitting ceiling and a lamp.
TEST(Render, ShowsGlossAlikeByShadersAndPointByPoint) {
    const ScratchFolder folder;
    folder.write("two.obj",
                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                 "usemtl floor\nf 1 2 3 4\nusemtl top\nf 8 7 6 5\n");
    const std::string scene =
        folder.write("scene.toml",
                     "geometry = \"two.obj\"\n[material.top]\nreflectance = 0.5\nemission = 10\n"
                     "[material.floor]\nreflectance = 0.1\nexponent = 20\nspecular = 0.6\n"
                     "[[light]]\ntype = \"point\"\nposition = [0.4, 0.7, 0.5]\nintensity = 10\n"
                     "[camera]\nposition = [0.5, -1.2, 0.7]\ntarget = [0.5, 0.5, 0]\n");
    const std::string file = folder / "g.gto";
    ASSERT_EQ(
        lightwell({"precompute", scene, "-o", file, "--error", "0.05", "--attempts", "0"}).status,
        0);
    for (const char* view : {"total", "direct", "indirect"}) {
        std::vector<Image> images;
        for (const char* way : {"--textures", "--live", "--no-gather"}) {
            const std::string picture = folder / "p.exr";
            const ProgramRun run =
                lightwell({"render", file, "--view", view, way, "--size", "64x48", "-o", picture});
            ASSERT_EQ(run.status, 0) << run.err;
            images.push_back(read_exr(picture).image);
        }
        double off = 0, whole = 0, other = 0;
        for (std::size_t k = 0; k < images[0].pixels().size(); ++k) {
            off += static_cast<double>((images[0].pixels()[k] - images[1].pixels()[k]).abs().sum());
            whole += static_cast<double>(images[0].pixels()[k].sum());
            other += static_cast<double>(images[2].pixels()[k].sum());
        }
        EXPECT_LT(off, 0.01 * whole) << view;
        EXPECT_NEAR(whole, other, 0.1 * whole) << view;
    }
}

TEST_F(RenderedCornellBox, LampsAreProjectedInTheWayAskedFor) {
    const Image rays = rendered({"--view", "indirect", "--live", "--projection", "rays"}).image;
    const Image queries =
        rendered({"--view", "indirect", "--live", "--projection", "queries"}).image;
    double off = 0, whole = 0;
    for (std::size_t k = 0; k < rays.pixels().size(); ++k) {
        off += static_cast<double>((rays.pixels()[k] - queries.pixels()[k]).abs().sum());
        whole += static_cast<double>(rays.pixels()[k].sum());
    }
    // Two ways that agree, and never to the last bit.
    EXPECT_GT(off, 0);
    EXPECT_LT(off, 0.005 * whole);
    const ProgramRun run =
        lightwell({"render", file_, "--live", "--projection", "guess", "-o", *folder_ / "5.png"});
    EXPECT_EQ(run.status, 1);
    EXPECT_NE(run.err.find("'guess' is not fastest, rays or queries"), std::string::npos);
}

class RenderedPath : public RenderedCornellBox {
  protected:
    /// A lamp that goes from place to place in the air of the box.
    static std::string path(double seconds) {
        std::string text = "frames_per_second = 2\n";
        for (const double time : {0.0, seconds})
            text += fmt::format(
                "[[light]]\nname = \"lamp\"\ntype = \"point\"\ntime = {}\nposition = [{}, 2.0, 4.5]"
                "\nintensity = 400\n",
                time, time == 0 ? 1 : 4);
        return folder_->write("path.toml", text);
    }
};

TEST_F(RenderedPath, IsNumberedPicturesThatShowWhatSinglePicturesShow) {
    const ScratchFolder out;
    const ProgramRun run =
        lightwell({"render", file_, "--path", path(1), "--size", "64x48", "-o", out / "walk.exr"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out + run.err, "");
    EXPECT_EQ(out.names(), (Words{"walk-0001.exr", "walk-0002.exr", "walk-0003.exr"}));
    const std::string middle = folder_->write(
        "middle.toml", "[[light]]\ntype = \"point\"\nposition = [2.5, 2, 4.5]\nintensity = 400\n");
    const Image alone = rendered({"--live", "--lights", middle}).image;
    const Image second = read_exr(out / "walk-0002.exr").image;
    for (std::size_t k = 0; k < alone.pixels().size(); ++k)
        EXPECT_LE((alone.pixels()[k] - second.pixels()[k]).abs().maxCoeff(),
                  1e-3f * (1 + alone.pixels()[k].maxCoeff()));
}

TEST_F(RenderedPath, StopsBetweenPicturesAndLeavesWholeOnes) {
    const ScratchFolder out;
    ProgramSetting setting;
    setting.on_terminal = true;
    setting.signal = SIGINT;
    setting.signal_at = "picture 1 of";
    const ProgramRun run = lightwell(
        {"render", file_, "--path", path(1000), "--size", "64x48", "-o", out / "walk.exr"},
        setting);
    EXPECT_EQ(run.status, 3);
    EXPECT_NE(run.err.find("of 2001 pictures are there"), std::string::npos) << run.err;
    const Words names = out.names();
    ASSERT_FALSE(names.empty());
    EXPECT_LT(names.size(), 2001U);
    for (const std::string& name : names)
        EXPECT_EQ(read_exr(out / name).image.width(), 64) << name;
}

TEST_F(RenderedPath, SaysWhereItIsWrong) {
    const std::string wrong =
        folder_->write("wrong.toml", "[[camera]]\ntime = 0\nposition = [1, 2]\n");
    const ProgramRun run =
        lightwell({"render", file_, "--path", wrong, "-o", *folder_ / "wrong.png"});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err.rfind("lightwell: " + wrong + ":3:", 0), 0u) << run.err;
    EXPECT_FALSE(std::filesystem::exists(*folder_ / "wrong-0001.png"));
}

TEST_F(RenderedCornellBox, ExposureActsOnThePngAlone) {
    const Words words = {"render",           file_,       "--size", "32x24", "-o",
                         *folder_ / "e.png", "--exposure"};
    Words darker = words, brighter = words;
    darker.push_back("-2");
    brighter.push_back("+1.5");
    ASSERT_EQ(lightwell(darker).status, 0);
    const std::string dark = contents(*folder_ / "e.png");
    ASSERT_EQ(lightwell(brighter).status, 0);
    EXPECT_NE(dark, contents(*folder_ / "e.png"));
    EXPECT_TRUE(
        (rendered({"--exposure", "3"}).image.at(32, 40) == rendered({}).image.at(32, 40)).all());
}

TEST_F(RenderedCornellBox, IsTheSameForAnyNumberOfThreads) {
    rendered({"--threads", "1"});
    const std::string one = contents(*folder_ / "p.exr");
    rendered({"--threads", "3"});
    EXPECT_EQ(one, contents(*folder_ / "p.exr"));
}

TEST_F(RenderedCornellBox, RefusesWhatItCannotWriteOrRead) {
    EXPECT_EQ(lightwell({"render", file_, "-o", *folder_ / "p.jpg"}).status, 1);
    EXPECT_EQ(lightwell({"render", file_, "-o", *folder_ / "no/p.png"}).status, 1);
    EXPECT_EQ(lightwell({"render", *folder_ / "none.gto", "-o", *folder_ / "n.png"}).status, 1);
    const std::string camera = folder_->write("camera.toml", "[camera]\nposition = [1, 2]\n");
    const ProgramRun run =
        lightwell({"render", file_, "-o", *folder_ / "n.png", "--camera", camera});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err.rfind("lightwell: " + camera + ":2:", 0), 0u) << run.err;
    EXPECT_FALSE(std::filesystem::exists(*folder_ / "n.png"));
}

TEST(Render, ASceneWithoutACameraIsSeenFromInside) {
    const ScratchFolder folder;
    // The furnace's geometry alone: a closed room, 0.5 grey.
    const std::string obj =
        contents(std::filesystem::path(sample_scene("furnace")).parent_path() / "furnace.obj");
    const std::string file = precomputed(folder, folder.write("bare.obj", obj));
    const std::string lamp =
        folder.write("lamp.toml",
                     "[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = "
                     "[3, 1.2, 2.2]\nintensity = 100\n");
    const std::string output = folder / "p.exr";
    const ProgramRun run = lightwell(
        {"render", file, "--lights", lamp, "--view", "indirect", "-o", output, "--size", "32x24"});
    ASSERT_EQ(run.status, 0) << run.err;
    const Image image = read_exr(output).image;
    for (const Image::Pixel& pixel : image.pixels())
        EXPECT_GT(pixel.minCoeff(), 0);
}

}  // namespace
}  // namespace lightwell
