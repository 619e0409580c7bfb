#include "viewer/stability/lit_scene.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/scene_quads.h"
#include "runtime/outgoing/final_gather.h"
#include "viewer/stability/case_scenes.h"

namespace lightwell::stability {

namespace {

PrecomputeOptions once(double error) {
    PrecomputeOptions options;
    options.error = error;
    options.most_attempts = 0;
    return options;
}

}  // namespace

LitScene::LitScene(const Scene& scene, double error) : LitScene(scene, once(error)) {}

LitScene::LitScene(const Scene& scene, const PrecomputeOptions& options)
    : quads_(quads_of(scene)),
      occluders_(quads_),
      transport_(precompute(scene, options, {}, report_)) {}

Lighting LitScene::light(const std::vector<Light>& lights, Propagation how) const {
    return light_scene(transport_, lights, quads_, occluders_, how);
}

Eigen::ArrayXd LitScene::cells(const RadianceField& field) const {
    Eigen::ArrayXd all(transport_.space.functions());
    for (std::size_t e = 0; e < transport_.space.elements().size(); ++e) {
        const Element& element = transport_.space.element(e);
        all.segment(element.first, element.functions()) =
            cell_irradiance(transport_.space, e, field).col(0);
    }
    return all;
}

Eigen::ArrayXd LitScene::cell_areas() const {
    Eigen::ArrayXd all(transport_.space.functions());
    for (const Element& element : transport_.space.elements())
        for (std::uint32_t m = 0; m < element.functions(); ++m) {
            const bool buried = !element.open.empty() && element.open[m] == 0;
            all[element.first + m] =
                buried ? 0 : element.space.area({element.space.tree().levels(), m});
        }
    return all;
}

double LitScene::mean(const RadianceField& field) const {
    return total_flux(transport_.space, field)[0] / transport_.space.area();
}

std::vector<double> LitScene::gathered(const Lighting& lighting,
                                       const std::vector<SurfacePoint>& points) const {
    constexpr int strata = 48;
    const Visibility visibility(quads_);
    const FinalGather gather(
        transport_, visibility,
        smooth_irradiance(transport_.space, lighting.direct + lighting.indirect), strata);
    std::vector<double> result;
    for (const SurfacePoint& point : points)
        result.push_back(gather.irradiance(point.position, point.normal, point.quad)[0]);
    return result;
}

std::vector<double> LitScene::shown(const Lighting& lighting,
                                    const std::vector<SurfacePoint>& points) const {
    const std::vector<SmoothSurface> surfaces =
        smooth_irradiance(transport_.space, lighting.indirect);
    std::vector<double> result;
    for (const SurfacePoint& point : points) {
        const int e = transport_.space.element_on(point.quad, true);
        const auto element = static_cast<std::size_t>(e);
        const Vec2 uv = transport_.space.element(element).geometry.parameters(point.position);
        result.push_back(surfaces[element].at(uv[0], uv[1])[0]);
    }
    return result;
}

Ripple ripple_of(const LitScene& furnace, Propagation how) {
    const Lighting lighting = furnace.light({}, how);
    const Eigen::ArrayXd area = furnace.cell_areas();
    const Eigen::ArrayXd off = furnace.cells(lighting.direct + lighting.indirect) - 1;
    return {std::abs((area * off).sum() / area.sum()),
            std::sqrt((area * off.square()).sum() / area.sum())};
}

std::vector<SurfacePoint> grid_on(const Scene& scene, int quad, const std::vector<double>& at) {
    const Quad& shape = scene.quads[static_cast<std::size_t>(quad)].quad;
    std::vector<SurfacePoint> points;
    for (const double v : at)
        for (const double u : at)
            points.push_back({shape.point(u, v), shape.normal(), quad});
    return points;
}

double worst_ratio(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        worst = std::max(worst, std::abs(a[k] / b[k] - 1));
    return worst;
}

}  // namespace lightwell::stability
