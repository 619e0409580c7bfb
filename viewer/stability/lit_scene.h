#pragma once

#include <vector>

#include "runtime/propagation/lighting.h"
#include "solver/precompute.h"
#include "solver/reference/surface_points.h"

namespace lightwell::stability {

/// A scene with its transport, computed in this process and never judged.
class LitScene {
  public:
    /// @param error  as PrecomputeOptions::error
    LitScene(const Scene& scene, double error);
    LitScene(const Scene& scene, const PrecomputeOptions& options);

    const GlobalTransport& transport() const { return transport_; }
    const std::vector<Quad>& quads() const { return quads_; }
    const OccluderTree& occluders() const { return occluders_; }
    const PrecomputeReport& report() const { return report_; }

    Lighting light(const std::vector<Light>& lights, Propagation how = Propagation::solved) const;
    /// Irradiance of the finest cells of all elements [lx], red, one after the other, and their
    /// open areas [m2].
    Eigen::ArrayXd cells(const RadianceField& field) const;
    Eigen::ArrayXd cell_areas() const;
    /// Mean over the surface [lx].
    double mean(const RadianceField& field) const;
    /// Indirect irradiance [lx], red, as `lightwell measure` gathers it.
    std::vector<double> gathered(const Lighting& lighting,
                                 const std::vector<SurfacePoint>& points) const;
    /// The same as a picture shows it.
    std::vector<double> shown(const Lighting& lighting,
                              const std::vector<SurfacePoint>& points) const;

  private:
    std::vector<Quad> quads_;
    OccluderTree occluders_;
    PrecomputeReport report_;
    GlobalTransport transport_;
};

/// How far the illuminance of a furnace is from 1 lx: its mean, and its cells, rms.
struct Ripple {
    double mean = 0, rms = 0;
};
Ripple ripple_of(const LitScene& furnace, Propagation how = Propagation::solved);

/// Points of a quad's front at these parameters, in both directions.
std::vector<SurfacePoint> grid_on(const Scene& scene, int quad, const std::vector<double>& at);

/// max |a/b - 1|.
double worst_ratio(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace lightwell::stability
