#include "runtime/drawing/plane_quads.h"

#include <array>
#include <cstddef>

#include <GL/glcorearb.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

constexpr std::size_t elements_a_quad = 6;

// Of a position's depth only the clipping is used: -w <= z keeps w >= nearest.
constexpr const char* prologue = R"(#version 330 core
uniform float nearest;
vec4 drawn_at(vec2 place, float forward) {
    return vec4(place, forward - 2.0 * nearest, forward);
}
float depth_of(vec3 plane, vec2 ray) {
    return nearest * dot(plane, vec3(ray, 1.0));
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

std::string plane_shader(const char* body) {
    return std::string(prologue) + body;
}

PlaneQuads::PlaneQuads(const GlFunctions& gl, const std::vector<Quad>& quads,
                       const std::vector<Quad>& planes)
    : vertex_array_(make_vertex_array(gl)), vertices_(make_buffer(gl)), elements_(make_buffer(gl)) {
    LIGHTWELL_CHECK_OP(quads.size(), ==, planes.size());
    std::vector<Vertex> vertices;
    std::vector<unsigned> elements;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const auto first = static_cast<unsigned>(vertices.size());
        for (const Vec3& corner : quads[q].vertex)
            vertices.push_back(
                {as_floats(corner), as_floats(planes[q].normal()), as_floats(planes[q].vertex[0])});
        for (const unsigned corner : {0U, 1U, 2U, 0U, 2U, 3U})
            elements.push_back(first + corner);
    }
    gl.bind_vertex_array(vertex_array_.name());
    gl.bind_buffer(GL_ELEMENT_ARRAY_BUFFER, elements_.name());
    gl.buffer_data(GL_ELEMENT_ARRAY_BUFFER,
                   static_cast<std::ptrdiff_t>(elements.size() * sizeof(unsigned)), elements.data(),
                   GL_STATIC_DRAW);
    gl.bind_buffer(GL_ARRAY_BUFFER, vertices_.name());
    gl.buffer_data(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(vertices.size() * sizeof(Vertex)),
                   vertices.data(), GL_STATIC_DRAW);
    const std::array<std::size_t, 3> offsets = {offsetof(Vertex, corner), offsetof(Vertex, normal),
                                                offsetof(Vertex, base)};
    for (const unsigned attribute : {0U, 1U, 2U}) {
        gl.enable_vertex_attrib_array(attribute);
        gl.vertex_attrib_pointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                                 offset(offsets[attribute]));
    }
    gl.bind_vertex_array(0);
    gl.bind_buffer(GL_ARRAY_BUFFER, 0);
    check_gl(gl, "preparing the quads");
}

void PlaneQuads::draw(const GlFunctions& gl, std::size_t first, std::size_t count) {
    gl.draw_elements(GL_TRIANGLES, static_cast<int>(elements_a_quad * count), GL_UNSIGNED_INT,
                     offset(elements_a_quad * first * sizeof(unsigned)));
}

}  // namespace lightwell
