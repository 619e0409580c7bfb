#pragma once

#include <vector>

#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/progress.h"
#include "radiance4d/scene/occluder_tree.h"

namespace lightwell {

/// How much light a basis function can be expected to carry, over point lights anywhere in the
/// scene.
struct LightEnsemble {
    /// Root mean square, over the lights, of the coefficients of the direct light: what the columns
    /// of H see.
    Eigen::ArrayXd direct;
    /// The same of all light, direct and indirect: what the columns of the bounce operator see.
    Eigen::ArrayXd total;
};

/// One channel of the direct light of an isotropic point light of 1 cd.
Eigen::ArrayXd white_light(const RadianceSpace& space, const Vec3& position,
                           const std::vector<Quad>& quads, const OccluderTree& occluders);

/// Projects white unit lights and takes root mean squares, each light scaled so that its indirect
/// light, estimated on whole elements with `mean_bounce` (the coefficients of M between whole
/// elements) and `reflectance` (by element), has norm one: then a weighted coefficient is an error
/// relative to the indirect light. Costs no rays but for the positions.
LightEnsemble light_ensemble(const RadianceSpace& space, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const std::vector<Vec3>& positions,
                             const SymmetricOperator& mean_bounce,
                             const Eigen::ArrayXd& reflectance, const Progress& progress);

}  // namespace lightwell
