#include "viewer/window/probe.h"

#include <numeric>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/direct_light.h"

namespace lightwell {

namespace {

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The bounces of one field of direct light, as seen at one point.
class Bounces {
  public:
    Bounces(const OpenedOperator& opened, const ProbedPoint& point)
        : transport_(opened.transport),
          element_(transport_.space.element_on(point.quad, point.front)) {
        if (element_ >= 0)
            uv_ = transport_.space.element(static_cast<std::size_t>(element_))
                      .geometry.parameters(point.position);
    }

    std::vector<double> of(RadianceField light, const std::function<bool()>& stop_requested) const {
        constexpr double negligible = 1e-3;
        constexpr std::size_t most = 200;
        std::vector<double> bounces;
        // A side that takes no part sees no other surface.
        if (element_ < 0) return bounces;
        const double all = total_flux(transport_.space, light).sum();
        RadianceField together = RadianceField::Zero(light.rows(), light.cols());
        while (bounces.size() < most && !stop_requested()) {
            light = propagated(transport_.bounce, reflected(transport_, light));
            together += light;
            bounces.push_back(here(light));
            if (!(total_flux(transport_.space, light).sum() > negligible * all)) break;
        }
        // Reconstruction is kept between neighbouring means, so bounces one by one do not add up to
        // what is shown of all of them together.
        const double added = sum(bounces);
        const double shown = added > 0 ? here(together) / added : 0;
        for (double& bounce : bounces)
            bounce *= shown;
        return bounces;
    }

  private:
    double here(const RadianceField& light) const {
        return luminance(
            smooth_irradiance(transport_.space, static_cast<std::size_t>(element_), light)
                .at(uv_[0], uv_[1]));
    }

    const GlobalTransport& transport_;
    int element_;
    Vec2 uv_ = Vec2::Zero();
};

}  // namespace

double LightShare::indirect() const {
    return sum(bounces);
}

double ProbeReading::direct() const {
    double all = 0;
    for (const LightShare& share : shares)
        all += share.direct;
    return all;
}

double ProbeReading::indirect() const {
    return sum(bounces());
}

std::vector<double> ProbeReading::bounces() const {
    std::vector<double> bounces;
    for (const LightShare& share : shares) {
        if (share.bounces.size() > bounces.size()) bounces.resize(share.bounces.size());
        for (std::size_t k = 0; k < share.bounces.size(); ++k)
            bounces[k] += share.bounces[k];
    }
    return bounces;
}

ProbeReading read_probe(const OpenedOperator& opened, const std::vector<Light>& lights,
                        const ProbedPoint& point, const std::function<bool()>& stop_requested) {
    const Scene& scene = opened.transport.scene;
    const RadianceSpace& space = opened.transport.space;
    const DirectLight direct(scene, opened.visibility, opened.occluders);
    const Bounces bounces(opened, point);
    const Vec3 front = opened.quads[static_cast<std::size_t>(point.quad)].normal();
    const Vec3 normal = point.front ? front : Vec3(-front);

    ProbeReading reading;
    for (const Light& light : lights) {
        if (stop_requested()) return reading;
        LightShare share;
        share.name = name_of(light);
        share.direct = luminance(direct.from_light(point.position, normal, point.quad, light));
        share.bounces = bounces.of(projected_lights(space, {light}, opened.quads, opened.occluders),
                                   stop_requested);
        reading.shares.push_back(std::move(share));
    }
    if (!direct.emitters().empty()) {
        LightShare share;
        share.name = "surfaces";
        share.direct = luminance(direct.irradiance(point.position, normal, point.quad, {}));
        share.bounces = bounces.of(propagated(opened.transport.bounce, emission_of(scene, space)),
                                   stop_requested);
        reading.shares.push_back(std::move(share));
    }
    return reading;
}

}  // namespace lightwell
