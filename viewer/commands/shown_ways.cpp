#include "viewer/commands/shown_ways.h"

#include <memory>

#include <tbb/parallel_for.h>

#include "runtime/frame.h"
#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/lighting.h"
#include "solver/reference/error_estimate.h"
#include "viewer/commands/lit_scene.h"
#include "viewer/commands/measure_command.h"

namespace lightwell {

namespace {

Lighting lit(const OpenedOperator& opened, const PointLight& lamp, Propagation propagation) {
    return light_scene(opened.transport, {lamp}, opened.quads, opened.occluders, propagation);
}

Rgb in_texture(const OpenedOperator& opened, const TextureAtlas& textures,
               const SurfacePoint& point) {
    const Vec3 up = opened.quads[static_cast<std::size_t>(point.quad)].normal();
    const int e = opened.transport.space.element_on(point.quad, point.normal.dot(up) > 0);
    if (e < 0) return Rgb::Zero();
    const auto element = static_cast<std::size_t>(e);
    const Vec2 uv = opened.transport.space.element(element).geometry.parameters(point.position);
    return textures.bilinear(element, uv[0], uv[1]).head<3>().cast<double>();
}

}  // namespace

ShownLight picture_way(const OpenedOperator& opened) {
    return {"picture", [&opened](const PointLight& lamp, const std::vector<SurfacePoint>& points) {
                const RadianceSpace& space = opened.transport.space;
                return shown_at(
                    points, space,
                    smooth_irradiance(space, lit(opened, lamp, Propagation::gathered).indirect),
                    opened.quads);
            }};
}

ShownLight measure_way(const OpenedOperator& opened) {
    return {"measure", [&opened](const PointLight& lamp, const std::vector<SurfacePoint>& points) {
                const std::vector<Light> lamps = {lamp};
                const LitScene scene(opened, lamps);
                const FinalGather gather =
                    scene.gather(gather_strata(opened.transport.provenance.error_asked));
                std::vector<Rgb> values(points.size());
                tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
                    const SurfacePoint& p = points[k];
                    values[k] = gather.irradiance(p.position, p.normal, p.quad);
                });
                return values;
            }};
}

ShownLight textures_way(const OpenedOperator& opened) {
    const auto frame = std::make_shared<Frame>(
        opened.transport,
        std::make_unique<ShadowProjection>(opened.transport.space, opened.quads, opened.occluders));
    return {"textures",
            [&opened, frame](const PointLight& lamp, const std::vector<SurfacePoint>& points) {
                frame->light({lamp});
                std::vector<Rgb> values;
                for (const SurfacePoint& point : points)
                    values.push_back(in_texture(opened, frame->textures(), point));
                return values;
            }};
}

}  // namespace lightwell
