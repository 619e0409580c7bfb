#include "runtime/drawing/surface_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "runtime/drawing/plane_quads.h"

namespace lightwell {

namespace {

// `corner` and `plane` are in camera coordinates (right, top, forward).
constexpr const char* vertex_shader = R"(
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 plane;
layout(location = 2) in int quad;
flat out vec3 seen_plane;
flat out int seen_quad;
uniform vec4 window;  // scale and shift of x, then of y
void main() {
    seen_plane = plane;
    seen_quad = quad;
    gl_Position = drawn_at(corner.xy * window.xz + corner.z * window.yw, corner.z);
}
)";

constexpr const char* fragment_shader = R"(
flat in vec3 seen_plane;
flat in int seen_quad;
uniform vec3 pixel;  // shift of x, shift of y, size
layout(location = 0) out int index;
void main() {
    vec2 at = (gl_FragCoord.xy + pixel.xy) * pixel.z;
    gl_FragDepth = depth_of(seen_plane, vec2(at.x, -at.y));
    index = seen_quad;
}
)";

/// Nothing nearer than this part of the farthest distance is drawn.
constexpr double nearest_part = 1e-5;

struct Vertex {
    std::array<float, 3> corner;
    std::array<float, 3> plane;
    int quad;
};

std::array<float, 3> as_floats(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// An image of integers with depth, to draw on; bound while it lives.
class Target {
  public:
    Target(const GlFunctions& gl, int width, int height)
        : gl_(gl),
          width_(width),
          height_(height),
          framebuffer_(make_framebuffer(gl)),
          colour_(make_renderbuffer(gl, GL_R32I, width, height)),
          depth_(make_renderbuffer(gl, GL_DEPTH_COMPONENT32F, width, height)) {
        gl.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                    colour_.name());
        gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                    depth_.name());
        check_gl(gl, "making an image to draw on");
        const unsigned status = gl.check_framebuffer_status(GL_FRAMEBUFFER);
        if (status != GL_FRAMEBUFFER_COMPLETE)
            throw SystemError(
                fmt::format("OpenGL cannot draw {} x {} pixels (framebuffer status 0x{:04x})",
                            width, height, status));
    }
    ~Target() { gl_.bind_framebuffer(GL_FRAMEBUFFER, 0); }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    /// The integers, OpenGL's first row first.
    std::vector<int> read() const {
        std::vector<int> integers(static_cast<std::size_t>(width_) *
                                  static_cast<std::size_t>(height_));
        gl_.bind_buffer(GL_PIXEL_PACK_BUFFER, 0);
        for (const unsigned parameter :
             {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES})
            gl_.pixel_storei(parameter, 0);
        gl_.pixel_storei(GL_PACK_ALIGNMENT, 4);
        gl_.read_pixels(0, 0, width_, height_, GL_RED_INTEGER, GL_INT, integers.data());
        return integers;
    }

  private:
    const GlFunctions& gl_;
    int width_, height_;
    GlObject framebuffer_, colour_, depth_;
};

/// Clears the target, and sets all the state that our drawing depends on: others draw with this
/// context, too.
void set_state(const GlFunctions& gl, int width, int height) {
    for (const unsigned feature : {GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST,
                                   GL_RASTERIZER_DISCARD, GL_POLYGON_OFFSET_FILL})
        gl.disable(feature);
    gl.enable(GL_DEPTH_TEST);
    gl.depth_func(GL_GREATER);
    gl.depth_mask(GL_TRUE);
    gl.color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.polygon_mode(GL_FRONT_AND_BACK, GL_FILL);
    gl.viewport(0, 0, width, height);
    const std::array<int, 4> nothing = {-1, -1, -1, -1};
    const float infinitely_far = 0;
    gl.clear_bufferiv(GL_COLOR, 0, nothing.data());
    gl.clear_bufferfv(GL_DEPTH, 0, &infinitely_far);
}

const void* offset(std::size_t bytes) {
    return reinterpret_cast<const void*>(bytes);
}

}  // namespace

