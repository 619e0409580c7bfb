#include "solver/transport/elements.h"

#include <gtest/gtest.h>

#include "radiance4d/scene/visibility.h"
#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

/// A room of 4 x 4 x 3 m with a hollow wall across half of it, its faces turned outwards: with or
/// without the end that closes it in the middle of the room.
Scene room_with_wall(bool closed) {
    std::vector<Quad> quads = box_walls({0, 0, 0}, {4, 4, 3});
    const std::vector<Quad> block = box_walls({1.9, 0, 0}, {2.1, 2, 3});
    for (const std::size_t face : {0U, 1U})
        quads.push_back(block[face].reversed());
    if (closed) quads.push_back(block[3].reversed());
    Scene scene;
    Material grey;
    grey.reflectance = Rgb::Constant(0.5);
    scene.materials.push_back(grey);
    for (const Quad& quad : quads)
        scene.quads.push_back({quad, 0});
    return scene;
}

/// Quads whose backs are left.
std::vector<int> backs_left(const Scene& scene) {
    std::vector<Quad> quads;
    for (const SceneQuad& one : scene.quads)
        quads.push_back(one.quad);
    const Visibility visibility(quads);
    OracleCost cost;
    std::uint64_t blind = 0;
    std::vector<Element> elements = seeing_elements(scene, blind);
    std::vector<SideSurvey> survey = survey_sides(elements, visibility, 256, cost);
    // None of these can look into the wall.
    const std::vector<Vec3> positions{{1, 1, 1.5}, {3, 1, 1.5}, {1, 1.9, 1.2}, {3, 1.9, 2}};
    drop_inside_of_solids(quads, positions, visibility, cost, elements, survey);
    EXPECT_EQ(elements.size(), survey.size());
    std::vector<int> backs;
    for (const Element& element : elements)
        if (!element.front) backs.push_back(element.quad);
    return backs;
}

TEST(Elements, BacksInsideOfASolidAreDropped) {
    EXPECT_EQ(backs_left(room_with_wall(true)), std::vector<int>());
}

// A low box without a bottom: from its lid almost all that is met is the floor, whose front is lit
// around the box. Raised a little, it is lit from below.
TEST(Elements, BacksOfABoxWithoutABottomAreDropped) {
    for (const double gap : {0.0, 0.03}) {
        Scene scene = room_with_wall(true);
        const std::vector<Quad> box = box_walls({0.5, 0.5, gap}, {1.1, 1.2, gap + 0.15});
        const auto first = static_cast<int>(scene.quads.size());
        std::vector<int> all;
        for (const Quad& wall : box) {
            const bool is_bottom = wall.normal().z() > 0.5;
            if (is_bottom) continue;
            all.push_back(static_cast<int>(scene.quads.size()));
            scene.quads.push_back({wall.reversed(), 0});
        }
        ASSERT_EQ(static_cast<int>(scene.quads.size()), first + 5);
        EXPECT_EQ(backs_left(scene), gap > 0 ? all : std::vector<int>()) << gap;
    }
}

TEST(Elements, BacksThatSeeLightThroughAGapStay) {
    EXPECT_EQ(backs_left(room_with_wall(false)), (std::vector<int>{6, 7}));
}

}  // namespace
}  // namespace lightwell
