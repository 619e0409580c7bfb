#include "runtime/drawing/surface_drawing.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "radiance4d/scene/visibility.h"
#include "tests/unit/drawing/room_with_blocks.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {
namespace {

class SurfaceDrawingTest : public ::testing::Test {
  protected:
    SurfaceBuffer draw(const std::vector<Quad>& quads, const CameraRays& rays) {
        return SurfaceDrawing(quads, context_->loader())
            .draw(rays, {0, 0, rays.width(), rays.height()});
    }

    std::unique_ptr<GlContext> context_ = make_offscreen_context();
};

/// Agreement of a drawing with ray casts.
struct Agreement {
    int pixels = 0;
    int same = 0;
    double farthest = 0;  ///< largest distance between two positions on the same quad [m]
};

Agreement compare(const SurfaceBuffer& buffer, const std::vector<Quad>& quads,
                  const CameraRays& rays) {
    const Visibility visibility(quads);
    Agreement agreement;
    for (int y = 0; y < buffer.height; ++y)
        for (int x = 0; x < buffer.width; ++x) {
            const Vec3 direction = rays.direction(x + 0.5, y + 0.5);
            const Hit hit = visibility.nearest(rays.position(), free_point, direction);
            const std::size_t at = buffer.index(x, y);
            ++agreement.pixels;
            if (hit.quad != buffer.quad[at]) continue;
            if (hit.quad >= 0 && hit.front != (buffer.front[at] != 0)) continue;
            ++agreement.same;
            if (hit.quad < 0) continue;
            // Exact: on the quad's plane, and on the pixel's ray.
            const Quad& quad = quads[static_cast<std::size_t>(hit.quad)];
            const Vec3& point = buffer.position[at];
            const Vec3 from_eye = point - rays.position();
            agreement.farthest =
                std::max({agreement.farthest, std::abs(quad.normal().dot(point - quad.vertex[0])),
                          from_eye.cross(direction).norm(), -from_eye.dot(direction)});
        }
    return agreement;
}

TEST_F(SurfaceDrawingTest, AgreesWithRaysInARoomWithBlocks) {
    const std::vector<Quad> quads = room_with_blocks();
    const CameraRays rays(camera_in_room(), 480, 360);
    const SurfaceBuffer buffer = draw(quads, rays);
    const Agreement agreement = compare(buffer, quads, rays);
    // Rays that pass an edge within the rounding of the ray caster's floats may differ.
    EXPECT_GE(agreement.same, 0.9999 * agreement.pixels);
    EXPECT_LT(agreement.farthest, 1e-12);
    // From inside a closed room there is no background, and every wall but the one behind is seen.
    EXPECT_EQ(std::count(buffer.quad.begin(), buffer.quad.end(), -1), 0);
    for (const int quad : {0, 1, 3, 4, 5, 10, 15})
        EXPECT_GT(std::count(buffer.quad.begin(), buffer.quad.end(), quad), 500) << quad;
}

// The same from outside, where backs are seen and silhouettes stand against nothing, with the scene
// tiny and huge, and far from the origin.
TEST_F(SurfaceDrawingTest, AgreesWithRaysFromOutsideAtAnyScale) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
        const Vec3 shift = scale * Vec3(40, -7, 3);
        std::vector<Quad> quads = room_with_blocks();
        for (Quad& quad : quads)
            for (Vec3& corner : quad.vertex)
                corner = scale * corner + shift;
        Camera camera;
        camera.position = scale * Vec3(-5, -4, 6) + shift;
        camera.target = scale * Vec3(1.5, 2, 1) + shift;
        camera.vertical_angle = 40;
        const CameraRays rays(camera, 320, 240);
        const SurfaceBuffer buffer = draw(quads, rays);
        const Agreement agreement = compare(buffer, quads, rays);
        EXPECT_GE(agreement.same, 0.9999 * agreement.pixels) << scale;
        EXPECT_LT(agreement.farthest, 1e-12 * scale * 40) << scale;
        EXPECT_GT(std::count(buffer.quad.begin(), buffer.quad.end(), -1), 1000) << scale;
        EXPECT_EQ(std::count(buffer.front.begin(), buffer.front.end(), 1), 0) << scale;
    }
}

// A kilometre of floor seen from a millimetre above it, and a sheet of paper on that floor: neither
// the eye's nearness nor the depth may upset the order.
TEST_F(SurfaceDrawingTest, KeepsTheOrderOfNearAndFarSurfaces) {
    const auto sheet = [](double half, double y, double z) {
        return Quad{{Vec3(-half, y - half, z), Vec3(half, y - half, z), Vec3(half, y + half, z),
                     Vec3(-half, y + half, z)}};
    };
    std::vector<Quad> quads = {sheet(500, 0, 0), sheet(50, 300, 1e-2), sheet(0.02, 0.3, 1e-4)};
    quads.push_back(Quad{
        {Vec3(-600, 600, -100), Vec3(-600, 600, 100), Vec3(600, 600, 100), Vec3(600, 600, -100)}});
    for (const double height : {0.02, 1.7}) {
        Camera camera;
        camera.position = Vec3(0, 0, height);
        camera.target = Vec3(0, 1, 0.9 * height);
        const CameraRays rays(camera, 320, 240);
        const Agreement agreement = compare(draw(quads, rays), quads, rays);
        EXPECT_GE(agreement.same, 0.995 * agreement.pixels) << height;
    }
}