SurfaceDrawing::SurfaceDrawing(std::vector<Quad> quads, const GlLoader& loader)
    : quads_(std::move(quads)),
      gl_(loader),
      program_(make_program(gl_, plane_shader(vertex_shader).c_str(),
                            plane_shader(fragment_shader).c_str())),
      vertex_array_(make_vertex_array(gl_)),
      vertices_(make_buffer(gl_)),
      elements_(make_buffer(gl_)) {
    int renderbuffer = 0;
    std::array<int, 2> viewport = {};
    gl_.get_integerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
    gl_.get_integerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    longest_side_ = std::min({renderbuffer, viewport[0], viewport[1]}) - 2;

    std::vector<unsigned> elements;
    elements.reserve(6 * quads_.size());
    for (unsigned first = 0; first < 4 * quads_.size(); first += 4)
        for (const unsigned corner : {0u, 1u, 2u, 0u, 2u, 3u})
            elements.push_back(first + corner);

    gl_.bind_vertex_array(vertex_array_.name());
    gl_.bind_buffer(GL_ELEMENT_ARRAY_BUFFER, elements_.name());
    gl_.buffer_data(GL_ELEMENT_ARRAY_BUFFER,
                    static_cast<std::ptrdiff_t>(elements.size() * sizeof(unsigned)),
                    elements.data(), GL_STATIC_DRAW);
    gl_.bind_buffer(GL_ARRAY_BUFFER, vertices_.name());
    for (const unsigned attribute : {0u, 1u, 2u})
        gl_.enable_vertex_attrib_array(attribute);
    gl_.vertex_attrib_pointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              offset(offsetof(Vertex, corner)));
    gl_.vertex_attrib_pointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              offset(offsetof(Vertex, plane)));
    gl_.vertex_attrib_i_pointer(2, 1, GL_INT, sizeof(Vertex), offset(offsetof(Vertex, quad)));
    gl_.bind_vertex_array(0);
    check_gl(gl_, "preparing the quads");
}

SurfaceBuffer SurfaceDrawing::draw(const CameraRays& camera, const PixelWindow& window) const {
    return meet_surfaces(quads_, camera, draw_indices(camera, window));
}

float SurfaceDrawing::upload(const CameraRays& camera) const {
    double farthest = 0;
    std::vector<Vertex> vertices;
    vertices.reserve(4 * quads_.size());
    for (std::size_t q = 0; q < quads_.size(); ++q) {
        Quad seen = quads_[q];
        for (Vec3& corner : seen.vertex) {
            corner = camera.in_camera(corner);
            farthest = std::max(farthest, corner.norm());
        }
        // A plane through the eye itself is seen edge-on, as nothing: its depth is the farthest.
        const double distance = seen.normal().dot(seen.centre());
        const Vec3 plane = seen.normal() / distance;
        const auto inverse = as_floats(plane.allFinite() ? plane : Vec3::Zero());
        for (const Vec3& corner : seen.vertex)
            vertices.push_back({as_floats(corner), inverse, static_cast<int>(q)});
    }
    gl_.bind_buffer(GL_ARRAY_BUFFER, vertices_.name());
    gl_.buffer_data(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(vertices.size() * sizeof(Vertex)),
                    vertices.data(), GL_STREAM_DRAW);
    gl_.bind_buffer(GL_ARRAY_BUFFER, 0);
    return static_cast<float>(nearest_part * farthest);
}

void SurfaceDrawing::draw_elements(const CameraRays& camera, const PixelWindow& canvas) const {
    const double f = camera.focal_length();
    const double left = canvas.left - 0.5 * camera.width();
    const double top = canvas.top - 0.5 * camera.height();
    const float nearest = upload(camera);
    const auto uniform = [&](const char* name) {
        return gl_.get_uniform_location(program_.name(), name);
    };
    gl_.use_program(program_.name());
    // The image is drawn upside down, so that OpenGL's first row is the picture's top row.
    gl_.uniform4f(uniform("window"), static_cast<float>(2 * f / canvas.width),
                  static_cast<float>(-2 * left / canvas.width - 1),
                  static_cast<float>(-2 * f / canvas.height),
                  static_cast<float>(-2 * top / canvas.height - 1));
    gl_.uniform3f(uniform("pixel"), static_cast<float>(left), static_cast<float>(top),
                  static_cast<float>(1 / f));
    gl_.uniform1f(uniform("nearest"), nearest);
    gl_.bind_vertex_array(vertex_array_.name());
    gl_.draw_elements(GL_TRIANGLES, static_cast<int>(6 * quads_.size()), GL_UNSIGNED_INT, nullptr);
    gl_.bind_vertex_array(0);
    gl_.use_program(0);
}

DrawnQuads SurfaceDrawing::draw_indices(const CameraRays& camera, const PixelWindow& window) const {
    LIGHTWELL_CHECK_OP(window.width, >, 0);
    LIGHTWELL_CHECK_OP(window.height, >, 0);
    LIGHTWELL_CHECK_OP(std::max(window.width, window.height), <=, longest_side_);
    // With the margin.
    const PixelWindow canvas = {window.left - 1, window.top - 1, window.width + 2,
                                window.height + 2};
    const Target target(gl_, canvas.width, canvas.height);
    set_state(gl_, canvas.width, canvas.height);
    draw_elements(camera, canvas);
    DrawnQuads drawn{window, target.read()};
    check_gl(gl_, "drawing the quads");
    return drawn;
}

}  // namespace lightwell
