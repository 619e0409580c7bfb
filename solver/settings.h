#pragma once

#include <limits>
#include <memory>

#include "radiance4d/scene/visibility.h"
#include "solver/precompute.h"
#include "solver/transport/oracle.h"

namespace lightwell {

/// What follows from the error asked for, where it is not set by hand.
struct Settings {
    double cell_size = 0;          ///< largest side of a finest cell [m]
    double oracle_tolerance = 0;   ///< see the oracles
    double truncation = 0;         ///< relative error of indirect light from left-out coefficients
    double angular_tolerance = 0;  ///< see AngularResolution; of glossy materials
    /// As cell_size, in gaps (see set_gap_cells).
    double gap_cell_size = std::numeric_limits<double>::infinity();

    bool operator==(const Settings& other) const {
        return cell_size == other.cell_size && oracle_tolerance == other.oracle_tolerance &&
               truncation == other.truncation && angular_tolerance == other.angular_tolerance &&
               gap_cell_size == other.gap_cell_size;
    }
};

/// First guesses, from measurements on the sample scenes.
///
/// @param distance  that light typically travels [m] (see typical_distance)
/// @param elements  sides that take part: the more there are, the smaller the part of the scene
///                  that one light reaches, and the less a link may be wrong by
Settings settings_for(const PrecomputeOptions& options, double distance, std::size_t elements);

/// The error that settings are first guesses for, by the truncation that belongs to it.
double error_guessed_for(const Provenance& provenance);

/// Tightens what is not set by hand, cells excepted, after an operator came out `missed` times as
/// wrong as asked.
void tighten(const PrecomputeOptions& options, double missed, Settings& settings);

/// Makes cells finer instead, unless their size is set by hand.
void tighten_cells(const PrecomputeOptions& options, double missed, Settings& settings);

/// The oracle that the options name. The references must outlive it.
///
/// @param area  of all elements [m2]
std::unique_ptr<Oracle> make_oracle(const PrecomputeOptions& options, const Settings& settings,
                                    const std::vector<Quad>& quads, const Visibility& visibility,
                                    double area);

}  // namespace lightwell
