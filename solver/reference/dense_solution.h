#pragma once

#include <vector>

#include <Eigen/Core>

#include "radiance4d/gauss_rule.h"
#include "radiance4d/scene/scene.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/polygon_factor.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// How fine a dense solution is.
struct DenseMesh {
    int cells = 4;            ///< per quad and axis, in parameters
    int receiver_points = 4;  ///< Gauss points per cell and axis
    /// Rays per receiver point, sender cell and axis; 0: no shadows between cells.
    int visibility_points = 2;
    /// Gauss points per cell and axis for light from lamps, which is peaked and has hard shadows,
    /// but costs one ray a point only.
    int lamp_points = 24;
};

/// One cell of one side of a quad.
struct DenseCell {
    QuadSide side;
    Quad shape;  ///< its front is the side's
    double area = 0;
};

/// Radiosity the obvious way: every cell against every cell, exact point-to-polygon factors
/// averaged by Gauss quadrature, visibility by rays, all of it in one matrix that is solved
/// directly. The result is the piecewise-constant Galerkin solution. Cost grows with the square of
/// the number of cells in rays and with its cube in arithmetic: for small scenes.
class DenseSolution {
  public:
    /// Cells are those of `sides`; all other sides are black and dark.
    DenseSolution(const Scene& scene, const Visibility& visibility,
                  const std::vector<QuadSide>& sides, const DenseMesh& mesh = {});

    /// Row by row per side: v outer, u inner, in the parameters of the side's own quad (turned
    /// round for backs, see Quad::reversed).
    const std::vector<DenseCell>& cells() const { return cells_; }
    /// F(i,j): share of the light leaving cell i that arrives at cell j.
    const Eigen::MatrixXd& form_factors() const { return factors_; }
    /// Mean irradiance of each cell straight from lamps [lx].
    std::vector<Rgb> from_lamps(const std::vector<Light>& lights) const;
    /// Mean irradiance of each cell straight from the emitting cells [lx].
    std::vector<Rgb> from_emitters() const;
    /// Mean indirect irradiance of each cell [lx], given the mean direct irradiance.
    std::vector<Rgb> indirect(const std::vector<Rgb>& direct) const;

  private:
    double factor(const DenseCell& to, const DenseCell& from) const;
    double visible_share(const Vec3& point, const DenseCell& to, const DenseCell& from) const;

    const Scene& scene_;
    const Visibility& visibility_;
    int visibility_points_;
    GaussRule rule_;
    int lamp_points_;
    std::vector<DenseCell> cells_;
    Eigen::MatrixXd factors_;
};

}  // namespace lightwell
