#include "runtime/drawing/gl_functions.h"

#include <string>
#include <type_traits>

#include <GL/glcorearb.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// Specified is the type that the specification's own header gives: the compiler compares.
template <typename Specified, typename Ours>
void load(Ours& function, const GlLoader& loader, const char* name) {
    static_assert(std::is_same_v<Specified, Ours>, "the function is declared wrongly");
    function = reinterpret_cast<Ours>(loader(name));
    if (!function) throw SystemError(std::string("OpenGL lacks the function ") + name);
}

}  // namespace

GlFunctions::GlFunctions(const GlLoader& loader) {
    load<PFNGLGETERRORPROC>(get_error, loader, "glGetError");
    load<PFNGLGETINTEGERVPROC>(get_integerv, loader, "glGetIntegerv");
    load<PFNGLFINISHPROC>(finish, loader, "glFinish");
    load<PFNGLFLUSHPROC>(flush, loader, "glFlush");
    load<PFNGLCREATESHADERPROC>(create_shader, loader, "glCreateShader");
    load<PFNGLSHADERSOURCEPROC>(shader_source, loader, "glShaderSource");
    load<PFNGLCOMPILESHADERPROC>(compile_shader, loader, "glCompileShader");
    load<PFNGLGETSHADERIVPROC>(get_shaderiv, loader, "glGetShaderiv");
    load<PFNGLGETSHADERINFOLOGPROC>(get_shader_info_log, loader, "glGetShaderInfoLog");
    load<PFNGLDELETESHADERPROC>(delete_shader, loader, "glDeleteShader");
    load<PFNGLCREATEPROGRAMPROC>(create_program, loader, "glCreateProgram");
    load<PFNGLATTACHSHADERPROC>(attach_shader, loader, "glAttachShader");
    load<PFNGLLINKPROGRAMPROC>(link_program, loader, "glLinkProgram");
    load<PFNGLGETPROGRAMIVPROC>(get_programiv, loader, "glGetProgramiv");
    load<PFNGLGETPROGRAMINFOLOGPROC>(get_program_info_log, loader, "glGetProgramInfoLog");
    load<PFNGLDELETEPROGRAMPROC>(delete_program, loader, "glDeleteProgram");
    load<PFNGLUSEPROGRAMPROC>(use_program, loader, "glUseProgram");
    load<PFNGLGETUNIFORMLOCATIONPROC>(get_uniform_location, loader, "glGetUniformLocation");
    load<PFNGLUNIFORM1IPROC>(uniform1i, loader, "glUniform1i");
    load<PFNGLUNIFORM1FPROC>(uniform1f, loader, "glUniform1f");
    load<PFNGLUNIFORM3FPROC>(uniform3f, loader, "glUniform3f");
    load<PFNGLUNIFORM4FPROC>(uniform4f, loader, "glUniform4f");
    load<PFNGLUNIFORMMATRIX3FVPROC>(uniform_matrix3fv, loader, "glUniformMatrix3fv");
    load<PFNGLGENBUFFERSPROC>(gen_buffers, loader, "glGenBuffers");
    load<PFNGLBINDBUFFERPROC>(bind_buffer, loader, "glBindBuffer");
    load<PFNGLBUFFERDATAPROC>(buffer_data, loader, "glBufferData");
    load<PFNGLDELETEBUFFERSPROC>(delete_buffers, loader, "glDeleteBuffers");
    load<PFNGLGENVERTEXARRAYSPROC>(gen_vertex_arrays, loader, "glGenVertexArrays");
    load<PFNGLBINDVERTEXARRAYPROC>(bind_vertex_array, loader, "glBindVertexArray");
    load<PFNGLDELETEVERTEXARRAYSPROC>(delete_vertex_arrays, loader, "glDeleteVertexArrays");
    load<PFNGLENABLEVERTEXATTRIBARRAYPROC>(enable_vertex_attrib_array, loader,
                                           "glEnableVertexAttribArray");
    load<PFNGLVERTEXATTRIBPOINTERPROC>(vertex_attrib_pointer, loader, "glVertexAttribPointer");
    load<PFNGLVERTEXATTRIBIPOINTERPROC>(vertex_attrib_i_pointer, loader, "glVertexAttribIPointer");
    load<PFNGLGENTEXTURESPROC>(gen_textures, loader, "glGenTextures");
    load<PFNGLACTIVETEXTUREPROC>(active_texture, loader, "glActiveTexture");
    load<PFNGLBINDTEXTUREPROC>(bind_texture, loader, "glBindTexture");
    load<PFNGLTEXPARAMETERIPROC>(tex_parameteri, loader, "glTexParameteri");
    load<PFNGLTEXIMAGE2DPROC>(tex_image_2d, loader, "glTexImage2D");
    load<PFNGLTEXIMAGE3DPROC>(tex_image_3d, loader, "glTexImage3D");
    load<PFNGLTEXBUFFERPROC>(tex_buffer, loader, "glTexBuffer");
    load<PFNGLDELETETEXTURESPROC>(delete_textures, loader, "glDeleteTextures");
    load<PFNGLGENRENDERBUFFERSPROC>(gen_renderbuffers, loader, "glGenRenderbuffers");
    load<PFNGLBINDRENDERBUFFERPROC>(bind_renderbuffer, loader, "glBindRenderbuffer");
    load<PFNGLRENDERBUFFERSTORAGEPROC>(renderbuffer_storage, loader, "glRenderbufferStorage");
    load<PFNGLDELETERENDERBUFFERSPROC>(delete_renderbuffers, loader, "glDeleteRenderbuffers");
    load<PFNGLGENFRAMEBUFFERSPROC>(gen_framebuffers, loader, "glGenFramebuffers");
    load<PFNGLBINDFRAMEBUFFERPROC>(bind_framebuffer, loader, "glBindFramebuffer");
    load<PFNGLFRAMEBUFFERRENDERBUFFERPROC>(framebuffer_renderbuffer, loader,
                                           "glFramebufferRenderbuffer");
    load<PFNGLFRAMEBUFFERTEXTUREPROC>(framebuffer_texture, loader, "glFramebufferTexture");
    load<PFNGLFRAMEBUFFERTEXTURELAYERPROC>(framebuffer_texture_layer, loader,
                                           "glFramebufferTextureLayer");
    load<PFNGLCHECKFRAMEBUFFERSTATUSPROC>(check_framebuffer_status, loader,
                                          "glCheckFramebufferStatus");
    load<PFNGLDELETEFRAMEBUFFERSPROC>(delete_framebuffers, loader, "glDeleteFramebuffers");
    load<PFNGLGENQUERIESPROC>(gen_queries, loader, "glGenQueries");
    load<PFNGLBEGINQUERYPROC>(begin_query, loader, "glBeginQuery");
    load<PFNGLENDQUERYPROC>(end_query, loader, "glEndQuery");
    load<PFNGLGETQUERYOBJECTUIVPROC>(get_query_objectuiv, loader, "glGetQueryObjectuiv");
    load<PFNGLDELETEQUERIESPROC>(delete_queries, loader, "glDeleteQueries");
    load<PFNGLENABLEPROC>(enable, loader, "glEnable");
    load<PFNGLDISABLEPROC>(disable, loader, "glDisable");
    load<PFNGLDEPTHFUNCPROC>(depth_func, loader, "glDepthFunc");
    load<PFNGLDEPTHMASKPROC>(depth_mask, loader, "glDepthMask");
    load<PFNGLCOLORMASKPROC>(color_mask, loader, "glColorMask");
    load<PFNGLPOLYGONMODEPROC>(polygon_mode, loader, "glPolygonMode");
    load<PFNGLDRAWBUFFERPROC>(draw_buffer, loader, "glDrawBuffer");
    load<PFNGLREADBUFFERPROC>(read_buffer, loader, "glReadBuffer");
    load<PFNGLVIEWPORTPROC>(viewport, loader, "glViewport");
    load<PFNGLSCISSORPROC>(scissor, loader, "glScissor");
    load<PFNGLCLEARBUFFERIVPROC>(clear_bufferiv, loader, "glClearBufferiv");
    load<PFNGLCLEARBUFFERFVPROC>(clear_bufferfv, loader, "glClearBufferfv");
    load<PFNGLDRAWARRAYSPROC>(draw_arrays, loader, "glDrawArrays");
    load<PFNGLDRAWELEMENTSPROC>(draw_elements, loader, "glDrawElements");
    load<PFNGLPIXELSTOREIPROC>(pixel_storei, loader, "glPixelStorei");
    load<PFNGLREADPIXELSPROC>(read_pixels, loader, "glReadPixels");
}

}  // namespace lightwell
