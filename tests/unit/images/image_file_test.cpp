#include "viewer/images/image_file.h"

#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/scratch_folder.h"

namespace lightwell {
namespace {

namespace fs = std::filesystem;

/// With an empty folder.
class ImageFile : public ::testing::Test {
  protected:
    std::string path(const std::string& name) const { return folder_ / name; }
    std::size_t file_count() const { return folder_.names().size(); }

    testing::ScratchFolder folder_;
};

/// Every pixel differs, so that a flip or a shift cannot pass.
Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = Image::Pixel(static_cast<float>(x) / static_cast<float>(width),
                                          static_cast<float>(y) / static_cast<float>(height),
                                          static_cast<float>(x * 31 + y * 17 % 97) / 500.0f);
    return image;
}

struct Bytes {
    unsigned width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

Bytes read_png(const std::string& path) {
    png_image control = {};
    control.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&control, path.c_str())) << control.message;
    control.format = PNG_FORMAT_RGB;
    Bytes bytes{control.width, control.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(control))};
    EXPECT_TRUE(png_image_finish_read(&control, nullptr, bytes.rgb.data(), 0, nullptr));
    return bytes;
}

std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST_F(ImageFile, ExrReturnsEveryFloatAndTheUnit) {
    Image image = gradient(37, 23);
    image.at(5, 7) = Image::Pixel(1.2e7f, 1e-30f, -0.25f);
    EXPECT_EQ(write_exr(image, "cd/m2", path("a.exr")).non_finite_pixels, 0u);
    const ExrPicture picture = read_exr(path("a.exr"));
    EXPECT_EQ(picture.unit, "cd/m2");
    ASSERT_EQ(picture.image.width(), 37);
    ASSERT_EQ(picture.image.height(), 23);
    for (int y = 0; y < 23; ++y)
        for (int x = 0; x < 37; ++x)
            ASSERT_TRUE((picture.image.at(x, y) == image.at(x, y)).all()) << x << ',' << y;
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageFile, PngHoldsTheTopRowFirstInSrgb) {
    Image image(3, 2);
    image.at(0, 0) = Image::Pixel(1, 0, 0);
    image.at(2, 0) = Image::Pixel(0, 0.5f, 0);
    image.at(1, 1) = Image::Pixel(-1, 2, 0.0031308f);
    EXPECT_EQ(write_png(image, path("a.png")).non_finite_pixels, 0u);
    const Bytes bytes = read_png(path("a.png"));
    EXPECT_EQ(bytes.width, 3u);
    EXPECT_EQ(bytes.height, 2u);
    // sRGB of 0.5 is 187.5 of 255, of 0.0031308 it is 10.3 (IEC 61966-2-1).
    EXPECT_EQ(bytes.rgb, (std::vector<std::uint8_t>{255, 0, 0, 0, 0, 0, 0, 188, 0,  //
                                                    0, 0, 0, 0, 255, 10, 0, 0, 0}));
    EXPECT_NE(contents(path("a.png")).find("sRGB"), std::string::npos);
}

TEST_F(ImageFile, NonFinitePixelsAreCountedAndWrittenBlack) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    Image image(4, 4);
    for (Image::Pixel& pixel : image.pixels())
        pixel = Image::Pixel::Constant(0.5f);
    image.at(1, 0) = Image::Pixel(nan, 1, 1);
    image.at(2, 0) = Image::Pixel(nan, infinity, -infinity);
    EXPECT_EQ(write_exr(image, "lx", path("a.exr")).non_finite_pixels, 2u);
    EXPECT_EQ(write_png(image, path("a.png")).non_finite_pixels, 2u);
    const Image read = read_exr(path("a.exr")).image;
    EXPECT_TRUE((read.at(1, 0) == Image::Pixel(0, 1, 1)).all());
    EXPECT_TRUE((read.at(2, 0) == Image::Pixel(0, 0, 0)).all());
    EXPECT_TRUE((read.at(3, 3) == 0.5f).all());
    EXPECT_EQ(read_png(path("a.png")).rgb[3], 0);
}

TEST_F(ImageFile, TheExtensionDecides) {
    EXPECT_EQ(image_format("a/b.png"), ImageFormat::png);
    EXPECT_EQ(image_format("b.c.EXR"), ImageFormat::exr);
    EXPECT_THROW(image_format("b.jpg"), InputError);
    EXPECT_THROW(image_format("png"), InputError);
    EXPECT_THROW(image_format("folder.png/picture"), InputError);
}

