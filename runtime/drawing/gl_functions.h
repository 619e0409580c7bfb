#pragma once

#include <cstddef>
#include <functional>

namespace lightwell {

/// An OpenGL entry point before its type is known.
using GlFunction = void (*)();

/// Finds an entry point of the current context by name; null where there is none. It comes from
/// whoever made the context, so that nothing here is bound to one OpenGL library.
using GlLoader = std::function<GlFunction(const char*)>;

/// The OpenGL 3.3 core functions that we call, named and typed as in the specification less the
/// "gl" and with the specification's types spelled out. All are set; the context that they came
/// from must be current when they are called.
struct GlFunctions {
    /// @throws SystemError that names a function which the loader does not find.
    explicit GlFunctions(const GlLoader& loader);

    unsigned (*get_error)() = nullptr;
    void (*get_integerv)(unsigned, int*) = nullptr;
    void (*finish)() = nullptr;
    void (*flush)() = nullptr;

    unsigned (*create_shader)(unsigned) = nullptr;
    void (*shader_source)(unsigned, int, const char* const*, const int*) = nullptr;
    void (*compile_shader)(unsigned) = nullptr;
    void (*get_shaderiv)(unsigned, unsigned, int*) = nullptr;
    void (*get_shader_info_log)(unsigned, int, int*, char*) = nullptr;
    void (*delete_shader)(unsigned) = nullptr;
    unsigned (*create_program)() = nullptr;
    void (*attach_shader)(unsigned, unsigned) = nullptr;
    void (*link_program)(unsigned) = nullptr;
    void (*get_programiv)(unsigned, unsigned, int*) = nullptr;
    void (*get_program_info_log)(unsigned, int, int*, char*) = nullptr;
    void (*delete_program)(unsigned) = nullptr;
    void (*use_program)(unsigned) = nullptr;
    int (*get_uniform_location)(unsigned, const char*) = nullptr;
    void (*uniform1i)(int, int) = nullptr;
    void (*uniform1f)(int, float) = nullptr;
    void (*uniform3f)(int, float, float, float) = nullptr;
    void (*uniform4f)(int, float, float, float, float) = nullptr;
    void (*uniform_matrix3fv)(int, int, unsigned char, const float*) = nullptr;

    void (*gen_buffers)(int, unsigned*) = nullptr;
    void (*bind_buffer)(unsigned, unsigned) = nullptr;
    void (*buffer_data)(unsigned, std::ptrdiff_t, const void*, unsigned) = nullptr;
    void (*delete_buffers)(int, const unsigned*) = nullptr;
    void (*gen_vertex_arrays)(int, unsigned*) = nullptr;
    void (*bind_vertex_array)(unsigned) = nullptr;
    void (*delete_vertex_arrays)(int, const unsigned*) = nullptr;
    void (*enable_vertex_attrib_array)(unsigned) = nullptr;
    void (*vertex_attrib_pointer)(unsigned, int, unsigned, unsigned char, int,
                                  const void*) = nullptr;
    void (*vertex_attrib_i_pointer)(unsigned, int, unsigned, int, const void*) = nullptr;

    void (*gen_textures)(int, unsigned*) = nullptr;
    void (*active_texture)(unsigned) = nullptr;
    void (*bind_texture)(unsigned, unsigned) = nullptr;
    void (*tex_parameteri)(unsigned, unsigned, int) = nullptr;
    void (*tex_image_2d)(unsigned, int, int, int, int, int, unsigned, unsigned,
                         const void*) = nullptr;
    void (*tex_image_3d)(unsigned, int, int, int, int, int, int, unsigned, unsigned,
                         const void*) = nullptr;
    void (*tex_buffer)(unsigned, unsigned, unsigned) = nullptr;
    void (*delete_textures)(int, const unsigned*) = nullptr;

    void (*gen_renderbuffers)(int, unsigned*) = nullptr;
    void (*bind_renderbuffer)(unsigned, unsigned) = nullptr;
    void (*renderbuffer_storage)(unsigned, unsigned, int, int) = nullptr;
    void (*delete_renderbuffers)(int, const unsigned*) = nullptr;
    void (*gen_framebuffers)(int, unsigned*) = nullptr;
    void (*bind_framebuffer)(unsigned, unsigned) = nullptr;
    void (*framebuffer_renderbuffer)(unsigned, unsigned, unsigned, unsigned) = nullptr;
    void (*framebuffer_texture)(unsigned, unsigned, unsigned, int) = nullptr;
    void (*framebuffer_texture_layer)(unsigned, unsigned, unsigned, int, int) = nullptr;
    unsigned (*check_framebuffer_status)(unsigned) = nullptr;
    void (*delete_framebuffers)(int, const unsigned*) = nullptr;

    void (*gen_queries)(int, unsigned*) = nullptr;
    void (*begin_query)(unsigned, unsigned) = nullptr;
    void (*end_query)(unsigned) = nullptr;
    void (*get_query_objectuiv)(unsigned, unsigned, unsigned*) = nullptr;
    void (*delete_queries)(int, const unsigned*) = nullptr;

    void (*enable)(unsigned) = nullptr;
    void (*disable)(unsigned) = nullptr;
    void (*depth_func)(unsigned) = nullptr;
    void (*depth_mask)(unsigned char) = nullptr;
    void (*color_mask)(unsigned char, unsigned char, unsigned char, unsigned char) = nullptr;
    void (*polygon_mode)(unsigned, unsigned) = nullptr;
    void (*draw_buffer)(unsigned) = nullptr;
    void (*read_buffer)(unsigned) = nullptr;
    void (*viewport)(int, int, int, int) = nullptr;
    void (*scissor)(int, int, int, int) = nullptr;
    void (*clear_bufferiv)(unsigned, int, const int*) = nullptr;
    void (*clear_bufferfv)(unsigned, int, const float*) = nullptr;
    void (*draw_arrays)(unsigned, int, int) = nullptr;
    void (*draw_elements)(unsigned, int, unsigned, const void*) = nullptr;
    void (*pixel_storei)(unsigned, int) = nullptr;
    void (*read_pixels)(int, int, int, int, unsigned, unsigned, void*) = nullptr;
};

}  // namespace lightwell
