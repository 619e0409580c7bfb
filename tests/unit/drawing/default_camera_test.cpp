#include "viewer/commands/default_camera.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

Camera camera_for(const std::vector<Quad>& quads) {
    Scene scene;
    std::vector<Element> elements;
    for (const Quad& quad : quads) {
        SceneQuad in_scene;
        in_scene.quad = quad;
        scene.quads.push_back(in_scene);
        for (const bool front : {true, false}) {
            Element element;
            element.quad = static_cast<int>(scene.quads.size()) - 1;
            element.front = front;
            element.geometry = front ? quad : quad.reversed();
            element.set_space({}, {});
            elements.push_back(element);
        }
    }
    return default_camera(scene, RadianceSpace(elements), Visibility(quads));
}

TEST(DefaultCamera, StandsOnTheFloorOfAStoreyAndNotInTheVoidBelow) {
    std::vector<Quad> quads = box_walls(Vec3(0, 0, -9), Vec3(12, 8, 3));
    quads.erase(std::remove_if(quads.begin(), quads.end(),
                               [](const Quad& quad) { return quad.centre()[2] < -8; }),
                quads.end());
    quads.push_back(level_rectangle(0, 12, 0, 8, 0));
    const Camera camera = camera_for(quads);
    EXPECT_NEAR(camera.position[2], 1.5, 1e-5);  // half way to the ceiling
    EXPECT_NEAR(camera.target[2], 1.5, 1e-5);
}

TEST(DefaultCamera, StandsAtEyeLevelUnderAHighCeiling) {
    const Camera camera = camera_for(box_walls(Vec3::Zero(), Vec3(12, 8, 5)));
    EXPECT_NEAR(camera.position[2], 1.6, 1e-5);
}

TEST(DefaultCamera, StandsOnTheLowestPointWhereThereIsNoCeiling) {
    const Quad wall{{Vec3(0, 6, 0), Vec3(4, 6, 0), Vec3(4, 6, 5), Vec3(0, 6, 5)}};
    const Camera camera = camera_for({level_rectangle(0, 4, 0, 6, 0), wall});
    EXPECT_NEAR(camera.position[2], 1.6, 1e-5);
    EXPECT_GT(camera.target[1], camera.position[1]);
}

}  // namespace
}  // namespace lightwell
