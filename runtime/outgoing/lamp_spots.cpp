#include "runtime/outgoing/lamp_spots.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/basis/direction_map.h"

namespace lightwell {

namespace {

/// Of a lamp, over the whole sphere.
constexpr int rays = 256;

}  // namespace

std::vector<LampSpot> lamp_spots(const GlobalTransport& transport, const Visibility& visibility,
                                 const std::vector<NearLamp>& lamps) {
    std::vector<LampSpot> spots;
    for (const NearLamp& lamp : lamps) {
        const Vec3& from = position_of(lamp.light);
        for (int k = 0; k < rays; ++k) {
            const Vec3 direction = spiral_direction(k, rays);
            const Hit hit = visibility.nearest(from, free_point, direction);
            if (!hit) continue;
            const int number = transport.space.element_on(hit.quad, hit.front);
            const auto e = static_cast<std::size_t>(std::max(number, 0));
            if (number < 0 ||
                std::find(lamp.elements.begin(), lamp.elements.end(), e) == lamp.elements.end())
                continue;
            LampSpot spot;
            spot.element = e;
            spot.position = from + hit.distance * direction;
            spot.to_lamp = -direction;
            spot.flux = intensity_towards(lamp.light, direction) * (4 * M_PI / rays);
            spot.density = density_of_rays(lamp.light, spot.position,
                                           transport.space.element(e).geometry.normal());
            spots.push_back(spot);
        }
    }
    return spots;
}

double density_of_rays(const Light& lamp, const Vec3& point, const Vec3& normal) {
    const Vec3 way = position_of(lamp) - point;
    const double squared = way.squaredNorm();
    const double cosine_area = std::max(0.0, way.dot(normal));
    return squared > 0 ? rays / (4 * M_PI) * cosine_area / (squared * std::sqrt(squared)) : 0;
}

}  // namespace lightwell
