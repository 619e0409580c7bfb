#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/reference/confidence.h"
#include "solver/reference/path_tracer.h"

namespace lightwell {

/// Shares of the surface, in per cent, whose errors are stated.
constexpr std::array<double, 4> error_percentiles = {50, 90, 95, 99};

/// Flux of the lamps that errors in lux are stated for [lm].
constexpr double verified_flux = 1000;
/// Turns the light of an isotropic lamp of 1 cd into that of such a lamp.
constexpr double lux_of_unit_lamp = verified_flux / (4 * 3.14159265358979323846);

/// How wrong a kind of irradiance is: over the surface, by area and by how well it can be seen, and
/// over lamps anywhere in the rooms, each counting alike.
struct ErrorSize {
    /// Root mean square over the lamps of sqrt(Int d^2 / Int E^2), over the surface and channels.
    Interval relative_l2;
    /// Mean over the lamps of Int d / Int E.
    Interval bias;
    /// Of |d| / E of luminance, by error_percentiles. A place darker than a hundredth of its lamp's
    /// rms counts as that bright. The spread that the judge's noise adds is scaled away.
    std::array<double, 4> relative{};
    /// Of |d| of luminance [lx], for a white lamp of verified_flux, by error_percentiles.
    std::array<double, 4> lux{};
};

/// Irradiance at surface points as it is shown, and how much each of them counts.
struct ShownPoints {
    std::vector<Rgb> value;  ///< [lx]
    std::vector<double> weight;
};

/// What the errors of one lamp's irradiance are relative to: means over the surface of E^2 [lx2]
/// and E [lx], channels added. 0 where nothing is known to be lit.
struct LightMeasure {
    double square = 0;
    double mean = 0;
};

/// Judged at few places and shown at many: what is shown at the many, scaled by what the judge
/// finds at the few over what is shown there. Where these agree, the few places do not add
/// uncertainty.
LightMeasure measure_of(const std::vector<LightEstimate>& judged, const ShownPoints& few,
                        const ShownPoints& many);

/// Sizes of errors that were seen through noise. The noise spreads them; they are scaled back to
/// the root mean square that they have without it.
class NoisySizes {
  public:
    void add(double error, double noise, double weight);
    double quantile(double share) const;

  private:
    std::vector<WeighedValue> seen_;
    double square_ = 0, seen_square_ = 0;
};

/// Gathers the errors of one kind of irradiance as one way shows it, lamp by lamp.
class ErrorCollection {
  public:
    /// Irradiance at the places of one more lamp of 1 cd.
    /// @param lamp_weight  how much the lamp counts among the others
    void add(const std::vector<LightEstimate>& judged, const ShownPoints& shown,
             const LightMeasure& measure, double lamp_weight);
    /// What there is to say about the lamps so far, at least two.
    ErrorSize size() const;
    /// By lamp: square of the relative L2 error, without bias.
    const std::vector<WeighedValue>& squares() const { return squares_; }

  private:
    std::vector<WeighedValue> squares_, biases_;  // by lamp
    NoisySizes relative_, lux_;
};

}  // namespace lightwell
