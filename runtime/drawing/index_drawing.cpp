#include "runtime/drawing/index_drawing.h"

#include <array>
#include <cstddef>

#include <GL/glcorearb.h>

#include "runtime/drawing/gl_state.h"

namespace lightwell {

namespace {

// For the plane n.x = d the inverse depth along the ray (X, Y, 1) is n / d . (X, Y, 1).
constexpr const char* vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base;
flat out vec3 seen_plane;
flat out int quad;
uniform vec3 eye;
uniform mat3 frame;
uniform float across, up;  // tangents of half the angle of view
uniform float nearest;
void main() {
    vec3 seen = frame * (corner - eye);
    seen_plane = frame * normal / dot(normal, base - eye);
    quad = gl_VertexID / 4;
    gl_Position = vec4(seen.xy / vec2(across, up), seen.z - 2.0 * nearest, seen.z);
}
)";

constexpr const char* fragment_shader = R"(#version 330 core
flat in vec3 seen_plane;
flat in int quad;
uniform vec4 pixel;  // scale and shift from window coordinates to the ray's X, then Y
uniform float nearest;
layout(location = 0) out int index;
void main() {
    vec2 at = gl_FragCoord.xy * pixel.xz + pixel.yw;
    gl_FragDepth = nearest * dot(seen_plane, vec3(at, 1.0));
    index = quad;
}
)";

struct Vertex {
    std::array<float, 3> corner, normal, base;
};

std::array<float, 3> as_floats(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

const void* offset(std::size_t bytes) {
    return reinterpret_cast<const void*>(bytes);
}

}  // namespace

IndexDrawing::IndexDrawing(const GlFunctions& gl, const std::vector<Quad>& quads)
    : gl_(gl),
      count_(static_cast<int>(quads.size())),
      program_(make_program(gl, vertex_shader, fragment_shader)),
      vertex_array_(make_vertex_array(gl)),
      vertices_(make_buffer(gl)),
      elements_(make_buffer(gl)) {
    std::vector<Vertex> vertices;
    std::vector<unsigned> elements;
    for (const Quad& quad : quads) {
        const auto first = static_cast<unsigned>(vertices.size());
        for (const Vec3& corner : quad.vertex)
            vertices.push_back(
                {as_floats(corner), as_floats(quad.normal()), as_floats(quad.vertex[0])});
        for (const unsigned corner : {0U, 1U, 2U, 0U, 2U, 3U})
            elements.push_back(first + corner);
    }
    gl_.bind_vertex_array(vertex_array_.name());
    gl_.bind_buffer(GL_ELEMENT_ARRAY_BUFFER, elements_.name());
    gl_.buffer_data(GL_ELEMENT_ARRAY_BUFFER,
                    static_cast<std::ptrdiff_t>(elements.size() * sizeof(unsigned)),
                    elements.data(), GL_STATIC_DRAW);
    gl_.bind_buffer(GL_ARRAY_BUFFER, vertices_.name());
    gl_.buffer_data(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(vertices.size() * sizeof(Vertex)),
                    vertices.data(), GL_STATIC_DRAW);
    const std::array<std::size_t, 3> offsets = {offsetof(Vertex, corner), offsetof(Vertex, normal),
                                                offsetof(Vertex, base)};
    for (const unsigned attribute : {0U, 1U, 2U}) {
        gl_.enable_vertex_attrib_array(attribute);
        gl_.vertex_attrib_pointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                                  offset(offsets[attribute]));
    }
    gl_.bind_vertex_array(0);
    gl_.bind_buffer(GL_ARRAY_BUFFER, 0);
    check_gl(gl_, "preparing the quads");
}

void IndexDrawing::clear(int width, int height) const {
    for (const unsigned feature : {GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST,
                                   GL_RASTERIZER_DISCARD, GL_POLYGON_OFFSET_FILL})
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
    gl_.bind_vertex_array(vertex_array_.name());
    gl_.draw_elements(GL_TRIANGLES, 6 * count_, GL_UNSIGNED_INT, nullptr);
    gl_.bind_vertex_array(0);
}

}  // namespace lightwell
