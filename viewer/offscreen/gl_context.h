#pragma once

#include <memory>
#include <string>

#include "runtime/drawing/gl_functions.h"

namespace lightwell {

/// An OpenGL core context, wherever it comes from: memory, a window. What draws sees only this and
/// the functions that it finds through it.
class GlContext {
  public:
    virtual ~GlContext() = default;
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// Makes the calling thread draw with this context.
    /// @throws SystemError if the system refuses.
    virtual void make_current() = 0;
    /// The entry point of that name, null where there is none. Valid while this context is current.
    virtual GlFunction function(const char* name) const = 0;
    /// Version and renderer, for messages: "OpenGL 4.5 (Core Profile) Mesa 22.3.6, llvmpipe ...".
    virtual std::string description() const;

    /// `function` as a loader; the context must outlive it.
    GlLoader loader() const {
        return [this](const char* name) { return function(name); };
    }
};

/// The least OpenGL that we need.
struct GlVersion {
    int major = 3;
    int minor = 3;
};

/// A context in memory, drawn by the processor (OSMesa): it needs no display and no graphics
/// hardware, and touches neither. It is current on return; framebuffer 0 is of no use, draw into
/// framebuffer objects.
/// @throws SystemError if there is no core profile of that version.
std::unique_ptr<GlContext> make_offscreen_context(const GlVersion& version = {});

/// The same by EGL without a surface, drawn by graphics hardware where there is some. EGL is loaded
/// here, and only here, when it is asked for.
/// @throws SystemError if there is no EGL, or no core profile of that version.
std::unique_ptr<GlContext> make_egl_context(const GlVersion& version = {});

/// Where pictures are drawn without a window.
enum class OffscreenGl { osmesa, egl };

/// make_offscreen_context or make_egl_context.
std::unique_ptr<GlContext> make_context(OffscreenGl kind);

}  // namespace lightwell
