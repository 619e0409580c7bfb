#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/progress.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/error_size.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// What is asked of a verification.
struct VerifyOptions {
    int lights = 40;  ///< lamps, anywhere in the rooms; at least 4
    int points = 64;  ///< surface points a lamp that are judged by path tracing
    /// Surface points a lamp among which these are chosen.
    int candidates = 2000;
    /// Of the judge at a point, relative to the rms over the points. Its variance is taken off.
    double noise = 0.03;
    std::uint64_t seed = 1;  ///< of lamps, points and paths
};

/// A way in which an operator shows indirect light.
struct ShownLight {
    std::string name;
    /// Indirect irradiance [lx] of one lamp at surface points, emitting quads off.
    std::function<std::vector<Rgb>(const PointLight& lamp, const std::vector<SurfacePoint>& points)>
        at;
};

/// A place with its error, judged a second time by fresh paths because it was chosen for its error.
struct WorstPlace {
    SurfacePoint point;
    Vec3 lamp = Vec3::Zero();  ///< [m]
    double shown = 0;          ///< indirect illuminance [lx], for a lamp of verified_flux
    double judged = 0;         ///< the same by the judge
    double noise = 0;          ///< its standard error [lx]
};

/// The verdict on one way to show light.
struct ShownError {
    std::string name;
    ErrorSize indirect;
    ErrorSize total;   ///< with what comes straight from the lamp, which is computed exactly
    WorstPlace worst;  ///< largest |d| [lx] among the places that were judged
    /// By lamp: square of the relative L2 error of indirect irradiance, without bias, and how much
    /// the lamp counts.
    std::vector<WeighedValue> squares;
};

struct Verification {
    std::vector<ShownError> shown;  ///< by way
    int lights = 0;                 ///< lamps judged; those that nothing reflects do not count
    int places = 0;                 ///< of all lamps
    double noise = 0;               ///< of the judge, relative, rms over lamps
    std::int64_t rays = 0;          ///< of the judge
};

/// Judges ways to show light by path tracing, with lamps and paths of its own. Emitting quads are
/// off. The same for the same seed.
///
/// Unbiased: a squared error is the mean product of the residuals of two batches of paths, over all
/// pairs of the batches of a point, which are independent (see deviation_from). Where the first and
/// the last way differ much, more can be wrong: such lamps (see LampDraw) and such points are
/// chosen oftener, and so are bright ones; each counts by the inverse of its chance. What errors
/// are relative to is integrated over all candidates (measure_of).
///
/// @param space  of the operator that is verified
/// @param ways   at least one; the first and the last should be cheap, they are asked for many
/// lamps
/// @throws InputError if there is no room for lamps, or no surface that reflects
/// @throws Interrupted if the progress says so
Verification verify(const Scene& scene, const RadianceSpace& space, const Visibility& visibility,
                    const OccluderTree& occluders, const std::vector<ShownLight>& ways,
                    const VerifyOptions& options, const Progress& progress);

}  // namespace lightwell
