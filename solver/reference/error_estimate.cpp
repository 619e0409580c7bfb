#include "solver/reference/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/operator/smooth_irradiance.h"
#include "solver/reference/path_tracer.h"
#include "solver/reference/sampling.h"

namespace lightwell {

namespace {

/// What a picture shows at a surface point, 0 on sides that take no part.
Rgb shown(const GlobalTransport& transport, const std::vector<SmoothSurface>& irradiance,
          const std::vector<Quad>& quads, const SurfacePoint& point) {
    const bool front = point.normal.dot(quads[static_cast<std::size_t>(point.quad)].normal()) > 0;
    const int number = transport.space.element_on(point.quad, front);
    if (number < 0) return Rgb::Zero();
    const Element& element = transport.space.element(static_cast<std::size_t>(number));
    const Vec2 uv = element.geometry.parameters(point.position);
    return irradiance[static_cast<std::size_t>(number)].at(uv[0], uv[1]);
}

/// How well a point can be seen: the cosine-weighted share of the hemisphere over it that is open,
/// or filled by sides that take part in transport. 0 inside a solid or under its foot; small in the
/// gap behind a picture, where a picture of the room shows almost nothing.
double visible_share(const RadianceSpace& space, const Visibility& visibility,
                     const SurfacePoint& point) {
    constexpr int looks_along = 4;
    int visible = 0;
    for (int i = 0; i < looks_along; ++i) {
        for (int j = 0; j < looks_along; ++j) {
            const Vec3 direction =
                cosine_direction(point.normal, {(i + 0.5) / looks_along, (j + 0.5) / looks_along});
            const Hit hit = visibility.nearest(point.position, point.quad, direction);
            if (!hit || space.element_on(hit.quad, hit.front) >= 0) ++visible;
        }
    }
    return static_cast<double>(visible) / (looks_along * looks_along);
}

}  // namespace

double ErrorEstimate::rms() const {
    double squares = 0;
    for (const double error : by_light)
        squares += error * error;
    return by_light.empty() ? 0 : std::sqrt(squares / static_cast<double>(by_light.size()));
}

double ErrorEstimate::ninth_of_ten() const {
    if (by_light.empty()) return 0;
    std::vector<double> sorted = by_light;
    std::sort(sorted.begin(), sorted.end());
    // Linear between order statistics.
    const double at = 0.9 * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const auto above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

ErrorEstimate estimate_error(const GlobalTransport& transport, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const Visibility& visibility,
                             const std::vector<Vec3>& positions, const EstimateOptions& options,
                             const Progress& progress) {
    Scene dark = transport.scene;
    for (Material& material : dark.materials)
        material.emission = Rgb::Zero();
    const std::vector<QuadSide> sides = seeing_sides(dark, visibility);
    ErrorEstimate estimate;
    Rgb stored_flux = Rgb::Zero(), solved_flux = Rgb::Zero();
    for (std::size_t k = 0; k < positions.size(); ++k) {
        progress.check();
        progress.say("estimate", static_cast<double>(k) / static_cast<double>(positions.size()));
        PointLight light;
        light.position = positions[k];
        light.intensity = Rgb::Ones();
        const RadianceField direct = projected_lights(transport.space, {light}, quads, occluders);
        stored_flux += total_flux(transport.space, global_light(transport, direct) - direct);
        solved_flux += total_flux(transport.space, solved_light(transport, direct));
        const std::vector<SmoothSurface> irradiance =
            smooth_irradiance(transport.space, gathered_light(transport, direct));

        const std::vector<SurfacePoint> points =
            sample_surface(dark, sides, options.points, options.seed + k);
        PathTracing tracing;
        tracing.samples = 64;
        tracing.seed = options.seed + k;
        NoiseTarget target;
        target.relative = options.noise;
        target.floor = 1;
        const IrradianceSurvey judged =
            PathTracer(dark, visibility, {light}).indirect_to(target, points, tracing);
        estimate.rays += judged.rays;
        double squares = 0, reference = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            const IrradianceEstimate& truth = judged.at[p];
            const double weight = visible_share(transport.space, visibility, points[p]);
            const double noise = truth.standard_error.square().sum();
            const Rgb error = shown(transport, irradiance, quads, points[p]) - truth.mean;
            squares += weight * (error.square().sum() - noise);
            reference += weight * (truth.mean.square().sum() - noise);
        }
        // A light that nothing reflects has no relative error.
        if (reference > 0)
            estimate.by_light.push_back(std::sqrt(std::max(0.0, squares) / reference));
    }
    if (solved_flux.sum() > 0) estimate.energy_dropped = 1 - stored_flux.sum() / solved_flux.sum();
    return estimate;
}

}  // namespace lightwell
