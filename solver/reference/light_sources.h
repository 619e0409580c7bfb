#pragma once

#include <vector>

#include "radiance4d/scene/scene.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// Point and spot lights, each with the cone of directions that it shines into and the probability
/// of being picked, which is proportional to intensity times solid angle.
struct LampSet {
    struct Lamp {
        Light light;
        Vec3 axis = Vec3::UnitZ();  ///< of the cone, unit
        double edge_cosine = -1;    ///< of the cone; -1 is the whole sphere
        double pick = 0;            ///< probability
        double pick_density = 0;    ///< pick / solid angle of the cone [1/sr]
    };
    std::vector<Lamp> lamps;  ///< those that shine

    explicit LampSet(const std::vector<Light>& lights);
    bool empty() const { return lamps.empty(); }
    const Lamp& picked(double uniform) const;
};

/// The quads that emit, picked with probability proportional to their flux, then uniformly by area.
class EmitterSet {
  public:
    explicit EmitterSet(const Scene& scene);
    bool empty() const { return emitters_.empty(); }
    /// Index of a quad; `uniform` in [0,1) is stretched to a fresh uniform number for reuse.
    int picked(double& uniform) const;
    /// Density per area of picking a point on this quad [1/m2], 0 if it does not emit.
    double density(int quad) const { return density_[static_cast<std::size_t>(quad)]; }

  private:
    struct Emitter {
        int quad;
        double pick;
    };
    std::vector<Emitter> emitters_;
    std::vector<double> density_;
};

/// Luminance that leaves this side of a quad of this material by emission [cd/m2].
Rgb emitted_from(const Material& material, bool front);
/// Mean albedo of this side; a side that does not reflect is black. A quadrature on glossy sides.
Rgb albedo_of(const Material& material, bool front);

/// Cosine at a surface point over the squared distance to a lamp [1/m2]; 0 if it faces away.
double lamp_factor(const SurfacePoint& at, const Vec3& lamp);

}  // namespace lightwell
