#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/operator/reflection.h"
#include "radiance4d/progress.h"
#include "solver/series/neumann_series.h"

namespace lightwell {

/// Eight lights side by side, on those basis functions that any of them reaches. A point light
/// reaches few functions of fine directions: 6 % of them in scenes/glossy at 5 %.
struct DirectedLights {
    Reflection::Functions functions;
    Reflection::Fields values;  ///< a row for each of the functions

    /// Where none is left is filled up with zeros.
    ///
    /// @param fields  of one channel, over all functions; 1 to 8
    static DirectedLights of(const std::vector<Eigen::ArrayXd>& fields);
};

/// Solves X = P R (E + X) for lights side by side, on those functions alone that P has coefficients
/// at: X is zero elsewhere, which is where most functions of fine directions are (two thirds of
/// them in scenes/glossy at 5 %). In single precision, since it serves to measure errors.
class DirectedSolver {
  public:
    using Fields = Reflection::Fields;

    /// Keeps a reference to the reflection.
    ///
    /// @param propagation  P; other ones may be solved with that have no coefficients elsewhere
    /// @param shares       of the channels in the light's one (see Reflection::reflect)
    DirectedSolver(const SymmetricOperator& propagation, const Reflection& reflection, Rgb shares);

    /// Where light may arrive: what the rows of fields stand for.
    const Reflection::Functions& functions() const { return functions_; }

    /// R E.
    std::vector<Fields> reflected(const std::vector<DirectedLights>& direct) const;
    /// X, by plain iteration to a relative `tolerance`. Blocks run in parallel.
    ///
    /// @param reflected  R E
    /// @throws Interrupted if the progress says so
    std::vector<Fields> solved(const SymmetricOperator& propagation,
                               const std::vector<Fields>& reflected, double tolerance,
                               const Progress& progress) const;
    /// H E without the coefficients that the rule drops; H has no rows elsewhere.
    std::vector<Fields> truncated_indirect(const Eigen::SparseMatrix<double>& global,
                                           const TruncationRule& rule,
                                           const std::vector<DirectedLights>& direct) const;

  private:
    /// P between the functions, by their places.
    SymmetricOperator restricted(const SymmetricOperator& propagation) const;

    const Reflection& reflection_;
    Rgb shares_;
    Reflection::Functions functions_;
    std::vector<std::uint32_t> place_;  ///< of each basis function among functions_
};

}  // namespace lightwell
