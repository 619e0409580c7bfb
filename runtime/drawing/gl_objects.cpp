#include "runtime/drawing/gl_objects.h"

#include <string>
#include <utility>

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

GlObject make_shader(const GlFunctions& gl, unsigned kind, const char* source) {
    GlObject shader(gl.create_shader(kind), gl.delete_shader);
    gl.shader_source(shader.name(), 1, &source, nullptr);
    gl.compile_shader(shader.name());
    int compiled = 0;
    gl.get_shaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        std::string log(4096, '\0');
        int length = 0;
        gl.get_shader_info_log(shader.name(), static_cast<int>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        throw SystemError("OpenGL cannot compile a shader: " + log);
    }
    return shader;
}

using Generate = void (*)(int, unsigned*);
using Delete = void (*)(int, const unsigned*);

GlObject make_object(Generate generate, Delete remove) {
    unsigned name = 0;
    generate(1, &name);
    return {name, [remove](unsigned old) { remove(1, &old); }};
}

}  // namespace

GlObject::GlObject(unsigned name, std::function<void(unsigned)> remove)
    : name_(name), remove_(std::move(remove)) {}

GlObject::~GlObject() {
    if (name_ != 0) remove_(name_);
}

GlObject::GlObject(GlObject&& other) noexcept
    : name_(std::exchange(other.name_, 0)), remove_(std::move(other.remove_)) {}

GlObject& GlObject::operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(remove_, other.remove_);
    return *this;
}

GlObject make_program(const GlFunctions& gl, const char* vertex_shader,
                      const char* fragment_shader) {
    const GlObject vertex = make_shader(gl, GL_VERTEX_SHADER, vertex_shader);
    const GlObject fragment = make_shader(gl, GL_FRAGMENT_SHADER, fragment_shader);
    GlObject program(gl.create_program(), gl.delete_program);
    gl.attach_shader(program.name(), vertex.name());
    gl.attach_shader(program.name(), fragment.name());
    gl.link_program(program.name());
    int linked = 0;
    gl.get_programiv(program.name(), GL_LINK_STATUS, &linked);
    if (!linked) {
        std::string log(4096, '\0');
        int length = 0;
        gl.get_program_info_log(program.name(), static_cast<int>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        throw SystemError("OpenGL cannot link a program: " + log);
    }
    return program;
}

GlObject make_buffer(const GlFunctions& gl) {
    return make_object(gl.gen_buffers, gl.delete_buffers);
}

GlObject make_vertex_array(const GlFunctions& gl) {
    return make_object(gl.gen_vertex_arrays, gl.delete_vertex_arrays);
}

GlObject make_framebuffer(const GlFunctions& gl) {
    return make_object(gl.gen_framebuffers, gl.delete_framebuffers);
}

GlObject make_texture(const GlFunctions& gl) {
    return make_object(gl.gen_textures, gl.delete_textures);
}

GlObject make_renderbuffer(const GlFunctions& gl, unsigned format, int width, int height) {
    GlObject buffer = make_object(gl.gen_renderbuffers, gl.delete_renderbuffers);
    gl.bind_renderbuffer(GL_RENDERBUFFER, buffer.name());
    gl.renderbuffer_storage(GL_RENDERBUFFER, format, width, height);
    return buffer;
}

void check_gl(const GlFunctions& gl, const char* doing) {
    const unsigned error = gl.get_error();
    if (error == GL_NO_ERROR) return;
    const char* name = error == GL_OUT_OF_MEMORY ? "out of memory" : "error";
    throw SystemError(fmt::format("OpenGL met {} 0x{:04x} while {}", name, error, doing));
}

}  // namespace lightwell
