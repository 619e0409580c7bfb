#pragma once

#include <vector>

#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"

namespace lightwell {

/// The images behind a picture: which quad every sample sees, with depth, and the light of every
/// sample. OpenGL's first row is the picture's lowest.
class Canvas {
  public:
    /// Leaves a framebuffer bound. Keeps a reference to `gl`.
    /// @throws SystemError if OpenGL cannot draw as much.
    Canvas(const GlFunctions& gl, int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    unsigned seen_texture() const { return seen_.name(); }
    unsigned light_texture() const { return light_.name(); }
    void bind_seen() const;
    void bind_light() const;

    /// Four floats for every sample, row by row. Leaves a framebuffer bound.
    std::vector<float> light() const;

  private:
    void require_complete() const;

    const GlFunctions& gl_;
    int width_, height_;
    GlObject seen_, light_, depth_, seen_framebuffer_, light_framebuffer_;
};

/// Sets how pixels lie in our memory when they are read from OpenGL, or written to it.
void use_plain_memory(const GlFunctions& gl);

/// Fills a texture, whose texels are not filtered. `pixels` may be null.
/// @param format  an OpenGL sized internal format, of which `kind` and `type` describe the pixels
void fill_texture(const GlFunctions& gl, const GlObject& texture, unsigned format, unsigned kind,
                  unsigned type, int width, int height, const void* pixels);

}  // namespace lightwell
