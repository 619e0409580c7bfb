#pragma once

#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"
#include "runtime/propagation/lighting.h"
#include "solver/reference/confidence.h"
#include "solver/reference/error_estimate.h"

namespace lightwell {

/// A scene without emission, and the search structures over its quads.
struct ChartedScene {
    explicit ChartedScene(const Scene& of);

    Scene scene;
    std::vector<Quad> quads;
    Visibility visibility;
    OccluderTree occluders;
};

/// What an operator is wrong by over some lamps.
struct JudgedError {
    Interval rms;           ///< relative L2 of indirect irradiance over the lamps; 0: not known
    double worst_lamp = 0;  ///< the same of the lamp with the largest
};

/// The indirect light of some lamps by path tracing, to measure operators of the scene against. All
/// are measured with the same lamps, places and paths, as `verify` measures one, so that what
/// differs between them is not chance.
class JudgedScene {
  public:
    /// Keeps a reference to the scene.
    /// @param transport  an operator of the scene, that tells where to look
    /// @throws InputError if there is no room for a lamp
    JudgedScene(const ChartedScene& scene, const GlobalTransport& transport, int lamps, int points,
                const Progress& progress);

    /// Error of indirect irradiance, reconstructed smoothly from the basis.
    JudgedError error_of(const GlobalTransport& transport, Propagation propagation) const;

    const std::vector<JudgedLight>& lights() const { return judged_; }

  private:
    const ChartedScene& scene_;
    std::vector<JudgedLight> judged_;
};

}  // namespace lightwell
