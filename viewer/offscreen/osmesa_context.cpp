// The first of these must come first: it declares OpenGL as the core specification has it.
// clang-format off
#include <GL/glcorearb.h>
#include <GL/osmesa.h>
// clang-format on

#include <array>

#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

namespace {

/// OSMesa insists on a framebuffer 0, however small.
constexpr int side = 16;

class OsmesaContext : public GlContext {
  public:
    explicit OsmesaContext(const GlVersion& version) {
        const std::array<int, 13> wishes = {OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_DEPTH_BITS,
                                            0,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            version.major,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            version.minor,
                                            0};
        context_ = OSMesaCreateContextAttribs(wishes.data(), nullptr);
        if (!context_)
            throw SystemError(fmt::format("OSMesa has no OpenGL {}.{} core context to draw with",
                                          version.major, version.minor));
    }
    ~OsmesaContext() override { OSMesaDestroyContext(context_); }

    void make_current() override {
        if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, side, side))
            throw SystemError("OSMesa cannot make its OpenGL context current");
    }

    GlFunction function(const char* name) const override { return OSMesaGetProcAddress(name); }

  private:
    std::array<unsigned char, 4 * side* side> pixels_ = {};
    OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> make_offscreen_context(const GlVersion& version) {
    auto context = std::make_unique<OsmesaContext>(version);
    context->make_current();
    return context;
}

}  // namespace lightwell
