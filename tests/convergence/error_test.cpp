// The error that a picture shows falls with the error asked for, as path tracing sees it.
#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/operator/smooth_irradiance.h"
#include "runtime/propagation/lighting.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "solver/reference/deviation.h"
#include "solver/reference/path_tracer.h"
#include "solver/reference/random_lights.h"

namespace lightwell {
namespace {

/// One unseen lamp, and what the path tracer makes of it.
struct Judged {
    Light light;
    IrradianceSurvey truth;
};

TEST(Convergence, ErrorFallsWithTheErrorAskedFor) {
    Scene scene = read_scene(std::string(LIGHTWELL_SCENES) + "/cornell-box/scene.toml").scene;
    for (Material& material : scene.materials)
        material.emission.setZero();
    std::vector<Quad> quads;
    for (const SceneQuad& q : scene.quads)
        quads.push_back(q.quad);
    const Visibility visibility(quads);
    const OccluderTree occluders(quads);
    const std::vector<SurfacePoint> points =
        sample_surface(scene, seeing_sides(scene, visibility), 150, 5);
    std::vector<Judged> judged;
    for (const PointLight& light : random_lights(scene, visibility, 3, 4711)) {
        const PathTracer tracer(scene, visibility, {light});
        NoiseTarget target;
        target.relative = 0.02;
        target.floor = 1;
        judged.push_back({light, tracer.indirect_to(target, points)});
    }

    double previous = 1;
    for (const double asked : {0.2, 0.1, 0.05}) {
        PrecomputeOptions options;
        options.error = asked;
        options.most_attempts = 3;
        PrecomputeReport report;
        const GlobalTransport transport = precompute(scene, options, {}, report);
        double squares = 0;
        for (const Judged& one : judged) {
            const Lighting lighting =
                light_scene(transport, {one.light}, quads, occluders, Propagation::gathered);
            const auto surfaces = smooth_irradiance(transport.space, lighting.indirect);
            std::vector<Rgb> values;
            for (const SurfacePoint& point : points) {
                const auto q = static_cast<std::size_t>(point.quad);
                const int e =
                    transport.space.element_on(point.quad, point.normal.dot(quads[q].normal()) > 0);
                Rgb value = Rgb::Zero();
                if (e >= 0) {
                    const auto element = static_cast<std::size_t>(e);
                    const Vec2 at =
                        transport.space.element(element).geometry.parameters(point.position);
                    value = surfaces[element].at(at[0], at[1]);
                }
                values.push_back(value);
            }
            const Deviation deviation = deviation_from(one.truth.at, values);
            squares += deviation.relative_rms * deviation.relative_rms;
        }
        const double reached = std::sqrt(squares / static_cast<double>(judged.size()));
        RecordProperty("reached_at_" + std::to_string(asked), std::to_string(reached));
        EXPECT_LT(reached, asked);
        EXPECT_LT(reached, previous) << "asked for " << asked;
        previous = reached;
    }
}

}  // namespace
}  // namespace lightwell
