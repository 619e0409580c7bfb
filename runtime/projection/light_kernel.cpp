#include "runtime/projection/light_kernel.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/scene/light_flux.h"

namespace lightwell {

namespace {

/// Gauss's rule of 2 x 2 points resolves a cone's rim with cells smaller than this share of the
/// ring.
constexpr float largest_share_of_ring = 0.25F;

Light with_unit_intensity(const Light& light) {
    if (const auto* spot = std::get_if<SpotLight>(&light))
        return SpotLight{
            {}, spot->position, Rgb::Ones(), spot->direction, spot->inner_angle, spot->outer_angle};
    return PointLight{{}, position_of(light), Rgb::Ones()};
}

}  // namespace

LightKernel::LightKernel(const Light& light, const ElementCells& cells)
    : cells_(cells),
      unit_(with_unit_intensity(light)),
      height_(cells.normal().dot(position_of(light) - cells.centre())),
      position_((position_of(light) - cells.centre()).cast<float>()) {
    const auto* spot = std::get_if<SpotLight>(&light);
    if (spot == nullptr || spot->inner_angle >= 180) return;
    is_spot_ = true;
    axis_ = spot->direction.cast<float>();
    inner_ = static_cast<float>(std::cos(spot->inner_angle * M_PI / 180));
    outer_ = static_cast<float>(std::cos(spot->outer_angle * M_PI / 180));
    ring_ = static_cast<float>((spot->outer_angle - spot->inner_angle) * M_PI / 180);
}

Eigen::Array4f LightKernel::squared_distance(const FourPoints& points) const {
    return (points.x - position_[0]).square() + (points.y - position_[1]).square() +
           (points.z - position_[2]).square();
}

Eigen::Array4f LightKernel::at(const FourPoints& points) const {
    const Eigen::Array4f squared = squared_distance(points);
    const Eigen::Array4f distance = squared.sqrt();
    Eigen::Array4f kernel = static_cast<float>(height_) / (squared * distance);
    if (!is_spot_) return kernel;
    const Eigen::Array4f along = (points.x - position_[0]) * axis_[0] +
                                 (points.y - position_[1]) * axis_[1] +
                                 (points.z - position_[2]) * axis_[2];
    const Eigen::Array4f cosine = along / distance;
    if (!(inner_ > outer_)) return (cosine >= outer_).select(kernel, 0.0F);
    const Eigen::Array4f t = ((cosine - outer_) / (inner_ - outer_)).max(0.0F).min(1.0F);
    return kernel * t * t * (3.0F - 2.0F * t);
}

bool LightKernel::is_smooth(const FourPoints& points, float squared_size,
                            float largest_share) const {
    const float nearest = squared_distance(points).minCoeff();
    return squared_size <= largest_share * largest_share * nearest &&
           !(is_spot_ && straddles_the_rim(points, std::sqrt(squared_size) *
                                                       largest_share_for_gauss / largest_share));
}

bool LightKernel::straddles_the_rim(const FourPoints& points, float size) const {
    const Eigen::Array4f distance = squared_distance(points).sqrt();
    const float reach = size / distance.minCoeff();  // [rad], about
    if (reach <= largest_share_of_ring * ring_) return false;
    const Eigen::Array4f cosine =
        ((points.x - position_[0]) * axis_[0] + (points.y - position_[1]) * axis_[1] +
         (points.z - position_[2]) * axis_[2]) /
        distance;
    return cosine.minCoeff() - reach < inner_ && cosine.maxCoeff() + reach > outer_;
}

float LightKernel::flux(std::uint32_t finest) const {
    const ElementCells::Nodes& nodes = cells_.nodes(finest);
    if (!is_smooth(nodes.at, nodes.squared_size)) return exact_flux(cells_.cell(finest));
    return (at(nodes.at) * nodes.area).sum();
}

float LightKernel::exact_flux(const Quad& part) const {
    return static_cast<float>(lightwell::flux(unit_, ConvexPolygon(part))[0]);
}

}  // namespace lightwell
