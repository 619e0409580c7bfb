#include "runtime/drawing/gl_state.h"

#include <GL/glcorearb.h>

namespace lightwell {

KeptFramebuffer::KeptFramebuffer(const GlFunctions& gl) : gl_(gl) {
    gl.get_integerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn_);
    gl.get_integerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
}

KeptFramebuffer::~KeptFramebuffer() {
    gl_.bind_framebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned>(read_));
    bind_drawn();
}

void KeptFramebuffer::bind_drawn() const {
    gl_.bind_framebuffer(GL_DRAW_FRAMEBUFFER, static_cast<unsigned>(drawn_));
}

LimitedRows::LimitedRows(const GlFunctions& gl, int width, int from, int to) : gl_(gl) {
    gl_.enable(GL_SCISSOR_TEST);
    gl_.scissor(0, from, width, to - from);
}
LimitedRows::~LimitedRows() {
    gl_.disable(GL_SCISSOR_TEST);
}

ProgramInUse::ProgramInUse(const GlFunctions& gl, const GlObject& program)
    : gl_(gl), program_(program.name()) {
    gl.use_program(program_);
}

ProgramInUse::~ProgramInUse() {
    for (int unit = used_ - 1; unit >= 0; --unit) {
        gl_.active_texture(GL_TEXTURE0 + static_cast<unsigned>(unit));
        for (const unsigned target : {GL_TEXTURE_2D, GL_TEXTURE_BUFFER, GL_TEXTURE_2D_ARRAY})
            gl_.bind_texture(target, 0);
    }
    gl_.use_program(0);
}

int ProgramInUse::at(const char* name) const {
    return gl_.get_uniform_location(program_, name);
}

void ProgramInUse::set(const char* name, int value) const {
    gl_.uniform1i(at(name), value);
}

void ProgramInUse::set(const char* name, double value) const {
    gl_.uniform1f(at(name), static_cast<float>(value));
}

void ProgramInUse::set(const char* name, const Vec3& value) const {
    const Eigen::Vector3f v = value.cast<float>();
    gl_.uniform3f(at(name), v[0], v[1], v[2]);
}

void ProgramInUse::set(const char* name, const Eigen::Matrix3d& value) const {
    // OpenGL's matrices have their columns one after the other, as Eigen's do.
    const Eigen::Matrix3f matrix = value.cast<float>();
    gl_.uniform_matrix3fv(at(name), 1, GL_FALSE, matrix.data());
}

void ProgramInUse::set(const char* name, const Eigen::Vector4d& value) const {
    const Eigen::Vector4f v = value.cast<float>();
    gl_.uniform4f(at(name), v[0], v[1], v[2], v[3]);
}

void ProgramInUse::set_texture(const char* name, unsigned target, unsigned texture) {
    gl_.active_texture(GL_TEXTURE0 + static_cast<unsigned>(used_));
    gl_.bind_texture(target, texture);
    gl_.uniform1i(at(name), used_++);
}

}  // namespace lightwell
