#pragma once

#include <cstddef>
#include <vector>

#include "solver/transport/direct_transport.h"

namespace lightwell {

/// Leaves coefficients of M out: those with |value| * max(weight of row, weight of column) below a
/// threshold, but never those between the scaling functions of two whole elements, which carry the
/// mean exchange and with it the energy. On closed elements uniform light becomes uniform light,
/// whatever is dropped; on the others, what it became before.
///
/// A ripple that coarse links and truncation leave in uniform light is fed back by every bounce and
/// costs energy in its square, which high albedo amplifies. What a row lacks is given to the
/// coefficients that it kept, by their squares, so that large ones bear most and change least.
class BounceTruncation {
  public:
    /// The space must outlive the object.
    ///
    /// @param closed        by element: whether nothing escapes from it, so that its form factors
    ///                      sum to one everywhere
    /// @param coefficients  all of them, as direct_transport orders them
    /// @param weight        by basis function (see LightEnsemble::total)
    BounceTruncation(const RadianceSpace& space, const std::vector<bool>& closed,
                     std::vector<Coefficient> coefficients, Eigen::ArrayXd weight);

    /// Takes other weights, and how much it matters what arrives in a function, in [0,1] by basis
    /// function (see Reflection::visibility): a coefficient then counts as |value| * max(visibility
    /// of row * weight of column, weight of row * visibility of column).
    void weigh(Eigen::ArrayXd weight, Eigen::ArrayXd visibility);
    /// The threshold that leaves out a root of the sum of squares of `budget` (see
    /// threshold_for_budget).
    double threshold_for(double budget) const;
    /// Forgets what a threshold leaves out, for the sake of memory and time; only higher ones may
    /// be asked for afterwards.
    void forget_below(double threshold);
    /// The operator that a threshold leaves.
    SymmetricOperator at(double threshold) const;

  private:
    /// Sets column_start_ and of_uniform_.
    void find_places();
    double magnitude(const Coefficient& c) const;
    bool is_kept(const Coefficient& c, double threshold) const;
    bool joins_means(const Coefficient& c) const;
    /// Adds what a coefficient makes of uniform light.
    void respond(const Coefficient& c, Eigen::ArrayXd& response) const;

    const RadianceSpace& space_;
    std::vector<Coefficient> coefficients_;
    std::vector<std::size_t> column_start_;  ///< into coefficients_, by column, and the end of all
    std::vector<std::size_t> of_uniform_;  ///< coefficients that uniform light makes a response of
    Eigen::ArrayXd weight_;
    Eigen::ArrayXd visibility_;  ///< empty: all alike
    Eigen::ArrayXd uniform_;     ///< uniform light: sqrt(area) on the scaling functions of elements
    Eigen::ArrayXd wanted_;      ///< what it is to become
};

}  // namespace lightwell
