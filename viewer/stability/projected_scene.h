#pragma once

#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/occluder_tree.h"

namespace lightwell::stability {

/// Quads whose fronts receive direct light, in cells.
class ProjectedScene {
  public:
    /// @param cell  largest side of a finest cell [m]
    ProjectedScene(const std::vector<Quad>& quads, double cell);

    const RadianceSpace& space() const { return space_; }
    /// Direct light as measuring projects it.
    RadianceField measured(const std::vector<Light>& lights) const;
    /// As drawing projects it.
    RadianceField drawn(const std::vector<Light>& lights) const;
    /// Irradiance of a quad's finest cells [lx], by cell.
    Eigen::ArrayXd cells(std::size_t quad, const RadianceField& field) const;
    /// Flux on one quad, and on all [lm].
    double flux(std::size_t quad, const RadianceField& field) const;
    double flux(const RadianceField& field) const;

  private:
    std::vector<Quad> quads_;
    RadianceSpace space_;
    OccluderTree occluders_;
};

}  // namespace lightwell::stability
