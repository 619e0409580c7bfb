#pragma once

#include <vector>

#include "radiance4d/scene/light.h"
#include "runtime/propagation/packed_field.h"

namespace lightwell {

/// A way to project the lamps on the basis (WRT section 5.1). All ways give the same E, each in its
/// own time and precision.
class LightProjection {
  public:
    virtual ~LightProjection() = default;
    LightProjection() = default;
    LightProjection(const LightProjection&) = delete;
    LightProjection& operator=(const LightProjection&) = delete;

    /// direct <- E of the lights together: half-densities, see RadianceField. It has as many
    /// columns as the space has functions.
    virtual void project(const std::vector<Light>& lights, PackedField& direct) = 0;
};

}  // namespace lightwell
