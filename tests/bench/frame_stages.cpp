#include "tests/bench/frame_stages.h"

#include <algorithm>

#include "radiance4d/operator/light_projection.h"

namespace lightwell {

PackedField direct_light(const BenchScene& scene, int centimetres) {
    return packed(projected_lights(scene.transport.space, scene.lamp(centimetres), scene.quads,
                                   scene.occluders));
}

double median(std::vector<double> all) {
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

}  // namespace lightwell
