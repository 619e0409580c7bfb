#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// R: what every element makes of incident radiance. One bounce is T = P R, with P the colourless
/// propagation between elements (DESIGN: T = P R; WRT eq. 3). R acts on directions alone, at each
/// spatial function by itself: the diffuse part keeps the mean and spreads it evenly, the lobe is
/// the material's AngularReflection at the element's angular levels. An element without angular
/// functions reflects by the mean albedo of its material.
class Reflection {
  public:
    /// Keeps a reference to the space. Computes the representation of each lobe once per angular
    /// level that it is used at.
    Reflection(const Scene& scene, const RadianceSpace& space);

    /// R x: outgoing radiance, in the same basis, per channel.
    RadianceField outgoing(const RadianceField& incident) const;

  private:
    /// What an element does; the lobe is index `lobe` into lobes_, -1 without one.
    struct OfElement {
        Rgb diffuse = Rgb::Zero();
        Rgb specular = Rgb::Zero();
        int lobe = -1;
    };

    const RadianceSpace& space_;
    std::vector<AngularReflection> lobes_;
    std::vector<OfElement> of_element_;
};

/// Light that was reflected at least once, T (E + T E + ...) with T = P R: the fixed point of
/// B = P R (E + B), by iteration until B changes by less than `tolerance` of itself.
RadianceField bounced_light(const SymmetricOperator& propagation, const Reflection& reflection,
                            const RadianceField& direct, double tolerance = 1e-6);

}  // namespace lightwell
