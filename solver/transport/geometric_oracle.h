#pragma once

#include <vector>

#include "radiance4d/scene/visibility.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// How much error the geometric oracle lets a link keep.
struct GeometricOracleOptions {
    /// Largest share that one link may be wrong by, of the rms field over the scene: the standard
    /// deviation of the kernel over the link, times sqrt(A_r A_s), times sqrt(max(A_r,A_s) / scene
    /// area). > 0; 0 refines everything.
    double tolerance = 4e-5;
    /// As `tolerance`, for links of partial visibility, whose kernel may be anything between none
    /// and all of it. Refining these costs rays where the others cost none; on the sample scenes
    /// eight times the tolerance gives the same error for a quarter of the rays.
    double partial_tolerance = 3.2e-4;
    /// Cells closer than this many times the sum of their reaches are refined to the finest level:
    /// samples of the kernel say nothing about it there. >= 1.
    double near_ratio = 1.2;
    /// Rays for a link of partial visibility that is kept, rounded up to a multiple of its strata.
    /// >= 1.
    int rays = 16;
};

/// The default oracle. It first asks geometry who stands between the two cells: nobody (clear), one
/// quad that covers everything (blocked), or it cannot tell (partial). Only partial links that are
/// kept cost rays, and clear ones get the exact exchange area, touching cells included.
///
/// The variation of the kernel is estimated at the 4 x 4 pairs of child centres; an analysis of
/// variance tells which side explains it and is to be refined. The same 16 strata are kept as
/// values when the link is kept, so that nothing sampled is thrown away.
class GeometricOracle : public Oracle {
  public:
    /// The references must outlive the oracle. `scene_area` [m2] is the area of all elements.
    GeometricOracle(const GeometricOracleOptions& options, const std::vector<Quad>& quads,
                    const Visibility& visibility, double scene_area);

    Verdict judge(const LinkGeometry& link, std::vector<int>& occluders, LinkStrata& strata,
                  OracleCost& cost) const override;
    bool needs_occluders() const override { return true; }
    void strike_out(const LinkGeometry& link, std::vector<int>& occluders) const override;
    bool keeps(const KeptVerdict& earlier) const override;

  private:
    /// Rays for a kept link of partial visibility: more for a finest one that matters more than a
    /// link should, but cannot be refined.
    int rays_for(double importance) const;

    GeometricOracleOptions options_;
    const std::vector<Quad>& quads_;
    const Visibility& visibility_;
    double scene_area_;
};

}  // namespace lightwell
