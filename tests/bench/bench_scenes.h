#pragma once

#include <string>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/occluder_tree.h"

namespace lightwell {

/// A sample scene computed to 5 %, with lamps to move in it.
struct BenchScene {
    GlobalTransport transport;
    std::vector<Quad> quads;
    OccluderTree occluders;

    /// The scene's first lamp, moved by so many metres.
    std::vector<Light> lamp(const Vec3& by) const;
    /// Moved along x by so many centimetres.
    std::vector<Light> lamp(int centimetres) const { return lamp(Vec3(0.01 * centimetres, 0, 0)); }
};

/// A scene by its folder's name. Read from the folder that LIGHTWELL_BENCH_OPERATORS names if that
/// holds NAME.gto, else precomputed, which takes from seconds to a minute; kept either way.
const BenchScene& bench_scene(const std::string& name);

/// Seconds that bench_scene took to precompute it; 0 if it was read.
double precompute_seconds(const std::string& name);

}  // namespace lightwell
