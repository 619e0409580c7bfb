#pragma once

#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/direct_light.h"
#include "runtime/outgoing/glossy_product.h"
#include "runtime/propagation/lighting.h"

namespace lightwell {

/// Light that a surface reflects towards one direction [cd/m2].
struct GatheredRadiance {
    Rgb indirect = Rgb::Zero();  ///< of light that surfaces reflected before
    Rgb emitted = Rgb::Zero();   ///< of the light of emitting quads
};

/// What the lobe of a glossy element makes of the light of lamps, exactly, with shadow rays: the
/// radiance [cd/m2] towards a unit direction, at a point of the element.
Rgb lobe_of_lamps(const GlobalTransport& transport, const DirectLight& direct,
                  const std::vector<Light>& lights, std::size_t element, const Vec3& point,
                  const Vec3& direction);

/// The light that leaves glossy surfaces. What came from lamps is exact, with shadow rays: a
/// highlight is as sharp as the material makes it. The rest is the product of the solved incident
/// light with the BRDF.
class GlossyLight {
  public:
    /// Keeps references to the first three.
    GlossyLight(const GlobalTransport& transport, const DirectLight& direct,
                const std::vector<Light>& lights, const Lighting& lighting);

    bool is_glossy(std::size_t element) const { return indirect_.is_glossy(element); }

    /// Radiance [cd/m2] towards a unit direction, of the light of lamps, at a point of an element.
    Rgb from_lamps(std::size_t element, const Vec3& point, const Vec3& direction) const;
    /// The same of some lamps alone.
    Rgb from(const std::vector<Light>& lamps, std::size_t element, const Vec3& point,
             const Vec3& direction) const;
    /// The lobe's part of the light of lamps.
    Rgb lobe_from_lamps(std::size_t element, const Vec3& point, const Vec3& direction) const;
    /// The same of indirect light, as the basis holds it.
    Rgb indirect(std::size_t element, const Vec3& point, const Vec3& direction) const;
    /// The same of the light of emitting quads.
    Rgb from_emitters(std::size_t element, const Vec3& point, const Vec3& direction) const;
    /// What the lobe alone makes of indirect light and of that of emitting quads.
    GatheredRadiance from_lobe(std::size_t element, const Vec3& point, const Vec3& direction) const;
    /// All of indirect light, of emitting quads' and of lamps'.
    Rgb radiance(std::size_t element, const Vec3& point, const Vec3& direction) const;

  private:
    Rgb of(const GlossyProduct& product, std::size_t element, const Vec3& point,
           const Vec3& direction) const;

    const GlobalTransport& transport_;
    const DirectLight& direct_;
    const std::vector<Light>& lights_;
    bool has_emitters_;
    GlossyProduct indirect_;
    GlossyProduct emitted_;
};

}  // namespace lightwell
