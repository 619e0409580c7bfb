#include "runtime/drawing/surface_buffer.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// A drawing that shows the same quad everywhere, its margin included.
DrawnQuads all_of(int quad, const CameraRays& rays) {
    return {
        {0, 0, rays.width(), rays.height()},
        std::vector<int>(static_cast<std::size_t>((rays.width() + 2) * (rays.height() + 2)), quad)};
}

/// The rectangle [x0,x1] x [z0,z1] at y = 2, facing the origin.
Quad upright(double x0, double x1, double z0, double z1) {
    return {{Vec3(x0, 2, z0), Vec3(x1, 2, z0), Vec3(x1, 2, z1), Vec3(x0, 2, z1)}};
}

/// At the origin, looking along +y; column 4 of 9 looks straight ahead.
CameraRays straight_ahead() {
    Camera camera;
    camera.target = Vec3(0, 1, 0);
    return CameraRays(camera, 9, 9);
}

// Column 4 looks exactly into a gap of a nanometre between two quads.
TEST(SurfaceBuffer, ANarrowCrackBetweenSurfacesIsClosed) {
    const std::vector<Quad> quads = {upright(-9, -5e-10, -9, 9), upright(5e-10, 9, -9, 9)};
    const CameraRays rays = straight_ahead();
    DrawnQuads drawn = all_of(0, rays);
    for (std::size_t k = 0; k < drawn.quad.size(); ++k)
        drawn.quad[k] = k % 11 >= 6;
    const SurfaceBuffer buffer = meet_surfaces(quads, rays, drawn);
    for (int y = 0; y < 9; ++y) {
        const std::size_t at = buffer.index(4, y);
        ASSERT_EQ(buffer.quad[at], 0);
        // On the quad, at the edge of the crack.
        EXPECT_DOUBLE_EQ(buffer.position[at][0], -5e-10);
        EXPECT_NEAR(buffer.position[at][2],
                    2 * rays.direction(4.5, y + 0.5)[2] / rays.direction(4.5, y + 0.5)[1], 1e-12);
    }
    // With nothing round about, it stays a gap.
    for (int& quad : drawn.quad)
        if (quad == 1) quad = -1;
    EXPECT_EQ(meet_surfaces(quads, rays, drawn).quad[buffer.index(4, 4)], -1);
}

// What was drawn decides only who is asked: of the quads round about the nearest that the ray meets
// is taken, and of coplanar ones the first.
TEST(SurfaceBuffer, TheNearestQuadRoundAboutIsTaken) {
    Quad nearer = upright(-0.1, 9, -9, 9);
    for (Vec3& corner : nearer.vertex)
        corner[1] = 1.5;
    const std::vector<Quad> quads = {upright(-9, 9, -9, 9), nearer, upright(-9, 9, -9, 9)};
    const CameraRays rays = straight_ahead();
    DrawnQuads drawn = all_of(2, rays);
    for (std::size_t k = 0; k < drawn.quad.size(); k += 2)
        drawn.quad[k] = 1;
    const SurfaceBuffer buffer = meet_surfaces(quads, rays, drawn);
    EXPECT_EQ(buffer.quad[buffer.index(1, 4)], 2);
    EXPECT_EQ(buffer.quad[buffer.index(7, 4)], 1);
    EXPECT_DOUBLE_EQ(buffer.position[buffer.index(7, 4)][1], 1.5);
    for (std::size_t k = 0; k < drawn.quad.size(); ++k)
        drawn.quad[k] = k % 2 ? 0 : 2;
    const SurfaceBuffer coplanar = meet_surfaces(quads, rays, drawn);
    EXPECT_EQ(std::count(coplanar.quad.begin(), coplanar.quad.end(), 0), 81);
}

// The eye lies in the quad's plane but for rounding; whatever was drawn, no position can be had.
TEST(SurfaceBuffer, AQuadSeenEdgeOnHasNoPoints) {
    for (int k = 0; k < 50; ++k) {
        const double angle = 0.1 + 0.37 * k;
        const Vec3 u(std::cos(angle), std::sin(angle), 0.3), v(-0.2, std::cos(angle), 0.7);
        Camera camera;
        camera.position = Vec3(1.7, -2.3, 0.9 + 0.1 * k);
        camera.target = camera.position + 3.1 * u + 0.2 * v;
        const CameraRays rays(camera, 9, 9);
        const auto at = [&](double a, double b) -> Vec3 { return camera.position + a * u + b * v; };
        const Quad quad = {{at(2, -1), at(4, -1), at(4, 1), at(2, 1)}};
        const SurfaceBuffer buffer = meet_surfaces({quad}, rays, all_of(0, rays));
        EXPECT_EQ(std::count(buffer.quad.begin(), buffer.quad.end(), -1), 81) << k;
    }
}

}  // namespace
}  // namespace lightwell