TEST_F(SurfaceDrawingTest, AVertexOnAnEdgeLeavesNoCrack) {
    // One large quad beside seven small ones, all edges shared at odd fractions, tilted at will.
    const Vec3 a(0.31, 0.17, 0.05), u(0.83, 0.41, 0.11), v(-0.37, 0.79, 0.23);
    const auto patch = [&](double u0, double u1, double v0, double v1) {
        return Quad{
            {a + u0 * u + v0 * v, a + u1 * u + v0 * v, a + u1 * u + v1 * v, a + u0 * u + v1 * v}};
    };
    std::vector<Quad> quads = {patch(0, 0.5, 0, 1)};
    for (int k = 0; k < 7; ++k)
        quads.push_back(patch(0.5, 1, k / 7.0, (k + 1) / 7.0));
    Camera camera;
    camera.position = Vec3(0.4, 0.2, 3);
    camera.target = a + 0.5 * (u + v);
    camera.vertical_angle = 12;
    const CameraRays rays(camera, 600, 600);
    const SurfaceBuffer buffer = draw(quads, rays);
    // Every row and column: no background between surfaces.
    for (int y = 0; y < 600; ++y) {
        int changes = 0;
        for (int x = 1; x < 600; ++x)
            changes +=
                (buffer.quad[buffer.index(x, y)] < 0) != (buffer.quad[buffer.index(x - 1, y)] < 0);
        ASSERT_LE(changes, 2) << "row " << y;
    }
    EXPECT_GT(std::count(buffer.quad.begin(), buffer.quad.end(), 7), 1000);
}

// Strips a fifth of a pixel wide through the centres of pixels: those are seen, no others.
TEST_F(SurfaceDrawingTest, ThePixelsCentreDecides) {
    Camera camera;
    camera.target = Vec3(0, 1, 0);
    camera.vertical_angle = 90;
    const CameraRays rays(camera, 100, 100);
    // At y = 1 a pixel is 0.02 wide; column 60 has its centre at x = 0.21, row 20 at z = 0.59.
    const double half = 0.002;
    const auto strip = [](double x0, double x1, double z0, double z1) {
        return Quad{{Vec3(x0, 1, z0), Vec3(x1, 1, z0), Vec3(x1, 1, z1), Vec3(x0, 1, z1)}};
    };
    const SurfaceBuffer buffer = draw(
        {strip(0.21 - half, 0.21 + half, -0.9, 0.4), strip(-0.9, 0.9, 0.59 - half, 0.59 + half)},
        rays);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
            const bool upright = x == 60 && y >= 30 && y < 95;
            const bool level = y == 20 && x >= 5 && x < 95;
            EXPECT_EQ(buffer.quad[buffer.index(x, y)], upright ? 0
                                                       : level ? 1
                                                               : -1)
                << x << ',' << y;
        }
}

TEST_F(SurfaceDrawingTest, UpIsUpAndRightIsRight) {
    // Looking along +y: a quad at +x is on the right, one at +z is at the top.
    const auto tile = [](double x, double z) {
        return Quad{
            {Vec3(x, 5, z), Vec3(x + 0.5, 5, z), Vec3(x + 0.5, 5, z + 0.5), Vec3(x, 5, z + 0.5)}};
    };
    Camera camera;
    camera.target = Vec3(0, 1, 0);
    camera.up = Vec3(0, 0, 1);
    const CameraRays rays(camera, 90, 90);
    const SurfaceBuffer buffer = draw({tile(1, -0.25), tile(-0.25, 1)}, rays);
    EXPECT_EQ(buffer.quad[buffer.index(68, 45)], 0);
    EXPECT_EQ(buffer.quad[buffer.index(45, 21)], 1);
    EXPECT_EQ(buffer.quad[buffer.index(21, 45)], -1);
    EXPECT_EQ(buffer.quad[buffer.index(45, 68)], -1);
    // tile's normal is -y: its front is seen.
    EXPECT_EQ(buffer.front[buffer.index(68, 45)], 1);
}

TEST_F(SurfaceDrawingTest, TilesJoinWithoutATrace) {
    const std::vector<Quad> quads = room_with_blocks();
    const CameraRays rays(camera_in_room(), 203, 151);
    const SurfaceDrawing drawing(quads, context_->loader());
    const SurfaceBuffer whole = drawing.draw(rays, {0, 0, 203, 151});
    for (int top = 0; top < 151; top += 32)
        for (int left = 0; left < 203; left += 32) {
            const int width = std::min(32, 203 - left), height = std::min(32, 151 - top);
            const SurfaceBuffer tile = drawing.draw(rays, {left, top, width, height});
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const std::size_t a = tile.index(x, y), b = whole.index(left + x, top + y);
                    ASSERT_EQ(tile.quad[a], whole.quad[b]) << left + x << ',' << top + y;
                    ASSERT_EQ(tile.position[a], whole.position[b]);
                }
        }
}

TEST_F(SurfaceDrawingTest, AQuadSeenEdgeOnAndAnEmptySceneAreNothing) {
    Camera camera;
    camera.target = Vec3(0, 1, 0);
    const CameraRays rays(camera, 65, 65);
    // The eye lies in the plane of this quad.
    const Quad floor = {{Vec3(-1, 1, 0), Vec3(1, 1, 0), Vec3(1, 3, 0), Vec3(-1, 3, 0)}};
    for (const auto& quads : {std::vector<Quad>{floor}, std::vector<Quad>{}}) {
        const SurfaceBuffer buffer = draw(quads, rays);
        EXPECT_EQ(std::count(buffer.quad.begin(), buffer.quad.end(), -1), 65 * 65);
    }
}

}  // namespace
}  // namespace lightwell