TEST_F(ImageFile, AnUnusablePlaceIsAClearError) {
    const Image image = gradient(8, 8);
    EXPECT_THROW(static_cast<void>(write_png(image, path("none/a.png"))), InputError);
    EXPECT_THROW(static_cast<void>(write_exr(image, "lx", path("none/a.exr"))), InputError);
    fs::create_directory(path("folder.png"));
    EXPECT_THROW(static_cast<void>(write_png(image, path("folder.png"))), InputError);
    // A pipe or a device must not be replaced by a file. (Never the real /dev/null here: if the
    // code were wrong and the tester root, the machine would lose it.)
    ASSERT_EQ(mkfifo(path("pipe.png").c_str(), 0600), 0);
    EXPECT_THROW(static_cast<void>(write_png(image, path("pipe.png"))), InputError);
    EXPECT_TRUE(fs::is_fifo(path("pipe.png")));
    EXPECT_EQ(file_count(), 2u);
}

TEST_F(ImageFile, AReadOnlyFolderIsASystemError) {
    fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec |
                                        fs::perms::others_read | fs::perms::others_exec);
    // Permissions do not hold for root, who therefore becomes nobody for the moment.
    const bool root = geteuid() == 0;
    if (root) {
        ASSERT_EQ(seteuid(65534), 0);
    }
    EXPECT_THROW(static_cast<void>(write_png(gradient(8, 8), path("a.png"))), SystemError);
    EXPECT_THROW(static_cast<void>(write_exr(gradient(8, 8), "lx", path("a.exr"))), SystemError);
    if (root) {
        ASSERT_EQ(seteuid(0), 0);
    }
    fs::permissions(folder_.path(), fs::perms::owner_all);
    EXPECT_EQ(file_count(), 0u);
}

// A limit on the size of files stands in for the full disk: the write stops half-way, as there.
class ImageFileOnAFullDisk : public ImageFile, public ::testing::WithParamInterface<int> {
  protected:
    void SetUp() override {
        ImageFile::SetUp();
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
    }
    void TearDown() override {
        lift();
        std::signal(SIGXFSZ, SIG_DFL);
        ImageFile::TearDown();
    }
    void limit(rlim_t bytes) {
        rlimit limited = before_;
        limited.rlim_cur = bytes;
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
    }
    void lift() { setrlimit(RLIMIT_FSIZE, &before_); }

    rlimit before_ = {};
};

TEST_P(ImageFileOnAFullDisk, TheOldPictureStaysAndNothingElse) {
    const int side = GetParam();
    ASSERT_EQ(write_png(gradient(3, 3), path("a.png")).non_finite_pixels, 0u);
    ASSERT_EQ(write_exr(gradient(3, 3), "lx", path("a.exr")).non_finite_pixels, 0u);
    const std::string png = contents(path("a.png")), exr = contents(path("a.exr"));
    limit(64);
    EXPECT_THROW(static_cast<void>(write_png(gradient(side, side), path("a.png"))), SystemError);
    EXPECT_THROW(static_cast<void>(write_exr(gradient(side, side), "lx", path("a.exr"))),
                 SystemError);
    lift();
    EXPECT_EQ(contents(path("a.png")), png);
    EXPECT_EQ(contents(path("a.exr")), exr);
    EXPECT_EQ(file_count(), 2u);
}

// OpenEXR by itself reports nothing when a 4 x 4 picture does not fit.
INSTANTIATE_TEST_SUITE_P(Sides, ImageFileOnAFullDisk, ::testing::Values(4, 200));

TEST_F(ImageFile, ALinkIsFollowed) {
    fs::create_directory(path("store"));
    std::ofstream(path("store/real.png")) << "old";
    fs::create_symlink("store/real.png", path("link.png"));
    EXPECT_EQ(write_png(gradient(3, 3), path("link.png")).non_finite_pixels, 0u);
    EXPECT_TRUE(fs::is_symlink(path("link.png")));
    EXPECT_EQ(read_png(path("store/real.png")).width, 3u);
}

TEST_F(ImageFile, ADamagedExrIsAnInputError) {
    ASSERT_EQ(write_exr(gradient(40, 40), "lx", path("a.exr")).non_finite_pixels, 0u);
    const std::string whole = contents(path("a.exr"));
    EXPECT_THROW(read_exr(path("none.exr")), InputError);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{3}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
        std::ofstream(path("cut.exr"), std::ios::binary)
            .write(whole.data(), static_cast<long>(size));
        EXPECT_THROW(read_exr(path("cut.exr")), InputError) << size;
    }
}

}  // namespace
}  // namespace lightwell
