#include "runtime/drawing/index_drawing.h"

#include <array>

#include <GL/glcorearb.h>

#include "runtime/drawing/gl_state.h"

namespace lightwell {

namespace {

constexpr const char* vertex_shader = R"(
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base;
flat out vec3 seen_plane;
flat out int quad;
uniform vec3 eye;
uniform mat3 frame;
uniform float across, up;  // tangents of half the angle of view
void main() {
    vec3 seen = frame * (corner - eye);
    seen_plane = frame * normal / dot(normal, base - eye);
    quad = gl_VertexID / 4;
    gl_Position = drawn_at(seen.xy / vec2(across, up), seen.z);
}
)";

constexpr const char* fragment_shader = R"(
flat in vec3 seen_plane;
flat in int quad;
uniform vec4 pixel;  // scale and shift from window coordinates to the ray's X, then Y
layout(location = 0) out int index;
void main() {
    gl_FragDepth = depth_of(seen_plane, gl_FragCoord.xy * pixel.xz + pixel.yw);
    index = quad;
}
)";

}  // namespace

IndexDrawing::IndexDrawing(const GlFunctions& gl, const std::vector<Quad>& quads)
    : gl_(gl),
      count_(quads.size()),
      program_(make_program(gl, plane_shader(vertex_shader).c_str(),
                            plane_shader(fragment_shader).c_str())),
      quads_(gl, quads, quads) {}

void IndexDrawing::clear(int width, int height) const {
    for (const unsigned feature :
         {GL_CULL_FACE, GL_BLEND, GL_STENCIL_TEST, GL_RASTERIZER_DISCARD, GL_POLYGON_OFFSET_FILL})
        gl_.disable(feature);
    gl_.enable(GL_DEPTH_TEST);
    gl_.depth_func(GL_GREATER);
    gl_.depth_mask(GL_TRUE);
    gl_.color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_.polygon_mode(GL_FRONT_AND_BACK, GL_FILL);
    gl_.viewport(0, 0, width, height);
    const std::array<int, 4> nothing = {-1, -1, -1, -1};
    const float infinitely_far = 0;
    gl_.clear_bufferiv(GL_COLOR, 0, nothing.data());
    gl_.clear_bufferfv(GL_DEPTH, 0, &infinitely_far);
}

void IndexDrawing::draw(const IndexView& view) const {
    gl_.viewport(view.left, view.bottom, view.width, view.height);
    const ProgramInUse program(gl_, program_);
    program.set("eye", view.eye);
    program.set("frame", view.frame);
    program.set("across", view.across);
    program.set("up", view.up);
    program.set("nearest", static_cast<double>(nearest));
    program.set("pixel", Eigen::Vector4d(2 * view.across / view.width,
                                         -view.across * (1 + 2.0 * view.left / view.width),
                                         2 * view.up / view.height,
                                         -view.up * (1 + 2.0 * view.bottom / view.height)));
    quads_.bind(gl_);
    PlaneQuads::draw(gl_, 0, count_);
    gl_.bind_vertex_array(0);
}

}  // namespace lightwell
