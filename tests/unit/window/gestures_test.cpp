#include "viewer/window/gestures.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

constexpr int width = 640, height = 480;
const Rgb grey = Rgb::Constant(0.5);

/// Somebody in the middle of a box of 4 m x 4 m x 3 m who looks along y.
class InABox : public ::testing::Test {
  protected:
    InABox() { visit_.edits = LightEdits({PointLight{"lamp", {2, 3.5, 2}, Rgb::Constant(100)}}); }

    static Camera standing() {
        Camera camera;
        camera.position = {2, 2, 1.5};
        camera.target = {2, 4, 1.5};
        camera.vertical_angle = 90;
        return camera;
    }
    CameraRays rays() const { return {visit_.camera.camera(), width, height}; }

    void take(const Input& input, const PanelClaims& claims = {}) {
        gestures_.take(input, claims, visit_, visibility_, width, height);
    }
    void tap(Key key, const PanelClaims& claims = {}) {
        take(KeyInput{key, true}, claims);
        take(KeyInput{key, false}, claims);
    }
    void drag(const Vec2& from, const Vec2& to, MouseButton button = MouseButton::left) {
        take(CursorInput{from});
        take(ButtonInput{button, true});
        take(CursorInput{to});
        take(ButtonInput{button, false});
    }
    void click(const Vec2& at) { drag(at, at); }
    Vec3 lamp() const { return position_of(visit_.edits.lights()[0].light); }

    Scene scene_ = box_scene({4, 4, 3}, {grey, grey, grey, grey, grey, grey});
    Visibility visibility_ = visibility_of(scene_);
    Visit visit_{WalkCamera(standing(), Vec3::UnitZ())};
    Gestures gestures_;
};

TEST_F(InABox, KeysWalkUntilTheyAreLetGo) {
    visit_.camera.set_speed(1);
    take(KeyInput{Key::w, true});
    EXPECT_TRUE(gestures_.is_walking());
    gestures_.advance(0.1, visit_, nullptr);
    EXPECT_NEAR(visit_.camera.position()[1], 2.1, 1e-12);
    take(KeyInput{Key::shift, true});
    gestures_.advance(0.1, visit_, nullptr);
    EXPECT_NEAR(visit_.camera.position()[1], 2.5, 1e-12);
    take(KeyInput{Key::s, true});  // both ways at once: nowhere
    gestures_.advance(0.1, visit_, nullptr);
    EXPECT_NEAR(visit_.camera.position()[1], 2.5, 1e-12);
    for (const Key key : {Key::w, Key::s, Key::shift})
        take(KeyInput{key, false});
    EXPECT_FALSE(gestures_.is_walking());
    take(KeyInput{Key::e, true});
    gestures_.advance(0.1, visit_, nullptr);
    EXPECT_NEAR(visit_.camera.position()[2], 1.6, 1e-12);
}

TEST_F(InABox, ASlowFrameIsNoLeapAndAWindowThatIsLeftStops) {
    visit_.camera.set_speed(1);
    take(KeyInput{Key::w, true});
    gestures_.advance(100, visit_, nullptr);
    EXPECT_LT(visit_.camera.position()[1], 2.5);
    take(FocusLost{});
    EXPECT_FALSE(gestures_.is_walking());
}

TEST_F(InABox, AKeyPressedWithControlDoesNotWalkWhenControlIsLetGoFirst) {
    take(KeyInput{Key::control, true});
    take(KeyInput{Key::s, true});
    take(KeyInput{Key::control, false});
    EXPECT_FALSE(gestures_.is_walking());
    EXPECT_EQ(visit_.commands, std::vector<Command>{Command::save_lights});
    take(KeyInput{Key::s, false});
    take(KeyInput{Key::s, true});
    EXPECT_TRUE(gestures_.is_walking());
}

TEST_F(InABox, KeysForThePanelAreNotForTheScene) {
    tap(Key::l, {false, true});
    EXPECT_EQ(visit_.edits.lights().size(), 1u);
    // What went down before the panel took the keyboard still comes up.
    take(KeyInput{Key::w, true});
    take(KeyInput{Key::w, false}, {false, true});
    EXPECT_FALSE(gestures_.is_walking());
}

TEST_F(InABox, AClickReadsTheSurfaceUnderTheCursor) {
    click({400, 300});
    ASSERT_TRUE(visit_.probed);
    EXPECT_EQ(visit_.probed->quad, y1);
    EXPECT_TRUE(visit_.probed->front);
    EXPECT_NEAR(visit_.probed->position[0], 2 + 2 * 80 / 240.0, 1e-5);
    EXPECT_NEAR(visit_.probed->position[1], 4, 1e-5);
    EXPECT_NEAR(visit_.probed->position[2], 1.5 - 2 * 60 / 240.0, 1e-5);
}

TEST_F(InABox, ADragLooksAroundAndReadsNothing) {
    const Vec3 before = visit_.camera.forward();
    drag({400, 300}, {450, 300});
    EXPECT_FALSE(visit_.probed);
    EXPECT_NEAR(visit_.camera.forward().dot(before), std::cos(50 * 0.2 * M_PI / 180), 1e-9);
    drag({400, 300}, {350, 300}, MouseButton::right);
    EXPECT_TRUE(visit_.camera.forward().isApprox(before, 1e-9));
    take(CursorInput{{100, 100}});
    EXPECT_TRUE(visit_.camera.forward().isApprox(before, 1e-9));
}

