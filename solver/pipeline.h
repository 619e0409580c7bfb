#pragma once

#include "solver/attempts.h"
#include "solver/ground.h"
#include "solver/precompute.h"
#include "solver/settings.h"

namespace lightwell {

/// What scenes without gloss and with it differ in.
struct Pipeline {
    OperatorOf operator_of;
    Settings (*first_guess)(const PrecomputeOptions&, const Ground&);
    using Way = void (*)(const Ground&, const PrecomputeOptions&, double missed, Settings&);
    /// What makes an operator better: the first, until it is of little use, then the other.
    Way tighten, tighten_else;
    /// Basis functions at given settings, and the memory [bytes] that they take.
    double (*functions)(const Ground&, const PrecomputeOptions&, const Settings&);
    double (*memory)(const Ground&, double functions, double truncation);
    double (*looseness)(const Ground&);  ///< of truncation
    double worth_preview;                ///< functions from which the work is long
};

Pipeline diffuse_pipeline();
Pipeline glossy_pipeline();

}  // namespace lightwell
