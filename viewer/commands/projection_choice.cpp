#include "viewer/commands/projection_choice.h"

#include <utility>
#include <vector>

#include "radiance4d/failure.h"
#include "runtime/projection/fastest_projection.h"
#include "runtime/projection/occlusion_query_projection.h"
#include "runtime/projection/shadow_projection.h"
#include "solver/reading/input_file.h"

namespace lightwell {

namespace {

/// One of the scene's lamps, or one before its first quad: the ways differ alike for all.
std::vector<Light> lights_to_try(const OpenedOperator& opened) {
    const std::vector<Light>& lights = opened.transport.scene.lights;
    if (!lights.empty()) return {lights[0]};
    PointLight anywhere;
    anywhere.position = opened.quads[0].centre() + opened.quads[0].normal();
    anywhere.intensity = Rgb::Ones();
    return {anywhere};
}

/// A beam from the same place, which meets few surfaces.
SpotLight narrow(const Light& light) {
    SpotLight beam;
    beam.position = position_of(light);
    beam.intensity = Rgb::Ones();
    beam.direction = -Vec3::UnitZ();
    beam.inner_angle = 5;
    beam.outer_angle = 10;
    return beam;
}

}  // namespace

ProjectionWay projection_argument(const std::string& option, const std::string& text) {
    if (text == "fastest") return ProjectionWay::fastest;
    if (text == "rays") return ProjectionWay::rays;
    if (text == "queries") return ProjectionWay::queries;
    throw InputError(Place{option}, in_quotes(text) + " is not fastest, rays or queries");
}

ChosenProjection chosen_projection(const OpenedOperator& opened, const GlLoader& loader,
                                   ProjectionWay way) {
    const RadianceSpace& space = opened.transport.space;
    std::vector<std::unique_ptr<LightProjection>> ways;
    if (way != ProjectionWay::queries)
        ways.push_back(std::make_unique<ShadowProjection>(space, opened.quads, opened.occluders));
    if (way != ProjectionWay::rays)
        ways.push_back(std::make_unique<OcclusionQueryProjection>(space, opened.quads,
                                                                  opened.occluders, loader));
    if (way != ProjectionWay::fastest) return {std::move(ways[0]), way};
    const LightProjection* const by_rays = ways[0].get();
    const std::vector<Light> lights = lights_to_try(opened);
    std::unique_ptr<LightProjection> fastest =
        fastest_projection(std::move(ways), {narrow(lights[0])}, lights, space.functions());
    const bool is_by_rays = fastest.get() == by_rays;
    return {std::move(fastest), is_by_rays ? ProjectionWay::rays : ProjectionWay::queries};
}

}  // namespace lightwell
