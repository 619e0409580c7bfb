#include <gtest/gtest.h>

#include "radiance4d/failure.h"
#include "runtime/drawing/surface_drawing.h"
#include "tests/unit/drawing/room_with_blocks.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {
namespace {

SurfaceBuffer drawn(const GlContext& context) {
    const CameraRays rays(camera_in_room(), 160, 120);
    return SurfaceDrawing(room_with_blocks(), context.loader()).draw(rays, {0, 0, 160, 120});
}

// Both in one process, one after the other and in turns.
TEST(EglContext, DrawsWhatOsmesaDraws) {
    std::unique_ptr<GlContext> egl;
    try {
        egl = make_context(OffscreenGl::egl);
    } catch (const SystemError& error) {
        GTEST_SKIP() << error.what();
    }
    EXPECT_EQ(egl->description().find("unknown"), std::string::npos) << egl->description();
    const SurfaceBuffer first = drawn(*egl);
    const auto osmesa = make_context(OffscreenGl::osmesa);
    const SurfaceBuffer other = drawn(*osmesa);
    egl->make_current();
    const SurfaceBuffer again = drawn(*egl);
    EXPECT_EQ(first.quad, again.quad);
    EXPECT_EQ(first.quad, other.quad);
    EXPECT_EQ(first.front, other.front);
}

TEST(EglContext, AVersionThatIsNotThereIsASystemError) {
    EXPECT_THROW(make_egl_context({9, 9}), SystemError);
}

}  // namespace
}  // namespace lightwell