TEST_F(InABox, MouseOnThePanelLeavesTheSceneAlone) {
    const PanelClaims claims{true, false};
    take(CursorInput{{400, 300}}, claims);
    take(ButtonInput{MouseButton::left, true}, claims);
    take(CursorInput{{500, 300}}, claims);
    take(ButtonInput{MouseButton::left, false}, claims);
    take(WheelInput{3}, claims);
    EXPECT_FALSE(visit_.probed);
    EXPECT_NEAR(visit_.camera.forward()[1], 1, 1e-12);
    EXPECT_EQ(visit_.camera.speed(), 2);
}

TEST_F(InABox, AFreeLookFollowsTheCursorWithoutAJumpUntilEscape) {
    take(CursorInput{{10, 10}});
    tap(Key::f);
    EXPECT_TRUE(visit_.looks_freely);
    // A captured cursor may start anywhere.
    take(CursorInput{{5000, -300}});
    EXPECT_NEAR(visit_.camera.forward()[1], 1, 1e-12);
    take(CursorInput{{5090, -300}});
    EXPECT_NEAR(visit_.camera.forward()[0], std::sin(90 * 0.2 * M_PI / 180), 1e-9);
    tap(Key::escape);
    const Vec3 end = visit_.camera.forward();
    take(CursorInput{{0, 0}});
    take(CursorInput{{300, 0}});
    EXPECT_EQ(visit_.camera.forward(), end);
}

TEST_F(InABox, ALampIsPickedDraggedAndPutBackByOneUndo) {
    const Vec2 at = rays().project(lamp());
    take(CursorInput{at});
    take(ButtonInput{MouseButton::left, true});
    EXPECT_EQ(visit_.selected, 0u);
    EXPECT_TRUE(gestures_.is_dragging());
    for (int k = 1; k <= 20; ++k)
        take(CursorInput{at + k * Vec2(3, 1)});
    take(ButtonInput{MouseButton::left, false});
    EXPECT_TRUE(rays().project(lamp()).isApprox(at + Vec2(60, 20), 1e-9));
    EXPECT_EQ(lamp()[1], 3.5);
    take(KeyInput{Key::control, true});
    tap(Key::z);
    EXPECT_EQ(lamp(), Vec3(2, 3.5, 2));
    EXPECT_FALSE(visit_.edits.can_undo());
    take(KeyInput{Key::shift, true});
    tap(Key::z);
    EXPECT_TRUE(rays().project(lamp()).isApprox(at + Vec2(60, 20), 1e-9));
}

TEST_F(InABox, ALampDeletedInTheHandIsGone) {
    const Vec2 at = rays().project(lamp());
    take(CursorInput{at});
    take(ButtonInput{MouseButton::left, true});
    tap(Key::remove);
    EXPECT_TRUE(visit_.edits.lights().empty());
    take(CursorInput{at + Vec2(30, 0)});
    take(ButtonInput{MouseButton::left, false});
    EXPECT_TRUE(visit_.edits.lights().empty());
    EXPECT_FALSE(gestures_.is_dragging());
}

TEST_F(InABox, WhatIsUndoneIsSelected) {
    visit_.add_light(visibility_);
    EditedLight dimmed = visit_.edits.lights()[0];
    dimmed.dimmer = 0.5;
    visit_.edits.change(0, dimmed);
    visit_.selected = 1;
    visit_.undo();
    EXPECT_EQ(visit_.selected, 0u);
    visit_.remove_selected();
    EXPECT_FALSE(visit_.selected);
    visit_.undo();
    EXPECT_EQ(visit_.selected, 0u);
    visit_.selected = 1;
    visit_.redo();  // the one that was second is the first now
    EXPECT_EQ(visit_.edits.lights().size(), 1u);
    EXPECT_FALSE(visit_.selected);
    visit_.undo();
    visit_.selected = 0;
    visit_.undo();  // of the added lamp
    EXPECT_EQ(visit_.selected, 0u);
}

TEST_F(InABox, ANewLampHangsBetweenTheEyeAndTheWall) {
    tap(Key::l);
    ASSERT_EQ(visit_.edits.lights().size(), 2u);
    EXPECT_EQ(visit_.selected, 1u);
    EXPECT_TRUE(position_of(visit_.edits.lights()[1].light).isApprox(Vec3(2, 3, 1.5), 1e-6));
    visit_.camera.walk({1, 0, 0}, 0.95, nullptr);  // 0.1 m before the wall
    tap(Key::l);
    EXPECT_NEAR(position_of(visit_.edits.lights()[2].light)[1], 3.95, 1e-6);
}

TEST_F(InABox, KeysChooseAndAsk) {
    tap(Key::digit_4);
    EXPECT_EQ(visit_.view.picture, Picture::lux);
    const double exposure = visit_.view.exposure;
    tap(Key::period);
    EXPECT_NEAR(visit_.view.exposure, exposure + 1.0 / 3, 1e-12);
    tap(Key::n);
    EXPECT_TRUE(visit_.through_walls);
    take(TextInput{U'?'});
    EXPECT_TRUE(visit_.shows_help);
    tap(Key::escape);
    EXPECT_FALSE(visit_.shows_help);
    take(WheelInput{1});
    EXPECT_GT(visit_.camera.speed(), 2);
    tap(Key::f12);
    take(KeyInput{Key::control, true});
    tap(Key::s);
    take(KeyInput{Key::w, true});
    EXPECT_FALSE(gestures_.is_walking());
    ASSERT_EQ(visit_.commands.size(), 2u);
    EXPECT_EQ(visit_.commands[0], Command::picture_png);
    EXPECT_EQ(visit_.commands[1], Command::save_lights);
}

}  // namespace
}  // namespace lightwell
