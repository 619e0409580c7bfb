#include "viewer/window/loading.h"

#include <chrono>
#include <filesystem>

#include <gtest/gtest.h>

#include "radiance4d/failure.h"
#include "solver/reading/scene_reader.h"
#include "tests/scratch_folder.h"
#include "tests/unit/propagation/coloured_room.h"
#include "viewer/window/drawing_pace.h"
#include "viewer/window/file_watch.h"
#include "viewer/window/files.h"
#include "viewer/window/stage_times.h"

namespace lightwell {
namespace {

void wait_for(const Loading& loading) {
    while (!loading.state().is_over)
        std::this_thread::yield();
}

TEST(Loading, HandsOverTheLatestOperatorOnce) {
    Loading loading([](Loading::Desk& desk) {
        desk.begin("first");
        desk.deliver(opened(testing::coloured_room().transport));
        desk.begin("second");
        desk.progress().say("links", 1);
        GlobalTransport better = testing::coloured_room().transport;
        better.provenance.error_asked = 0.01;
        desk.deliver(opened(std::move(better)));
    });
    wait_for(loading);
    EXPECT_EQ(loading.state().doing, "second");
    EXPECT_GT(loading.state().share, 0.1);
    EXPECT_FALSE(loading.state().failure);
    const SharedOperator taken = loading.take();
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->transport.provenance.error_asked, 0.01);
    EXPECT_FALSE(loading.take());
}

TEST(Loading, SaysWhyItFailed) {
    Loading loading(reading_of("/nowhere/none.gto"));
    wait_for(loading);
    ASSERT_TRUE(loading.state().failure);
    EXPECT_NE(message_of(loading.state().failure).find("none.gto"), std::string::npos);
    EXPECT_THROW(std::rethrow_exception(loading.state().failure), InputError);
}

TEST(Loading, StopsWithItsOwner) {
    std::atomic<bool> began{false};
    {
        Loading loading([&began](Loading::Desk& desk) {
            const Progress progress = desk.progress();
            began = true;
            for (;;)
                progress.check();
        });
        while (!began)
            std::this_thread::yield();
    }
    SUCCEED();
}

TEST(Loading, ComesToTheErrorAskedForByWayOfCoarserOnes) {
    EXPECT_EQ(errors_on_the_way(0.5), std::vector<double>({0.5}));
    EXPECT_EQ(errors_on_the_way(0.25), std::vector<double>({0.25}));
    const std::vector<double> errors = errors_on_the_way(0.02);
    ASSERT_GE(errors.size(), 3u);
    EXPECT_EQ(errors.front(), 0.3);
    EXPECT_EQ(errors.back(), 0.02);
    for (std::size_t k = 1; k < errors.size(); ++k)
        EXPECT_LT(errors[k], errors[k - 1] / 1.5);
}

TEST(Files, AFileIsWatchedForNewContentAndOverItsAbsence) {
    const testing::ScratchFolder folder;
    FileWatch watch(folder.write("a.gto", "one"));
    EXPECT_FALSE(watch.has_changed());
    folder.write("a.gto", "another");
    EXPECT_TRUE(watch.has_changed());
    EXPECT_FALSE(watch.has_changed());
    std::filesystem::remove(watch.path());
    EXPECT_FALSE(watch.has_changed());
    folder.write("a.gto", "again");
    EXPECT_TRUE(watch.has_changed());
}

TEST(Files, FilesAreToldApart) {
    const testing::ScratchFolder folder;
    EXPECT_EQ(kind_of("x/y.GTO"), FileKind::operator_file);
    EXPECT_EQ(kind_of("y.obj"), FileKind::scene);
    EXPECT_EQ(kind_of(folder.path()), FileKind::scene);
    EXPECT_EQ(kind_of(folder.write("s.toml", "geometry = \"a.obj\"\n")), FileKind::scene);
    EXPECT_EQ(kind_of(folder.write("l.toml", "light = []\n")), FileKind::lights);
    EXPECT_THROW(kind_of("y.jpg"), InputError);
    EXPECT_THROW(kind_of(folder / "none.toml"), InputError);
}

TEST(Files, PicturesNeverReplaceOneAnother) {
    const testing::ScratchFolder folder;
    const std::string stem = folder / "p";
    EXPECT_EQ(next_free_name(stem, ".png"), stem + "-0001.png");
    folder.write("p-0001.png", "");
    EXPECT_EQ(next_free_name(stem, ".png"), stem + "-0002.png");
    EXPECT_EQ(next_free_name(stem, ".exr"), stem + "-0001.exr");
}

TEST(Files, SavedLightsComeBackAsTheyWereSwitched) {
    const testing::ScratchFolder folder;
    Visit visit{WalkCamera({}, Vec3::UnitZ())};
    visit.edits = LightEdits({PointLight{"a", {1, 2, 3}, Rgb::Constant(10)},
                              PointLight{"b", {4, 5, 6}, Rgb::Constant(7)}});
    EditedLight light = visit.edits.lights()[0];
    light.dimmer = 0.5;
    visit.edits.change(0, light);
    light = visit.edits.lights()[1];
    light.on = false;
    visit.edits.change(1, light);
    visit.camera.walk({1, 0, 0}, 1, nullptr);
    visit.lights_file = folder / "saved.toml";
    save_lights(visit);

    Visit other{WalkCamera({}, Vec3::UnitZ())};
    load_lights(visit.lights_file, Vec3::UnitZ(), other);
    ASSERT_EQ(other.edits.lights().size(), 2u);
    EXPECT_EQ(full_intensity_of(other.edits.lights()[0].light)[0], 10);
    EXPECT_EQ(other.edits.lights()[0].dimmer, 0.5);
    EXPECT_EQ(full_intensity_of(other.edits.lights()[1].light)[0], 7);
    EXPECT_FALSE(other.edits.lights()[1].on);
    // Elsewhere, lamps are as they shine.
    const std::vector<Light> shining = read_lights(visit.lights_file);
    EXPECT_EQ(full_intensity_of(shining[0])[0], 5);
    EXPECT_EQ(full_intensity_of(shining[1])[0], 0);
    EXPECT_TRUE(other.camera.position().isApprox(visit.camera.position()));
    other.undo();
    EXPECT_TRUE(other.edits.lights().empty());
}

TEST(StageHistory, KeepsTheLastFramesAndTheirMedians) {
    StageHistory history;
    EXPECT_EQ(history.median(0), 0);
    for (int k = 1; k <= 200; ++k) {
        StageTimes times;
        times.drawing = k;
        if (k == 200) times.projection = 3;
        history.add(times);
    }
    const auto frames = history.frames();
    ASSERT_EQ(frames.size(), StageHistory::length);
    EXPECT_EQ(frames.front().drawing, 81);
    EXPECT_EQ(frames.back().drawing, 200);
    EXPECT_EQ(history.median(4), 141);
    EXPECT_EQ(history.median(0), 3);  // of frames that needed it
}

TEST(DrawingPace, DrawsCoarselyOnlyWhileAPictureChangesThatTakesLong) {
    DrawingPace pace;
    // Nobody knows yet what a picture takes.
    EXPECT_EQ(pace.next(true, 0)->coarseness, 8);
    pace.took(0.01 / 64);
    EXPECT_EQ(pace.next(true, 1)->coarseness, 1);
    EXPECT_FALSE(pace.owes_more());
    EXPECT_FALSE(pace.next(false, 9));
    pace.took(0.3);
    EXPECT_EQ(pace.next(true, 10)->coarseness, 3);
    EXPECT_TRUE(pace.owes_more());
    pace.took(0.09 / 9);
    EXPECT_EQ(pace.next(true, 10.1)->coarseness, 2);
    pace.took(0.09 / 4);
    EXPECT_FALSE(pace.next(false, 10.2));
    const auto fine = pace.next(false, 10.4);
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->coarseness, 1);
    EXPECT_EQ(fine->rows.to - fine->rows.from, 1);
    EXPECT_FALSE(pace.owes_more());
}

TEST(DrawingPace, DrawsAFinePictureThatTakesLongInParts) {
    DrawingPace pace;
    pace.next(true, 0);
    pace.took(2.0 / 64);
    double drawn = 0, now = 1;
    int parts = 0;
    while (const auto part = pace.next(false, now += 0.1)) {
        EXPECT_EQ(part->coarseness, 1);
        EXPECT_EQ(part->rows.from, drawn);
        drawn = part->rows.to;
        pace.took(2 * (part->rows.to - part->rows.from));
        ASSERT_LE(++parts, 30);
    }
    EXPECT_EQ(drawn, 1);
    EXPECT_GE(parts, 15);
    // It begins anew where the picture changes in between.
    pace.next(true, 10);
    pace.took(2.0 / 64);
    pace.next(false, 11);
    pace.took(0.1);
    EXPECT_GT(pace.next(true, 11.1)->coarseness, 1);
    EXPECT_TRUE(pace.owes_more());
    pace.took(2.0 / 64);
    EXPECT_FALSE(pace.next(false, 11.2));
    EXPECT_EQ(pace.next(false, 11.5)->rows.from, 0);
}

}  // namespace
}  // namespace lightwell
