#include "viewer/offscreen/gl_context.h"

#include <GL/glcorearb.h>
#include <fmt/format.h>

namespace lightwell {

std::string GlContext::description() const {
    const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(function("glGetString"));
    const auto text = [&](unsigned name) {
        const auto* found = get_string ? get_string(name) : nullptr;
        return std::string(found ? reinterpret_cast<const char*>(found) : "unknown");
    };
    return fmt::format("OpenGL {}, {}", text(GL_VERSION), text(GL_RENDERER));
}

}  // namespace lightwell
