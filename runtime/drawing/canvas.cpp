#include "runtime/drawing/canvas.h"

#include <algorithm>

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include "radiance4d/failure.h"

namespace lightwell {

Canvas::Canvas(const GlFunctions& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      seen_(make_texture(gl)),
      light_(make_texture(gl)),
      depth_(make_renderbuffer(gl, GL_DEPTH_COMPONENT32F, width, height)),
      seen_framebuffer_(make_framebuffer(gl)),
      light_framebuffer_(make_framebuffer(gl)) {
    int longest = 0;
    gl.get_integerv(GL_MAX_TEXTURE_SIZE, &longest);
    if (std::max(width, height) > longest)
        throw SystemError(fmt::format("OpenGL cannot draw {} x {} pixels, {} a side at most", width,
                                      height, longest));
    fill_texture(gl, seen_, GL_R32I, GL_RED_INTEGER, GL_INT, width, height, nullptr);
    fill_texture(gl, light_, GL_RGBA32F, GL_RGBA, GL_FLOAT, width, height, nullptr);
    bind_seen();
    gl.framebuffer_texture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, seen_.name(), 0);
    gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                depth_.name());
    require_complete();
    bind_light();
    gl.framebuffer_texture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, light_.name(), 0);
    require_complete();
}

void Canvas::require_complete() const {
    const unsigned status = gl_.check_framebuffer_status(GL_FRAMEBUFFER);
    check_gl(gl_, "making an image to draw on");
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw SystemError(
            fmt::format("OpenGL cannot draw {} x {} pixels (framebuffer status 0x{:04x})", width_,
                        height_, status));
}

void Canvas::bind_seen() const {
    gl_.bind_framebuffer(GL_FRAMEBUFFER, seen_framebuffer_.name());
}

void Canvas::bind_light() const {
    gl_.bind_framebuffer(GL_FRAMEBUFFER, light_framebuffer_.name());
}

std::vector<float> Canvas::light() const {
    std::vector<float> rgba(4 * static_cast<std::size_t>(width_) *
                            static_cast<std::size_t>(height_));
    bind_light();
    use_plain_memory(gl_);
    gl_.read_pixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, rgba.data());
    check_gl(gl_, "reading a picture");
    return rgba;
}

void use_plain_memory(const GlFunctions& gl) {
    gl.bind_buffer(GL_PIXEL_PACK_BUFFER, 0);
    gl.bind_buffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const unsigned parameter :
         {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES,
          GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES})
        gl.pixel_storei(parameter, 0);
    gl.pixel_storei(GL_PACK_ALIGNMENT, 4);
    gl.pixel_storei(GL_UNPACK_ALIGNMENT, 4);
}

void fill_texture(const GlFunctions& gl, const GlObject& texture, unsigned format, unsigned kind,
                  unsigned type, int width, int height, const void* pixels) {
    use_plain_memory(gl);
    gl.active_texture(GL_TEXTURE0);
    gl.bind_texture(GL_TEXTURE_2D, texture.name());
    for (const unsigned filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.tex_parameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.tex_image_2d(GL_TEXTURE_2D, 0, static_cast<int>(format), width, height, 0, kind, type,
                    pixels);
    gl.bind_texture(GL_TEXTURE_2D, 0);
}

}  // namespace lightwell
