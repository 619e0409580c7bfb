#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "solver/earlier_work.h"
#include "solver/ground.h"
#include "solver/precompute.h"
#include "solver/reference/error_estimate.h"
#include "solver/reference/lamp_draw.h"
#include "solver/settings.h"
#include "solver/stage_clock.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// How an operator is computed: diffuse_operator or glossy_operator.
using OperatorOf = GlobalTransport (*)(const Ground&, const PrecomputeOptions&, const Settings&,
                                       const Progress&, EarlierWork&, OracleCost&, StageClock&,
                                       PrecomputeReport&);

/// Operators of one scene, each tighter than the last, and the verdict on the last. All references
/// must outlive the object.
class Attempts {
  public:
    /// @param cost, clock, report  receive what the operators and the verdicts cost
    Attempts(OperatorOf operator_of, const Ground& ground, const PrecomputeOptions& options,
             const Progress& progress, OracleCost& cost, StageClock& clock,
             PrecomputeReport& report)
        : operator_of_(operator_of),
          ground_(ground),
          options_(options),
          progress_(progress),
          cost_(cost),
          clock_(clock),
          report_(report),
          lamps_(ground.scene, ground.visibility, 1) {}

    /// Builds one, judges it if any are judged, and says by how much it missed its error: how many
    /// times it is as wrong as it may be; 0 where none is judged.
    ///
    /// @param told  of how it is built
    /// @throws InputError   as the operator does
    /// @throws Interrupted  if the progress says so; the last one stays, unjudged if it is new
    double build_and_judge(const Settings& settings, const Progress& told);

    /// Null before the first one is built.
    const GlobalTransport* last() const { return last_ ? &*last_ : nullptr; }
    GlobalTransport take() { return std::move(*last_); }

  private:
    void judge_up_to(std::size_t lights);
    void estimate_from(std::size_t first);
    void note(const Settings& settings);

    OperatorOf operator_of_;
    const Ground& ground_;
    const PrecomputeOptions& options_;
    const Progress& progress_;
    OracleCost& cost_;
    StageClock& clock_;
    PrecomputeReport& report_;
    EarlierWork earlier_;
    std::optional<GlobalTransport> last_;
    LampDraw lamps_;
    std::vector<JudgedLight> judged_;
    ErrorEstimate estimate_;
};

}  // namespace lightwell
