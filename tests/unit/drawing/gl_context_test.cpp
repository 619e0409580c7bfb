#include "viewer/offscreen/gl_context.h"

#include <cstring>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "radiance4d/failure.h"
#include "runtime/drawing/gl_objects.h"

namespace lightwell {
namespace {

TEST(GlContext, DescribesItself) {
    const auto context = make_offscreen_context();
    EXPECT_EQ(context->description().rfind("OpenGL ", 0), 0u) << context->description();
    EXPECT_EQ(context->description().find("unknown"), std::string::npos);
}

TEST(GlContext, AVersionThatIsNotThereIsASystemError) {
    EXPECT_THROW(make_offscreen_context({9, 9}), SystemError);
}

TEST(GlContext, AMissingFunctionIsNamed) {
    const auto context = make_offscreen_context();
    const GlLoader loader = [&](const char* name) -> GlFunction {
        return std::strcmp(name, "glReadPixels") == 0 ? nullptr : context->function(name);
    };
    try {
        const GlFunctions gl(loader);
        FAIL() << "nothing was thrown";
    } catch (const SystemError& error) {
        EXPECT_NE(std::string(error.what()).find("glReadPixels"), std::string::npos);
    }
}

TEST(GlContext, AFaultyShaderIsASystemErrorWithTheLog) {
    const auto context = make_offscreen_context();
    const GlFunctions gl(context->loader());
    try {
        make_program(gl, "#version 330 core\nvoid main() { nonsense(); }\n", "");
        FAIL() << "nothing was thrown";
    } catch (const SystemError& error) {
        EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos);
    }
    gl.get_error();
}

TEST(GlContext, AnErrorOfOpenGlIsReportedOnce) {
    const auto context = make_offscreen_context();
    const GlFunctions gl(context->loader());
    gl.enable(0xffff);
    EXPECT_THROW(check_gl(gl, "testing"), SystemError);
    EXPECT_NO_THROW(check_gl(gl, "testing"));
}

// Beside libGL, OSMesa's functions do nothing: it must not come in, by whatever way.
TEST(GlContext, NoOtherOpenGlIsInTheProcess) {
    const auto context = make_offscreen_context();
    std::ifstream maps("/proc/self/maps");
    if (!maps) GTEST_SKIP() << "there is no /proc/self/maps to read";
    bool osmesa = false;
    for (std::string line; std::getline(maps, line);) {
        osmesa = osmesa || line.find("libOSMesa.so") != std::string::npos;
        for (const char* foreign : {"/libGL.so", "/libOpenGL.so", "/libGLX.so", "/libX11.so"})
            EXPECT_EQ(line.find(foreign), std::string::npos) << line;
    }
    EXPECT_TRUE(osmesa);
}

}  // namespace
}  // namespace lightwell
