#include "viewer/window/picture_canvas.h"

#include <GL/glcorearb.h>

#include "radiance4d/failure.h"

namespace lightwell {

PictureCanvas::PictureCanvas(const GlLoader& loader)
    : gl_(loader), blit_(reinterpret_cast<PFNGLBLITFRAMEBUFFERPROC>(loader("glBlitFramebuffer"))) {
    if (!blit_) throw SystemError("OpenGL has no function glBlitFramebuffer");
}

void PictureCanvas::draw(int width, int height, const std::function<void()>& picture) {
    int target = 0;
    gl_.get_integerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    if (!images_ || images_->width != width || images_->height != height) {
        images_.reset();
        images_.emplace(Images{width, height, make_renderbuffer(gl_, GL_RGBA8, width, height),
                               make_framebuffer(gl_)});
        gl_.bind_framebuffer(GL_FRAMEBUFFER, images_->framebuffer.name());
        gl_.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                     images_->colour.name());
    }
    gl_.bind_framebuffer(GL_FRAMEBUFFER, images_->framebuffer.name());
    picture();
    gl_.bind_framebuffer(GL_FRAMEBUFFER, static_cast<unsigned>(target));
    check_gl(gl_, "drawing a picture to keep");
}

void PictureCanvas::show() {
    if (!images_) return;
    int target = 0;
    gl_.get_integerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    gl_.bind_framebuffer(GL_READ_FRAMEBUFFER, images_->framebuffer.name());
    blit_(0, 0, images_->width, images_->height, 0, 0, images_->width, images_->height,
          GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl_.bind_framebuffer(GL_FRAMEBUFFER, static_cast<unsigned>(target));
    check_gl(gl_, "showing a picture");
}

}  // namespace lightwell
