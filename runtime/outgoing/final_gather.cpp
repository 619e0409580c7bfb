#include "runtime/outgoing/final_gather.h"

#include <cmath>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// An orthonormal frame with the given z axis (Duff et al. 2017).
Eigen::Matrix3d frame_about(const Vec3& z) {
    const double sign = std::copysign(1.0, z[2]);
    const double a = -1 / (sign + z[2]);
    const double b = z[0] * z[1] * a;
    Eigen::Matrix3d frame;
    frame.col(0) = Vec3(1 + sign * z[0] * z[0] * a, sign * b, -sign * z[0]);
    frame.col(1) = Vec3(b, sign + z[1] * z[1] * a, -z[1]);
    frame.col(2) = z;
    return frame;
}

}  // namespace

FinalGather::FinalGather(const GlobalTransport& transport, const Visibility& visibility,
                         std::vector<SmoothSurface> incident, int strata)
    : transport_(transport),
      visibility_(visibility),
      incident_(std::move(incident)),
      albedo_(mean_albedos(transport.scene.materials)) {
    // One jittered point per stratum of the angular square, the same for every sensor: neighbouring
    // sensors then differ by what they see and not by chance.
    std::mt19937_64 random(20060626);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int i = 0; i < strata; ++i)
        for (int j = 0; j < strata; ++j) {
            const double s = (i + uniform()) / strata;
            const double t = (j + uniform()) / strata;
            directions_.push_back(direction_from_square({s, t}));
        }
}

Rgb FinalGather::irradiance(const Vec3& point, const Vec3& normal, int on_quad) const {
    // E = Int L cos dw = pi * mean of L over the angular square, and L = rho E_y / pi.
    const Eigen::Matrix3d frame = frame_about(normal);
    Rgb sum = Rgb::Zero();
    for (const Vec3& local : directions_) {
        const Vec3 direction = frame * local;
        const Hit hit = visibility_.nearest(point, on_quad, direction);
        if (!hit) continue;
        const int element = transport_.space.element_on(hit.quad, hit.front);
        if (element < 0) continue;
        const Element& met = transport_.space.element(static_cast<std::size_t>(element));
        const Vec2 uv = met.geometry.parameters(point + hit.distance * direction);
        sum += albedo_[transport_.scene.material_number(hit.quad)] *
               incident_[static_cast<std::size_t>(element)].at(uv[0], uv[1]);
    }
    return sum / static_cast<double>(directions_.size());
}

}  // namespace lightwell
