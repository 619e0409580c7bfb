#pragma once

#include <Eigen/Core>

#include "radiance4d/scene/light.h"
#include "runtime/projection/element_cells.h"

namespace lightwell {

/// One lamp as it shines on one element: flux per solid angle, in single precision and for four
/// points at once, relative to the intensity on the axis.
class LightKernel {
  public:
    LightKernel(const Light& light, const ElementCells& cells);

    /// Distance of the lamp from the element's plane [m]; not positive behind it, where it shines
    /// on nothing.
    double height() const { return height_; }
    /// The lamp relative to the element's centre [m].
    const Eigen::Vector3f& position() const { return position_; }

    /// Relative intensity times cosine over squared distance, at four points of the element's plane
    /// [1/m2].
    Eigen::Array4f at(const FourPoints& points) const;
    /// Flux on a finest cell with nothing between, for an intensity of 1 cd [lm].
    float flux(std::uint32_t finest) const;
    /// Flux on any part of the element, exactly, for an intensity of 1 cd [lm].
    float exact_flux(const Quad& part) const;
    /// Gauss's rule of 2 x 2 points is right to 1e-4 for cells smaller than this share of their
    /// distance: its error for cos / r^2 is about 0.02 (size / distance)^4, by the side.
    static constexpr float largest_share_for_gauss = 0.33F;
    /// Whether a part of that squared size [m2] is smaller than this share of its distance from the
    /// lamp, and the rim of a cone does not run through it.
    bool is_smooth(const FourPoints& points, float squared_size,
                   float largest_share = largest_share_for_gauss) const;

  private:
    bool straddles_the_rim(const FourPoints& points, float size) const;
    Eigen::Array4f squared_distance(const FourPoints& points) const;

    const ElementCells& cells_;
    Light unit_;  ///< the lamp with an intensity of 1 cd
    double height_;
    Eigen::Vector3f position_;
    bool is_spot_ = false;
    Eigen::Vector3f axis_ = Eigen::Vector3f::UnitZ();
    float inner_ = -1, outer_ = -1;  ///< cosines of the spot's angles
    float ring_ = 0;                 ///< width of the ring between them [rad]
};

}  // namespace lightwell
