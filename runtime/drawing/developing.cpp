#include "runtime/drawing/developing.h"

#include <cmath>

#include <GL/glcorearb.h>

#include "radiance4d/failure.h"
#include "runtime/drawing/frame_shaders.h"
#include "runtime/drawing/gl_state.h"

namespace lightwell {

void Covering::draw() const {
    gl_.bind_vertex_array(corners_.name());
    gl_.draw_arrays(GL_TRIANGLES, 0, 3);
    gl_.bind_vertex_array(0);
}

Developing::Developing(const GlFunctions& gl, const Covering& covering)
    : gl_(gl),
      covering_(covering),
      program_(make_program(gl, covering_vertex_shader(), developing_shader().c_str())) {}

void Developing::draw(unsigned light, const FrameView& view, int width, int height) const {
    LIGHTWELL_CHECK_OP(view.lux_maximum, >, 0);
    LIGHTWELL_CHECK_OP(view.lux_divisions, >=, 1);
    gl_.disable(GL_FRAMEBUFFER_SRGB);
    gl_.viewport(0, 0, width, height);
    ProgramInUse program(gl_, program_);
    program.set_texture("picture_light", GL_TEXTURE_2D, light);
    program.set("samples", view.samples);
    program.set("width", width);
    program.set("height", height);
    const bool is_luminance = view.picture == Picture::total || view.picture == Picture::direct ||
                              view.picture == Picture::indirect;
    program.set("mode", is_luminance ? 0 : view.picture == Picture::lux ? 1 : 2);
    program.set("factor", std::exp2(view.exposure));
    program.set("maximum", view.lux_maximum);
    program.set("divisions", 1.0 * view.lux_divisions);
    program.set("filmic", view.tone_curve ? 1 : 0);
    program.set("contours", view.contours ? 1 : 0);
    covering_.draw();
}

}  // namespace lightwell
