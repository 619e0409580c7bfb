#include "runtime/projection/lamp_depth.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <GL/glcorearb.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

constexpr const char* vertex_shader = R"(
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base;
flat out vec3 seen_plane;
uniform vec3 lamp;
uniform mat3 view;
uniform mat3 view_of_planes;
void main() {
    vec3 seen = view * (corner - lamp);
    seen_plane = view_of_planes * normal / dot(normal, base - lamp);
    gl_Position = drawn_at(seen.xy, seen.z);
}
)";

constexpr const char* fragment_shader = R"(
flat in vec3 seen_plane;
uniform vec4 pixel;  // shift of x, shift of y, size, and how much nearer than it is
void main() {
    vec2 at = (gl_FragCoord.xy + pixel.xy) * pixel.z;
    gl_FragDepth = pixel.w * depth_of(seen_plane, at);
}
)";

constexpr double nearest_part = 1e-5;
/// What is counted is drawn nearer by this part of its distance, so that a quad is not hidden by
/// another in its own plane: some 30 roundings.
constexpr float nearer = 1 + 4e-6F;

/// Queries between two flushes: processors that draw (llvmpipe) miscount, by any amount, where more
/// work has piled up than a query began with room for. 32 were seen to be few enough.
constexpr std::size_t most_together = 16;

/// The quads that hide and the parts that are counted, about an origin of their own.
std::vector<Quad> centred(const std::vector<Quad>& quads, const std::vector<Quad>& parts,
                          const Vec3& centre) {
    std::vector<Quad> all = quads;
    all.insert(all.end(), parts.begin(), parts.end());
    for (Quad& quad : all)
        for (Vec3& corner : quad.vertex)
            corner -= centre;
    return all;
}

/// The quads whose planes those lie in.
std::vector<Quad> planes_of(const std::vector<Quad>& quads, const std::vector<int>& quad_of,
                            const Vec3& centre) {
    std::vector<Quad> planes = centred(quads, {}, centre);
    for (const int quad : quad_of)
        planes.push_back(planes[static_cast<std::size_t>(quad)]);
    return planes;
}

Eigen::AlignedBox3d box_of(const std::vector<Quad>& quads) {
    Eigen::AlignedBox3d box(Vec3(Vec3::Zero()));
    if (!quads.empty()) box = Eigen::AlignedBox3d(quads[0].vertex[0]);
    for (const Quad& quad : quads)
        for (const Vec3& corner : quad.vertex)
            box.extend(corner);
    return box;
}

}  // namespace

LampDepth::LampDepth(const std::vector<Quad>& quads, const std::vector<Quad>& parts,
                     const std::vector<int>& quad_of, int side, const GlLoader& loader)
    : gl_(loader),
      side_(side),
      centre_(box_of(quads).center()),
      extent_(quads.empty() ? 1 : box_of(quads).diagonal().norm()),
      occluder_count_(quads.size()),
      parts_(parts),
      program_(make_program(gl_, plane_shader(vertex_shader).c_str(),
                            plane_shader(fragment_shader).c_str())),
      drawn_(gl_, centred(quads, parts, centre_), planes_of(quads, quad_of, centre_)),
      framebuffer_(make_framebuffer(gl_)),
      depth_(make_renderbuffer(gl_, GL_DEPTH_COMPONENT32F, 3 * side, 2 * side)) {
    gl_.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                 depth_.name());
    gl_.draw_buffer(GL_NONE);
    gl_.read_buffer(GL_NONE);
    const unsigned status = gl_.check_framebuffer_status(GL_FRAMEBUFFER);
    gl_.bind_framebuffer(GL_FRAMEBUFFER, 0);
    check_gl(gl_, "making a depth buffer for a lamp");
    if (status != GL_FRAMEBUFFER_COMPLETE) throw SystemError("OpenGL cannot draw what a lamp sees");
}

LampDepth::~LampDepth() {
    if (!names_.empty()) gl_.delete_queries(static_cast<int>(names_.size()), names_.data());
}

void LampDepth::begin(bool counts_hidden, bool is_depth_kept) {
    gl_.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    for (const unsigned feature : {GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST,
                                   GL_RASTERIZER_DISCARD, GL_POLYGON_OFFSET_FILL})
        gl_.disable(feature);
    gl_.enable(GL_DEPTH_TEST);
    gl_.depth_func(counts_hidden ? GL_ALWAYS : GL_GEQUAL);
    gl_.depth_mask(is_depth_kept ? GL_TRUE : GL_FALSE);
    gl_.polygon_mode(GL_FRONT_AND_BACK, GL_FILL);
    gl_.use_program(program_.name());
    drawn_.bind(gl_);
    const auto at = lamp_.cast<float>();
    gl_.uniform3f(gl_.get_uniform_location(program_.name(), "lamp"), at[0], at[1], at[2]);
    gl_.uniform1f(gl_.get_uniform_location(program_.name(), "nearest"),
                  static_cast<float>(nearest_part * extent_));
}

