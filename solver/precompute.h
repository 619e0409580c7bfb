#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "radiance4d/failure.h"
#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "solver/reference/confidence.h"
#include "solver/transport/closure.h"

namespace lightwell {

enum class OracleKind { geometric, variation };

/// What a user may ask of the precomputation. `error` decides everything that is not set by hand.
struct PrecomputeOptions {
    /// Target relative rms error of indirect illuminance as a picture shows it, in (0, 0.5].
    double error = 0.05;
    OracleKind oracle = OracleKind::geometric;
    /// Largest side of a finest cell [m]; > 0.
    std::optional<double> cell_size;
    /// GeometricOracleOptions::tolerance or both thresholds of VariationOracleOptions; >= 0.
    std::optional<double> oracle_tolerance;
    /// Relative error that left-out coefficients may make; >= 0, 0 keeps everything.
    std::optional<double> truncation;
    /// Memory that the computation may take [bytes].
    std::uint64_t max_memory = std::uint64_t{8} << 30;
    /// Operators that may be built; 0 builds one and does not judge it.
    int most_attempts = 5;
    /// Whether a coarse operator is built first where the work is long: whoever interrupts it then
    /// has something.
    bool preview = false;
    /// How an earlier operator of the scene came to be: where it missed its error, this one starts
    /// tighter.
    std::optional<Provenance> earlier;
    /// Lobes of the scene, by material, as far as they are computed already; empty: none is.
    SceneLobes lobes;
    /// Whether glossy materials are computed as diffuse ones of equal mean albedo.
    bool diffuse = false;
};

/// What it did and cost.
struct PrecomputeReport {
    std::uint64_t elements = 0;
    std::uint64_t blind_sides = 0;       ///< sides dropped because they see no other side
    std::uint64_t inside_of_solids = 0;  ///< backs dropped because they lie inside solids
    std::uint64_t cells = 0;             ///< finest cells of all elements
    std::uint64_t links_judged = 0;
    std::uint64_t link_rays = 0;  ///< of Provenance::rays, those that judged links
    int attempts = 0;             ///< operators built until one was good enough, without a preview
    bool interrupted = false;  ///< whether the operator is what there was when it was interrupted
    std::int64_t estimate_rays = 0;  ///< traced to judge them, beside those in Provenance::rays
    /// Of the last one, for lights it was not made for (see ErrorEstimate::squares).
    std::vector<WeighedValue> squared_errors;
    std::uint64_t coefficients_before = 0;  ///< of M before truncation
    ClosureReport closure;
    std::map<std::string, double> seconds;  ///< by stage, with "total"
};

/// A scene takes more memory than may be taken.
class MemoryExceeded : public InputError {
  public:
    using InputError::InputError;
};

/// Whether any quad is glossy; materials that nothing is made of do not count.
bool has_gloss(const Scene& scene);

/// The offline pipeline: elements, links, direct transport operator, Neumann series (WRT
/// sections 4.2 to 4.4). The transport's scene holds glossy materials as they are, however they are
/// computed.
///
/// Interrupted by its progress, it returns the last operator that it finished, if there is one.
///
/// @throws MemoryExceeded  if the scene cannot be computed within max_memory: before it starts in
///                         earnest where that can be told, or as soon as there are too many links
/// @throws Interrupted     if the progress says so and there is no operator yet
GlobalTransport precompute(const Scene& scene, const PrecomputeOptions& options,
                           const Progress& progress, PrecomputeReport& report);

}  // namespace lightwell
