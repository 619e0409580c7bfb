#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "radiance4d/basis/smooth_surface.h"
#include "runtime/outgoing/final_gather.h"

namespace lightwell {

/// What the lobes of glossy elements send towards one eye, smooth over each element: one product
/// with the BRDF per visible cell (WRT section 5.3). Elements turned away from the eye cost
/// nothing.
class EyeRadiance {
  public:
    /// What the lobe of an element sends from a point of it towards a unit direction.
    using Look = std::function<GatheredRadiance(std::size_t element, const Vec3& point,
                                                const Vec3& direction)>;

    /// @param finer levels by which cells are cut once more: light read from the basis has no
    ///              more detail than they have, gathered light does
    /// @param check called now and then, from several threads; may throw to stop the work
    EyeRadiance(const RadianceSpace& space, const Vec3& eye, int finer, const Look& look,
                const std::function<void()>& check);

    /// Whether the element is glossy and faces the eye.
    bool shows(std::size_t element) const { return element_[element].has_value(); }
    /// At (u,v) of an element that it shows [cd/m2].
    GatheredRadiance at(std::size_t element, const Vec2& uv) const;

  private:
    struct Seen {
        SmoothSurface indirect, emitted;
    };
    std::vector<std::optional<Seen>> element_;
};

}  // namespace lightwell
