#include "viewer/charts/judged_scene.h"

#include <algorithm>
#include <cmath>

#include "radiance4d/failure.h"
#include "radiance4d/scene/scene_quads.h"
#include "solver/reference/deviation.h"
#include "solver/reference/random_lights.h"

namespace lightwell {

ChartedScene::ChartedScene(const Scene& of)
    : scene(without_emission(of)), quads(quads_of(scene)), visibility(quads), occluders(quads) {}

JudgedScene::JudgedScene(const ChartedScene& scene, const GlobalTransport& transport, int lamps,
                         int points, const Progress& progress)
    : scene_(scene) {
    constexpr std::uint64_t seed = 1848;
    const std::vector<Vec3> positions =
        positions_in_rooms(scene.scene, scene.visibility, lamps, seed);
    if (positions.empty())
        throw InputError(
            scene.scene.geometry_file +
            ": no place for a lamp among surfaces that reflect light, so there is nothing to "
            "chart");
    EstimateOptions judge;
    judge.points = points;
    judge.noise = 0.02;
    judge.seed = seed;
    judged_ = judged_lights(transport, scene.quads, scene.visibility, scene.occluders, positions,
                            judge, progress);
}

JudgedError JudgedScene::error_of(const GlobalTransport& transport, Propagation propagation) const {
    std::vector<WeighedValue> squares;
    JudgedError error;
    for (const JudgedLight& one : judged_) {
        const Lighting lighting =
            light_scene(transport, {one.light}, scene_.quads, scene_.occluders, propagation);
        const std::vector<Rgb> shown =
            shown_at(one.points, transport.space,
                     smooth_irradiance(transport.space, lighting.indirect), scene_.quads);
        const Deviation deviation = deviation_from(one.truth, shown, one.weight);
        if (!(deviation.reference_square > 0)) continue;
        const double square = deviation.square / deviation.reference_square;
        squares.push_back({square});
        error.worst_lamp = std::max(error.worst_lamp, std::sqrt(std::max(square, 0.0)));
    }
    if (squares.size() >= 2) error.rms = rms_interval(squares);
    return error;
}

}  // namespace lightwell
