#pragma once

#include "radiance4d/scene/visibility.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// Thresholds of the paper's oracle.
struct VariationOracleOptions {
    /// Refine the sender while (max K - min K) A_s exceeds this; K = F V. Dimensionless, >= 0.
    double sender_threshold = 0.02;
    /// Refine the receiver while (max K - min K) A_r exceeds this. Dimensionless, >= 0.
    double receiver_threshold = 0.02;
    /// Quasi-random kernel samples per link, rounded up to a multiple of its strata. >= 1.
    int samples = 32;
};

/// The oracle of WRT section 4.3.2, kept as the baseline that everything is compared with: it
/// samples the kernel with visibility, drops a link of which no sample is visible, refines by the
/// spread of the samples, and where it stops makes the coefficients of the samples themselves. It
/// can miss what no sample meets, and every sample costs a ray.
class VariationOracle : public Oracle {
  public:
    /// The reference must outlive the oracle.
    VariationOracle(const VariationOracleOptions& options, const Visibility& visibility);

    Verdict judge(const LinkGeometry& link, std::vector<int>& occluders, LinkStrata& strata,
                  OracleCost& cost) const override;
    bool needs_occluders() const override { return false; }

  private:
    VariationOracleOptions options_;
    const Visibility& visibility_;
};

}  // namespace lightwell
