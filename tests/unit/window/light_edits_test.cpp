#include "viewer/window/light_edits.h"

#include <string>

#include <gtest/gtest.h>

#include "solver/reading/scene_reader.h"
#include "tests/scratch_folder.h"
#include "viewer/window/light_text.h"

namespace lightwell {
namespace {

PointLight lamp(const std::string& name, double intensity) {
    return {name, Vec3(1, 2, 3), Rgb::Constant(intensity)};
}

double brightness(const LightEdits& edits, std::size_t index) {
    return full_intensity_of(edits.lights()[index].light)[0];
}

TEST(LightEdits, ShinesOnlyWhatIsOnAndDimmed) {
    LightEdits edits({lamp("a", 100), lamp("b", 50)});
    EditedLight first = edits.lights()[0];
    first.dimmer = 0.25;
    edits.change(0, first);
    EditedLight second = edits.lights()[1];
    second.on = false;
    edits.change(1, second);
    const std::vector<Light> shining = edits.shining();
    ASSERT_EQ(shining.size(), 1u);
    EXPECT_EQ(full_intensity_of(shining[0])[1], 25);
    EXPECT_EQ(brightness(edits, 0), 100);
}

TEST(LightEdits, AHueLeavesALampAsBrightAsItWas) {
    Light light = lamp("a", 100);
    for (int frame = 0; frame < 3; ++frame)
        set_hue(light, Rgb(0.6, 0.3, 0.15));
    EXPECT_TRUE(full_intensity_of(light).isApprox(Rgb(100, 50, 25)));
    set_hue(light, Rgb::Zero());
    EXPECT_TRUE(full_intensity_of(light).isApprox(Rgb(100, 50, 25)));
}

TEST(LightEdits, UndoesAndRedoesEachEdit) {
    LightEdits edits({lamp("a", 100)});
    EXPECT_FALSE(edits.can_undo());
    edits.add({lamp("b", 50), true, 1});
    edits.remove(0);
    ASSERT_EQ(edits.lights().size(), 1u);
    edits.undo();
    ASSERT_EQ(edits.lights().size(), 2u);
    EXPECT_EQ(name_of(edits.lights()[0].light), "a");
    edits.undo();
    ASSERT_EQ(edits.lights().size(), 1u);
    EXPECT_FALSE(edits.can_undo());
    edits.undo();
    edits.redo();
    edits.redo();
    ASSERT_EQ(edits.lights().size(), 1u);
    EXPECT_EQ(name_of(edits.lights()[0].light), "b");
    EXPECT_FALSE(edits.can_redo());
}

TEST(LightEdits, ADragIsOneStepAndANewEditForgetsWhatWasUndone) {
    LightEdits edits({lamp("a", 100)});
    EditedLight light = edits.lights()[0];
    for (int k = 1; k <= 200; ++k) {
        set_intensity(light.light, Rgb::Constant(100 + k));
        edits.change(0, light);
    }
    edits.settle();
    set_intensity(light.light, Rgb::Constant(7));
    edits.change(0, light);
    edits.settle();
    edits.undo();
    EXPECT_EQ(brightness(edits, 0), 300);
    edits.undo();
    EXPECT_EQ(brightness(edits, 0), 100);
    edits.add({lamp("c", 1), true, 1});
    EXPECT_FALSE(edits.can_redo());
    edits.undo();
    EXPECT_EQ(brightness(edits, 0), 100);
}

TEST(LightEdits, GivesAddedLightsNamesOfTheirOwn) {
    LightEdits edits({lamp("lamp", 1), lamp("lamp 2", 1)});
    const std::size_t third = edits.add({lamp("lamp", 1), true, 1});
    EXPECT_EQ(third, 2u);
    EXPECT_EQ(name_of(edits.lights()[2].light), "lamp 3");
    edits.add({lamp("desk", 1), true, 1});
    EXPECT_EQ(name_of(edits.lights()[3].light), "desk");
}

TEST(LightEdits, AKindChangedAndChangedBackIsTheSameLight) {
    const Light point = lamp("a", 30);
    const Light spot = other_kind(point, Vec3(0, -1, 0));
    ASSERT_TRUE(std::holds_alternative<SpotLight>(spot));
    EXPECT_EQ(std::get<SpotLight>(spot).direction, Vec3(0, -1, 0));
    const Light back = other_kind(spot, Vec3::UnitX());
    ASSERT_TRUE(std::holds_alternative<PointLight>(back));
    EXPECT_EQ(name_of(back), "a");
    EXPECT_EQ(position_of(back), position_of(point));
    EXPECT_EQ(full_intensity_of(back)[2], 30);
}

class SavedText : public ::testing::Test {
  protected:
    std::string written(const std::string& text) const {
        return folder_.write("lights.toml", text);
    }

  private:
    lightwell::testing::ScratchFolder folder_;
};

TEST_F(SavedText, IsReadBackToTheLastBit) {
    SpotLight spot;
    spot.name = "desk \"left\" \\ \xc3\xa9\n";
    spot.position = {0.1, 1.0 / 3, -1e-7};
    spot.intensity = {1234.5678901234567, 0, 1e6};
    spot.direction = Vec3(1, 2, -3).normalized();
    spot.inner_angle = 12.3;
    spot.outer_angle = 45.6;
    Camera camera;
    camera.position = {1, 2, 1.0 / 7};
    camera.target = {0, 0, 1};
    camera.vertical_angle = 47.11;
    const std::string path = written(lights_and_camera_text(
        {{lamp("a", 0.1)}, {spot, 0.25}, {lamp("c", 7), 0.5, false}}, camera));

    const std::vector<Light> lights = read_lights(path);
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(std::get<PointLight>(lights[0]).position, Vec3(1, 2, 3));
    EXPECT_EQ(full_intensity_of(lights[0])[1], 0.1);
    EXPECT_TRUE((full_intensity_of(lights[1]) == 0.25 * spot.intensity).all());
    EXPECT_EQ(full_intensity_of(lights[2])[0], 0);
    const std::vector<DimmedLight> dimmed = read_dimmed_lights(path);
    EXPECT_EQ(dimmed[0].dimmer, 1);
    EXPECT_EQ(dimmed[1].dimmer, 0.25);
    EXPECT_TRUE(dimmed[1].on);
    // Off, and as dim as it was when it comes on again.
    EXPECT_FALSE(dimmed[2].on);
    EXPECT_EQ(dimmed[2].dimmer, 0.5);
    EXPECT_EQ(full_intensity_of(dimmed[2].light)[0], 7);
    const auto& read = std::get<SpotLight>(dimmed[1].light);
    EXPECT_EQ(read.name, spot.name);
    EXPECT_EQ(read.position, spot.position);
    EXPECT_TRUE((read.intensity == spot.intensity).all());
    EXPECT_LT((read.direction - spot.direction).norm(), 1e-15);
    EXPECT_EQ(read.outer_angle, spot.outer_angle);
    const Camera seen = read_camera(path);
    EXPECT_EQ(seen.position, camera.position);
    EXPECT_EQ(seen.vertical_angle, camera.vertical_angle);
}

TEST_F(SavedText, OfNoLightsHasNone) {
    EXPECT_TRUE(read_lights(written(lights_and_camera_text({}, {}))).empty());
}

}  // namespace
}  // namespace lightwell
