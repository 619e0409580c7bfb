#pragma once

#include <functional>

#include "runtime/drawing/gl_functions.h"

namespace lightwell {

/// An OpenGL object that is deleted with its owner. The context must still be current then, and the
/// functions that it was made with must still exist.
class GlObject {
  public:
    GlObject(unsigned name, std::function<void(unsigned)> remove);
    ~GlObject();
    GlObject(GlObject&& other) noexcept;
    GlObject& operator=(GlObject&& other) noexcept;

    unsigned name() const { return name_; }

  private:
    unsigned name_;
    std::function<void(unsigned)> remove_;
};

/// @throws SystemError with the driver's log if a shader does not compile or they do not link.
GlObject make_program(const GlFunctions& gl, const char* vertex_shader,
                      const char* fragment_shader);
GlObject make_buffer(const GlFunctions& gl);
GlObject make_vertex_array(const GlFunctions& gl);
GlObject make_framebuffer(const GlFunctions& gl);
GlObject make_texture(const GlFunctions& gl);
/// Storage of `format`, an OpenGL sized internal format, and the size given [pixels].
GlObject make_renderbuffer(const GlFunctions& gl, unsigned format, int width, int height);

/// @throws SystemError that names the error and what was being done, if OpenGL has met one.
void check_gl(const GlFunctions& gl, const char* doing);

}  // namespace lightwell
