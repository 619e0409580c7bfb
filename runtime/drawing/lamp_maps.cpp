#include "runtime/drawing/lamp_maps.h"

#include <algorithm>
#include <cmath>

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "runtime/drawing/gl_state.h"

namespace lightwell {

namespace {

/// Texels of all maps together: 256 MiB.
constexpr double most_texels = 1 << 26;
constexpr int least_side = 16;

/// The rows are a face's right, top and forward.
Eigen::Matrix3d frame_of_face(int face) {
    const int axis = face / 2;
    Eigen::Matrix3d frame = Eigen::Matrix3d::Zero();
    frame(0, (axis + 1) % 3) = 1;
    frame(1, (axis + 2) % 3) = 1;
    frame(2, axis) = face % 2 == 0 ? 1 : -1;
    return frame;
}

}  // namespace

LampMaps::LampMaps(const GlFunctions& gl, const IndexDrawing& quads, int side)
    : gl_(gl),
      quads_(quads),
      side_(side),
      wanted_side_(side),
      texture_(make_texture(gl)),
      framebuffer_(make_framebuffer(gl)),
      depth_(make_renderbuffer(gl, GL_DEPTH_COMPONENT32F, 3 * side, 2 * side)) {
    LIGHTWELL_CHECK_OP(side, >=, least_side);
    gl_.get_integerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_layers_);
    make_room(1);
}

void LampMaps::make_room(std::size_t lamps) {
    // What many lamps needed is given back when few are left.
    constexpr std::size_t few = 4;
    const std::size_t room = seen_from_.size();
    if (lamps <= room && (room <= few || few * lamps >= room)) return;
    const auto most = static_cast<std::size_t>(most_layers_);
    if (lamps > most)
        throw SystemError(fmt::format("OpenGL cannot draw {} lamps, {} at most", lamps, most));
    const std::size_t wanted = room == 0 ? lamps : std::max(few, 2 * lamps);
    seen_from_.assign(std::min(most, wanted), std::nullopt);
    const double texels = most_texels / (6 * static_cast<double>(seen_from_.size()));
    side_ = std::clamp(static_cast<int>(std::sqrt(texels)), least_side, wanted_side_);
    depth_ = make_renderbuffer(gl_, GL_DEPTH_COMPONENT32F, 3 * side_, 2 * side_);
    gl_.active_texture(GL_TEXTURE0);
    gl_.bind_texture(GL_TEXTURE_2D_ARRAY, texture_.name());
    for (const unsigned filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl_.tex_parameteri(GL_TEXTURE_2D_ARRAY, filter, GL_NEAREST);
    gl_.tex_parameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    gl_.tex_image_3d(GL_TEXTURE_2D_ARRAY, 0, GL_R32I, 3 * side_, 2 * side_,
                     static_cast<int>(seen_from_.size()), 0, GL_RED_INTEGER, GL_INT, nullptr);
    gl_.bind_texture(GL_TEXTURE_2D_ARRAY, 0);
    check_gl(gl_, "making room for what lamps see");
}

int LampMaps::look_from(const std::vector<Vec3>& places) {
    make_room(places.size());
    int looked = 0;
    for (std::size_t lamp = 0; lamp < places.size(); ++lamp) {
        if (seen_from_[lamp] && *seen_from_[lamp] == places[lamp]) continue;
        gl_.bind_framebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        gl_.framebuffer_texture_layer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture_.name(), 0,
                                      static_cast<int>(lamp));
        gl_.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                     depth_.name());
        if (gl_.check_framebuffer_status(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw SystemError("OpenGL cannot draw what a lamp sees");
        const LimitedRows all(gl_, 3 * side_, 0, 2 * side_);
        quads_.clear(3 * side_, 2 * side_);
        for (int face = 0; face < 6; ++face)
            quads_.draw({places[lamp], frame_of_face(face), reach(), reach(), face % 3 * side_,
                         face / 3 * side_, side_, side_});
        seen_from_[lamp] = places[lamp];
        ++looked;
    }
    check_gl(gl_, "drawing what lamps see");
    return looked;
}

}  // namespace lightwell
