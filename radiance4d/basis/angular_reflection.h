#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "radiance4d/basis/haar.h"
#include "radiance4d/scene/material.h"

namespace lightwell {

/// How well a lobe is to be represented.
struct AngularResolution {
    /// Largest relative error of the reflected light of a point source, root mean square over where
    /// it stands and where one looks; in (0,1).
    double tolerance = 0.4;
    /// Levels of the angular square at most, 1 to 5: 4^5 cells, of about 2 degrees at the normal.
    int most_levels = 5;
    /// Levels at least, for any lobe; at most `most_levels`. Without directions a lobe would look
    /// diffuse to the eye, however little that changes the light of others.
    int least_levels = 0;
};

/// The angular square [0,1]^2 of directions, cut in four `levels` times; its cells are measured by
/// their share of the square, so that a direction's cosine is in the measure.
HaarBasis angular_basis(int levels);

/// The representations of a lobe (see AngularReflection) at all angular levels, each computed when
/// it is first asked for, and kept. Copies share what there is; several threads may ask.
class LobeLevels {
  public:
    explicit LobeLevels(const Lobe& lobe);

    const Lobe& lobe() const;
    /// @param level  0 to 5
    const RowMatrix& matrix(int level) const;
    /// Relative error, as in AngularResolution; 0 without a lobe.
    double error(int level) const;

  private:
    struct Level;
    struct Kept;
    const Level& at(int level) const;

    std::shared_ptr<Kept> kept_;
};

/// The lobes of a scene, by number of the material.
using SceneLobes = std::vector<LobeLevels>;

/// None of them computed yet.
SceneLobes lobes_of(const std::vector<Material>& materials);

/// How the lobe of a material reflects, in Haar functions over (s,t) x (s',t'): incident radiance
/// becomes radiance that leaves,
///     L_o(s,t) = Int pi f(s,t; s',t') L(s',t') ds' dt',
/// with the cosine in ds' dt' (see direction_map.h). For a lobe of reflectance 1; the operator of a
/// material is reflectance * matrix() plus the diffuse part, which touches the mean alone.
///
/// Computed once per material and level (see LobeLevels): the kernel pi f is integrated adaptively
/// over pairs of cells, deeper where it varies, down to half of the finest cells, and scaled so
/// that uniform light is reflected by the lobe's albedo in every cell. The level is the coarsest
/// that meets the tolerance (WRT section 4.3.2: the resolution of the BRDF's wavelets decides the
/// angular refinement).
class AngularReflection {
  public:
    /// No lobe: one angular cell, which reflects nothing.
    AngularReflection() = default;
    explicit AngularReflection(const Lobe& lobe, const AngularResolution& resolution = {});
    explicit AngularReflection(const LobeLevels& lobe, const AngularResolution& resolution = {});
    /// The same at a given level, 0 to 5, whatever its error.
    static AngularReflection at_level(const Lobe& lobe, int level);
    static AngularReflection at_level(const LobeLevels& lobe, int level);

    /// Angular levels that the material needs; 0 without a lobe.
    int level() const { return level_; }
    /// Relative error, as in AngularResolution, at each level that was tried, up to level().
    const std::vector<double>& error_by_level() const { return error_by_level_; }
    /// Relative error at level(). Larger than the tolerance where no level follows the lobe.
    double error() const { return error_by_level_.back(); }
    /// Whether the representation meets the tolerance.
    bool follows() const { return follows_; }
    /// The operator, functions x functions at level(): symmetric (Helmholtz), norm at most 1, the
    /// first entry the mean albedo of the lobe.
    const RowMatrix& matrix() const { return lobe_.matrix(level_); }

  private:
    AngularReflection(LobeLevels lobe, int first, int last, double tolerance);

    LobeLevels lobe_{NoLobe{}};
    int level_ = 0;
    bool follows_ = true;
    std::vector<double> error_by_level_ = {0};
};

}  // namespace lightwell
