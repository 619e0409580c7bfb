#pragma once

#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/scene/occluder_tree.h"

namespace lightwell {

/// How the indirect light is found from the stored operators.
enum class Propagation {
    stored,    ///< H E: the global transport operator as it is
    gathered,  ///< T (E + H E): one last bounce at full resolution
    solved,    ///< iterated on the bounce operator until it is exact
};

/// Whether the light of lamps enters glossy surfaces from where it comes, or as if from everywhere
/// (see without_directions).
enum class LampDirections { kept, forgotten };

/// The light in a scene for one set of lamps: half-density fields of irradiance on all elements.
struct Lighting {
    RadianceField direct;    ///< E, from lamps and emitting quads
    RadianceField indirect;  ///< X - E
};

/// Projects the lamps and the scene's emitting quads, and propagates them.
Lighting light_scene(const GlobalTransport& transport, const std::vector<Light>& lights,
                     const std::vector<Quad>& quads, const OccluderTree& occluders,
                     Propagation propagation, LampDirections lamps = LampDirections::kept);

}  // namespace lightwell
