#include "radiance4d/scene/occluder_tree.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/unit/radiance4d/rooms.h"

namespace lightwell {
namespace {

std::vector<int> by_looking_at_all(const std::vector<Quad>& quads, const ConvexRegion& region) {
    std::vector<int> found;
    for (std::size_t q = 0; q < quads.size(); ++q)
        if (!region.misses(quads[q])) found.push_back(static_cast<int>(q));
    return found;
}

TEST(OccluderTree, FindsWhatLookingAtAllQuadsFinds) {
    std::mt19937 random(23);
    std::vector<Quad> quads = box_walls(Vec3::Zero(), Vec3::Ones());
    for (int q = 0; q < 3000; ++q)
        quads.push_back(random_parallelogram(random, 0.05));
    const OccluderTree tree(quads);
    std::vector<int> found{1, 2, 3};
    std::size_t total = 0;
    for (int k = 0; k < 500; ++k) {
        const ConvexRegion region =
            region_between(random_point(random), ConvexPolygon(random_parallelogram(random, 0.2)));
        tree.collect(region, found);
        ASSERT_EQ(found, by_looking_at_all(quads, region));
        total += found.size();
    }
    EXPECT_GT(total, 5000U);
    EXPECT_LT(total, 100000U);
}

TEST(OccluderTree, LeavesOutTheEnds) {
    const std::vector<Quad> quads{level_rectangle(0, 1, 0, 1, 0), level_rectangle(0, 1, 0, 1, 1),
                                  level_rectangle(0, 1, 0, 1, 2), level_rectangle(0, 1, 0, 1, 3)};
    const OccluderTree tree(quads);
    const ConvexRegion all(Eigen::AlignedBox3d(Vec3(0, 0, -1), Vec3(1, 1, 4)));
    std::vector<int> found;
    tree.collect(all, found);
    EXPECT_EQ(found, (std::vector<int>{0, 1, 2, 3}));
    tree.collect(all, 3, 1, found);
    EXPECT_EQ(found, (std::vector<int>{0, 2}));
    // A quad that only touches the region is not in it.
    tree.collect(ConvexRegion(Eigen::AlignedBox3d(Vec3(0, 0, 0), Vec3(1, 1, 2))), found);
    EXPECT_EQ(found, (std::vector<int>{1}));
}

TEST(OccluderTree, EmptyAndHeapedUpScenes) {
    std::vector<int> found{7};
    OccluderTree({}).collect(ConvexRegion(Eigen::AlignedBox3d(Vec3::Zero(), Vec3::Ones())), found);
    EXPECT_TRUE(found.empty());
    // Many quads in the same place cannot be divided by place.
    const std::vector<Quad> same(1000, level_rectangle(0, 1, 0, 1, 0.5));
    OccluderTree(same).collect(ConvexRegion(Eigen::AlignedBox3d(Vec3::Zero(), Vec3::Ones())),
                               found);
    EXPECT_EQ(found.size(), 1000U);
    EXPECT_EQ(found[500], 500);
}

}  // namespace
}  // namespace lightwell
