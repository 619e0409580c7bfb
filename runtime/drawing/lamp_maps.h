#pragma once

#include <optional>
#include <vector>

#include "runtime/drawing/index_drawing.h"

namespace lightwell {

/// What lamps see: for each, the six faces of a cube around it with the index of the nearest quad
/// in every pixel. The faces lie side by side, three by two, in one layer of a texture; each is
/// wider than 90 degrees by `margin` pixels on every side, so that a pixel's neighbours are in the
/// same face.
///
/// Face 2 a looks along axis a and face 2 a + 1 against it; right is the axis a + 1 and top is a +
/// 2, modulo 3.
class LampMaps {
  public:
    /// Keeps references to both.
    /// @param side  of a face [pixels]; smaller where lamps are so many that their maps would fill
    ///              more than 256 MiB
    LampMaps(const GlFunctions& gl, const IndexDrawing& quads, int side);

    static constexpr int margin = 2;
    int side() const { return side_; }
    /// The tangent of half a face's angle of view.
    double reach() const { return static_cast<double>(side_) / (side_ - 2 * margin); }
    /// The texture: 32-bit integers, a layer for each lamp.
    unsigned texture() const { return texture_.name(); }

    /// Looks from these places, in the coordinates of the quads; only from those that differ from
    /// the last call's.
    /// @return how many that were
    /// @throws SystemError for more lamps than OpenGL has layers of a texture for: at least 256
    int look_from(const std::vector<Vec3>& places);

  private:
    void make_room(std::size_t lamps);

    const GlFunctions& gl_;
    const IndexDrawing& quads_;
    int side_, wanted_side_;
    int most_layers_ = 0;
    std::vector<std::optional<Vec3>> seen_from_;  ///< by layer
    GlObject texture_, framebuffer_, depth_;
};

}  // namespace lightwell