void LampDepth::end() const {
    gl_.depth_mask(GL_TRUE);
    gl_.bind_vertex_array(0);
    gl_.use_program(0);
    gl_.bind_framebuffer(GL_FRAMEBUFFER, 0);
}

void LampDepth::select_view(std::size_t view, float nearness) {
    const int left = static_cast<int>(view) % 3 * side_, top = static_cast<int>(view) / 3 * side_;
    gl_.viewport(left, top, side_, side_);
    // OpenGL's matrices have their columns one after the other, as Eigen's do.
    const Eigen::Matrix3f points = views_[view].seen.cast<float>();
    const Eigen::Matrix3f planes = views_[view].seen.inverse().transpose().cast<float>();
    gl_.uniform_matrix3fv(gl_.get_uniform_location(program_.name(), "view"), 1, GL_FALSE,
                          points.data());
    gl_.uniform_matrix3fv(gl_.get_uniform_location(program_.name(), "view_of_planes"), 1, GL_FALSE,
                          planes.data());
    const float half = 0.5F * static_cast<float>(side_);
    gl_.uniform4f(gl_.get_uniform_location(program_.name(), "pixel"),
                  -static_cast<float>(left) - half, -static_cast<float>(top) - half, 1 / half,
                  nearness);
}

void LampDepth::look_from(const Vec3& lamp, const std::vector<LampView>& views) {
    LIGHTWELL_CHECK_OP(views.size(), <=, most_views);
    lamp_ = lamp - centre_;
    views_ = views;
    begin(false, true);
    const float infinitely_far = 0;
    gl_.viewport(0, 0, 3 * side_, 2 * side_);
    gl_.clear_bufferfv(GL_DEPTH, 0, &infinitely_far);
    for (std::size_t view = 0; view < views_.size(); ++view) {
        select_view(view, 1);
        PlaneQuads::draw(gl_, 0, occluder_count_);
    }
    end();
    check_gl(gl_, "drawing what a lamp sees");
}

bool LampDepth::reaches(std::uint32_t part, std::size_t view) const {
    Quad seen = parts_[part];
    for (Vec3& corner : seen.vertex)
        corner -= centre_ + lamp_;
    return views_[view].reaches(seen);
}

void LampDepth::issue(const std::vector<Query>& queries, std::size_t first_name) {
    for (std::size_t k = 0; k < queries.size(); ++k) {
        gl_.begin_query(GL_SAMPLES_PASSED, names_[first_name + k]);
        PlaneQuads::draw(gl_, queries[k].quad, 1);
        gl_.end_query(GL_SAMPLES_PASSED);
        if (k % most_together == most_together - 1) gl_.flush();
    }
}

std::size_t LampDepth::count(std::vector<CountedPart>& parts) {
    std::size_t needed = 0;
    for (std::size_t view = 0; view < views_.size(); ++view) {
        queries_[view].clear();
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const bool is_counted =
                parts[k].view == CountedPart::all_views || parts[k].view == static_cast<int>(view);
            if (is_counted && reaches(parts[k].part, view))
                queries_[view].push_back({k, occluder_count_ + parts[k].part});
        }
        needed += 2 * queries_[view].size();
    }
    if (needed > names_.size()) {
        const std::size_t known = names_.size();
        names_.resize(needed);
        gl_.gen_queries(static_cast<int>(needed - known), names_.data() + known);
    }

    std::size_t issued = 0;
    for (const bool counts_hidden : {true, false}) {
        begin(counts_hidden, false);
        for (std::size_t view = 0; view < views_.size(); ++view) {
            if (queries_[view].empty()) continue;
            select_view(view, nearer);
            issue(queries_[view], issued);
            issued += queries_[view].size();
        }
    }
    end();

    for (CountedPart& part : parts)
        part.all = part.visible = 0;
    std::size_t read = 0;
    for (const bool counts_hidden : {true, false})
        for (std::size_t view = 0; view < views_.size(); ++view)
            for (const Query& query : queries_[view]) {
                unsigned samples = 0;
                gl_.get_query_objectuiv(names_[read++], GL_QUERY_RESULT, &samples);
                CountedPart& part = parts[query.counted];
                (counts_hidden ? part.all : part.visible) += samples;
            }
    check_gl(gl_, "counting what a lamp sees");
    return needed;
}

}  // namespace lightwell
