#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include <dlfcn.h>
#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

namespace {

// What we use of EGL 1.4 and of the extensions EGL_EXT_platform_base,
// EGL_MESA_platform_surfaceless, EGL_EXT_platform_device and EGL_EXT_device_enumeration, declared
// here: neither building nor starting the program needs EGL.
using Handle = void*;
constexpr unsigned opengl_api = 0x30A2;
constexpr unsigned surfaceless_platform = 0x31DD, device_platform = 0x313F;
constexpr int none = 0x3038;
constexpr int surface_type = 0x3033, renderable_type = 0x3040, opengl_bit = 0x0008;
constexpr int major_version = 0x3098, minor_version = 0x30FB;
constexpr int profile_mask = 0x30FD, core_profile = 0x0001;

/// The library, loaded for as long as this lives, and for itself: its OpenGL must not take the
/// place of OSMesa's.
class EglLibrary {
  public:
    EglLibrary() : library_(dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL)) {
        if (!library_) throw SystemError("there is no EGL on this machine (libEGL.so.1)");
        get_proc_address = find<GlFunction (*)(const char*)>("eglGetProcAddress");
        initialize = find<unsigned (*)(Handle, int*, int*)>("eglInitialize");
        bind_api = find<unsigned (*)(unsigned)>("eglBindAPI");
        choose_config =
            find<unsigned (*)(Handle, const int*, Handle*, int, int*)>("eglChooseConfig");
        create_context = find<Handle (*)(Handle, Handle, Handle, const int*)>("eglCreateContext");
        destroy_context = find<unsigned (*)(Handle, Handle)>("eglDestroyContext");
        make_current = find<unsigned (*)(Handle, Handle, Handle, Handle)>("eglMakeCurrent");
        // Extensions, which may be missing.
        get_platform_display = reinterpret_cast<Handle (*)(unsigned, void*, const int*)>(
            get_proc_address("eglGetPlatformDisplayEXT"));
        query_devices = reinterpret_cast<unsigned (*)(int, Handle*, int*)>(
            get_proc_address("eglQueryDevicesEXT"));
    }
    // The drivers that EGL loads do not bear being unloaded, so the library stays in the process.
    ~EglLibrary() = default;
    EglLibrary(const EglLibrary&) = delete;
    EglLibrary& operator=(const EglLibrary&) = delete;

    GlFunction (*get_proc_address)(const char*) = nullptr;
    unsigned (*initialize)(Handle, int*, int*) = nullptr;
    unsigned (*bind_api)(unsigned) = nullptr;
    unsigned (*choose_config)(Handle, const int*, Handle*, int, int*) = nullptr;
    Handle (*create_context)(Handle, Handle, Handle, const int*) = nullptr;
    unsigned (*destroy_context)(Handle, Handle) = nullptr;
    unsigned (*make_current)(Handle, Handle, Handle, Handle) = nullptr;
    Handle (*get_platform_display)(unsigned, void*, const int*) = nullptr;
    unsigned (*query_devices)(int, Handle*, int*) = nullptr;

  private:
    template <typename Function>
    Function find(const char* name) const {
        const auto found = reinterpret_cast<Function>(dlsym(library_, name));
        if (!found) throw SystemError(fmt::format("EGL lacks the function {}", name));
        return found;
    }

    void* library_;
};

class EglContext : public GlContext {
  public:
    explicit EglContext(const GlVersion& version) {
        if (!egl_.get_platform_display || !open_display())
            throw SystemError("EGL has no display without a screen to draw with");
        const std::array<int, 5> wishes = {surface_type, 0, renderable_type, opengl_bit, none};
        const std::array<int, 7> attributes = {major_version, version.major, minor_version,
                                               version.minor, profile_mask,  core_profile,
                                               none};
        Handle config = nullptr;
        int found = 0;
        if (egl_.bind_api(opengl_api) &&
            egl_.choose_config(display_, wishes.data(), &config, 1, &found) && found > 0)
            context_ = egl_.create_context(display_, config, nullptr, attributes.data());
        if (!context_)
            throw SystemError(fmt::format("EGL has no OpenGL {}.{} core context to draw with",
                                          version.major, version.minor));
    }
    // The display is one for the whole process, and other contexts may be using it: it stays.
    ~EglContext() override {
        egl_.make_current(display_, nullptr, nullptr, nullptr);
        egl_.destroy_context(display_, context_);
    }

    void make_current() override {
        if (!egl_.bind_api(opengl_api) || !egl_.make_current(display_, nullptr, nullptr, context_))
            throw SystemError("EGL cannot make its OpenGL context current");
    }

    GlFunction function(const char* name) const override { return egl_.get_proc_address(name); }

  private:
    bool try_display(unsigned platform, void* native) {
        const Handle display = egl_.get_platform_display(platform, native, nullptr);
        if (!display || !egl_.initialize(display, nullptr, nullptr)) return false;
        display_ = display;
        return true;
    }

    /// Mesa's, which draws on any graphics processor or by the processor, or that of the first
    /// device.
    bool open_display() {
        if (try_display(surfaceless_platform, nullptr)) return true;
        Handle device = nullptr;
        int count = 0;
        return egl_.query_devices && egl_.query_devices(1, &device, &count) && count > 0 &&
               try_display(device_platform, device);
    }

    EglLibrary egl_;
    Handle display_ = nullptr;
    Handle context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_context(const GlVersion& version) {
    auto context = std::make_unique<EglContext>(version);
    context->make_current();
    return context;
}

}  // namespace lightwell
