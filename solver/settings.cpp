#include "solver/settings.h"

#include <algorithm>
#include <cmath>

#include "solver/transport/geometric_oracle.h"
#include "solver/transport/variation_oracle.h"

namespace lightwell {

namespace {

/// The part of the error that truncation may make.
constexpr double truncation_share = 0.6;

}  // namespace

double error_guessed_for(const Provenance& provenance) {
    return provenance.truncation / truncation_share;
}

Settings settings_for(const PrecomputeOptions& options, double distance, std::size_t elements) {
    Settings settings;
    // In rooms half again as wide do as well for most lamps, at half the time, but not for those
    // close to a wall, whose bright spot they blur: with cells 1.4 times as wide and 0.75 times the
    // truncation, row F1 of the stability table fails at 3 %, and voxel houses asked for 5 % came
    // to 8.8 % without a word, with these cells to 5.0 %.
    settings.cell_size =
        options.cell_size.value_or(0.09 * distance * std::pow(options.error / 0.05, 0.35));
    const double crowding =
        std::sqrt(16.0 / static_cast<double>(std::max<std::size_t>(elements, 16)));
    const double tolerance = options.oracle == OracleKind::geometric
                                 ? 4e-5 * std::pow(options.error / 0.05, 1.75) * crowding
                                 : options.error;
    settings.oracle_tolerance = options.oracle_tolerance.value_or(tolerance);
    settings.truncation = options.truncation.value_or(truncation_share * options.error);
    return settings;
}

void tighten(const PrecomputeOptions& options, double missed, Settings& settings) {
    // Rooms and an office at 5 and 2 % split their squared error like this: links a half, falling
    // with the tolerance; truncation a tenth to a quarter; and a rest in contacts narrower than a
    // cell. A tighter tolerance hardly adds coefficients, since those that it adds are small.
    constexpr double most_at_once = 0.2;
    const double factor = std::clamp(0.9 / missed, 0.6, 0.9);
    if (!options.oracle_tolerance)
        settings.oracle_tolerance *= std::max(std::pow(factor, 4), most_at_once);
    if (!options.truncation) settings.truncation *= factor;
}

void tighten_cells(const PrecomputeOptions& options, double missed, Settings& settings) {
    // In rooms with few things the rest is the larger part: five of ten rooms furnished at random
    // lost a tenth to a third of their error with cells 0.7 times as wide, the others next to
    // nothing.
    if (options.cell_size) return;
    const double factor = std::clamp(0.9 / missed, 0.5, 0.7);
    settings.cell_size *= factor;
    settings.gap_cell_size *= factor;
}

std::unique_ptr<Oracle> make_oracle(const PrecomputeOptions& options, const Settings& settings,
                                    const std::vector<Quad>& quads, const Visibility& visibility,
                                    double area) {
    if (options.oracle == OracleKind::variation) {
        VariationOracleOptions variation;
        variation.sender_threshold = settings.oracle_tolerance;
        variation.receiver_threshold = settings.oracle_tolerance;
        return std::make_unique<VariationOracle>(variation, visibility);
    }
    GeometricOracleOptions geometric;
    geometric.tolerance = settings.oracle_tolerance;
    geometric.partial_tolerance = GeometricOracleOptions().partial_tolerance /
                                  GeometricOracleOptions().tolerance * settings.oracle_tolerance;
    return std::make_unique<GeometricOracle>(geometric, quads, visibility, area);
}

}  // namespace lightwell
