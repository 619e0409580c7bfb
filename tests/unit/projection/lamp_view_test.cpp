#include "runtime/projection/lamp_view.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

Vec2 seen(const LampView& view, const Vec3& point) {
    const Vec3 at = view.seen * point;
    return Vec2(at[0], at[1]) / at[2];
}

Quad seen_from(const Vec3& lamp, Quad quad) {
    for (Vec3& corner : quad.vertex)
        corner -= lamp;
    return quad;
}

const Quad picture{{Vec3(3, 1, 0), Vec3(3, 1.2, 0), Vec3(3, 1.2, 2), Vec3(3, 1, 2)}};

TEST(LampViews, OfACubeSeeEveryDirectionOnce) {
    for (const Vec3& direction :
         {Vec3(1, 0.2, -0.3), Vec3(-1, 0.7, 0.1), Vec3(0.3, 2, -1.1), Vec3(0.2, -0.9, 0.6),
          Vec3(0.1, -0.3, 4), Vec3(0.5, -0.6, -0.7)}) {
        int faces = 0;
        for (const LampView& view : cube_views()) {
            const double depth = (view.seen * direction)[2];
            if (depth <= 0 || seen(view, direction).cwiseAbs().maxCoeff() >= 1) continue;
            ++faces;
            EXPECT_LE(depth, direction.norm());
            EXPECT_GE(depth, direction.norm() / std::sqrt(3.0));
        }
        EXPECT_EQ(faces, 1) << direction.transpose();
    }
}

TEST(LampViews, OfAQuadAreFilledByIt) {
    for (const Vec3& lamp : {Vec3(0, 0, 1), Vec3(1, 2.3, 0.4), Vec3(2.7, -3, 1.5)}) {
        const Quad relative = seen_from(lamp, picture);
        const auto view = close_view(relative, 0.01);
        ASSERT_TRUE(view) << lamp.transpose();
        Vec2 low(9, 9), high(-9, -9);
        for (const Vec3& corner : relative.vertex) {
            low = low.cwiseMin(seen(*view, corner));
            high = high.cwiseMax(seen(*view, corner));
            EXPECT_GT((view->seen * corner)[2], 0);
        }
        // Half of the view is 0.51 of the quad's extent; the corners of a turned square touch.
        EXPECT_GE(low.minCoeff(), -0.5 / 0.51 - 1e-9) << low.transpose();
        EXPECT_LE(high.maxCoeff(), 0.5 / 0.51 + 1e-9) << high.transpose();
        EXPECT_GT((high - low).minCoeff(), 1.3) << (high - low).transpose();
        EXPECT_TRUE(view->reaches(relative));
    }
}

TEST(LampViews, OfAQuadDoNotReachWhatIsElsewhere) {
    const auto view = close_view(seen_from(Vec3(0, 1, 1), picture), 0.01);
    ASSERT_TRUE(view);
    EXPECT_FALSE(view->reaches(seen_from(Vec3(0, -1, 1), picture)));
    EXPECT_FALSE(view->reaches(seen_from(Vec3(6, 1, 1), picture)));
}

TEST(LampViews, OfAQuadFromNearOrFromItsPlaneAreNone) {
    EXPECT_FALSE(close_view(seen_from(Vec3(2.9, 1.1, 1), picture), 0.01));
    EXPECT_FALSE(close_view(seen_from(Vec3(3, 4, 1), picture), 0.01));
}

}  // namespace
}  // namespace lightwell
