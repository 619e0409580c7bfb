#pragma once

#include <algorithm>
#include <vector>

#include <GL/glcorearb.h>

#include "runtime/drawing/frame_renderer.h"
#include "runtime/drawing/gl_objects.h"
#include "tests/golden/byte_picture.h"

namespace lightwell::testing {

/// What FrameRenderer::draw leaves in a framebuffer, part by part.
inline BytePicture drawn_bytes(FrameRenderer& renderer, const GlLoader& loader,
                               const Camera& camera, const FrameView& view, int width, int height,
                               const std::vector<PictureRows>& parts = {{}}) {
    const GlFunctions gl(loader);
    const GlObject framebuffer = make_framebuffer(gl);
    const GlObject colours = make_renderbuffer(gl, GL_RGBA8, width, height);
    gl.bind_framebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                colours.name());
    for (const PictureRows& rows : parts)
        renderer.draw(camera, view, width, height, rows);
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(4 * width * height));
    gl.read_pixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    gl.bind_framebuffer(GL_FRAMEBUFFER, 0);
    check_gl(gl, "reading a frame");
    BytePicture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                picture.rgb.push_back(
                    rgba[static_cast<std::size_t>(4 * ((height - 1 - y) * width + x) + channel)]);
    return picture;
}

}  // namespace lightwell::testing
