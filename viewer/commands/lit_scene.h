#pragma once

#include <memory>
#include <vector>

#include "runtime/outgoing/final_gather.h"
#include "runtime/outgoing/glossy_light.h"
#include "viewer/commands/opened_operator.h"

namespace lightwell {

/// All the light in a scene for one set of lamps, solved, and what a final gather reads of it.
class LitScene {
  public:
    /// Keeps a reference to the operator.
    LitScene(const OpenedOperator& opened, const std::vector<Light>& lights,
             LampDirections lamps = LampDirections::kept);
    LitScene(const LitScene&) = delete;
    LitScene& operator=(const LitScene&) = delete;

    const Lighting& lighting() const { return lighting_; }
    const DirectLight& direct() const { return direct_; }
    /// What leaves glossy surfaces; nullptr where there are none.
    const GlossyLight* glossy() const { return glossy_.get(); }
    /// Directions along either side: see FinalGather.
    FinalGather gather(int strata) const;

  private:
    const OpenedOperator& opened_;
    std::vector<Light> lights_;
    Lighting lighting_;
    DirectLight direct_;
    std::unique_ptr<GlossyLight> glossy_;
};

/// What an eye sees of a surface [cd/m2].
struct SeenLight {
    Rgb direct = Rgb::Zero();    ///< emitted, and reflected of lamps' and emitting quads' light
    Rgb indirect = Rgb::Zero();  ///< reflected of light that was reflected before
};

/// The light that is seen from a point along a unit direction.
/// @param surfaces smooth indirect irradiance by element, for the view without a gather
/// @param gather   or nullptr, to read indirect light from the basis
SeenLight seen_light(const OpenedOperator& opened, const LitScene& lit,
                     const std::vector<Light>& lights, const std::vector<SmoothSurface>& surfaces,
                     const FinalGather* gather, const Vec3& eye, const Vec3& direction);

}  // namespace lightwell
