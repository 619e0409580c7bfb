#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/operator/smooth_irradiance.h"
#include "radiance4d/progress.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reference/confidence.h"
#include "solver/reference/path_tracer.h"
#include "solver/reference/surface_points.h"

namespace lightwell {

/// How much is asked of the judge.
struct EstimateOptions {
    int points = 200;  ///< surface points a light
    /// Evenly spread points among which these are chosen, by what an operator shows there.
    int candidates = 2000;
    double noise = 0.03;  ///< of the judge at a point, relative to the rms over the points; its
                          ///< variance is taken off
    std::uint64_t seed = 1;
};

/// The scene with its emitting quads off.
Scene without_emission(Scene scene);

/// The indirect light of one white unit lamp in a scene, by path tracing.
struct JudgedLight {
    PointLight light;
    std::vector<SurfacePoint> points;
    std::vector<double>
        weight;  ///< by point: how much it counts, as a rule how well it can be seen
    std::vector<LightEstimate> truth;  ///< by point
    std::int64_t rays = 0;             ///< traced to know
    double lamp_weight = 1;            ///< how much the lamp counts (see DrawnLamp)
};

/// How well points can be seen, in [0,1]: the cosine-weighted share of the hemisphere over each
/// that is open, or filled by sides that take part in transport. 0 inside a solid or under its
/// foot; small in the gap behind a picture, where a picture of the room shows almost nothing.
std::vector<double> visible_shares(const RadianceSpace& space, const Visibility& visibility,
                                   const std::vector<SurfacePoint>& points);

/// Indirect irradiance at surface points by path tracing to a given noise, whatever the materials.
LightSurvey traced_indirect(const Scene& scene, const Visibility& visibility,
                            const PointLight& lamp, const std::vector<SurfacePoint>& points,
                            const NoiseTarget& target, const PathTracing& how);

/// Judges a scene without emission for one lamp at given points.
/// @param weight  of the points
JudgedLight judged_light(const Scene& dark, const Visibility& visibility, const PointLight& lamp,
                         std::vector<SurfacePoint> points, std::vector<double> weight,
                         const NoiseTarget& target, std::uint64_t seed);

/// What a picture shows at surface points, of an irradiance [lx] by element: 0 on sides that take
/// no part.
std::vector<Rgb> shown_at(const std::vector<SurfacePoint>& points, const RadianceSpace& space,
                          const std::vector<SmoothSurface>& irradiance,
                          const std::vector<Quad>& quads);

/// Judges the scene of an operator for white unit lights at the given positions, one at a time,
/// emitters off. What is said holds for every operator of the scene; this one tells where to look:
/// which points can be seen, and, since in a building a lamp lights a few rooms, which are lit.
std::vector<JudgedLight> judged_lights(const GlobalTransport& transport,
                                       const std::vector<Quad>& quads, const Visibility& visibility,
                                       const OccluderTree& occluders,
                                       const std::vector<Vec3>& positions,
                                       const EstimateOptions& options, const Progress& progress);

/// What hangs on white lamps at some places: of their indirect light, as pictures gather it, what
/// was left out (the square of its difference to what is stored), and what changes within the width
/// of two cells (the square of its finest details), over the square of all. Where there is more of
/// either, more can be wrong: variances of the mean squared error, per lamp, fall to 0.4 to 0.7 of
/// those of lamps drawn evenly (cornell-box, corner, office, two-rooms, Lost Empire).
std::vector<double> lamp_stakes(const GlobalTransport& transport, const std::vector<Quad>& quads,
                                const OccluderTree& occluders, const std::vector<Vec3>& places);

/// The error of an operator for some lights, judged by path tracing.
struct ErrorEstimate {
    /// By light: the mean square over the surface of what a picture shows wrongly of the indirect
    /// illuminance (the gathered operator, reconstructed smoothly), over the mean square of that.
    /// Free of bias, the judge's noise taken off, so one may come out below 0. With its weight.
    std::vector<WeighedValue> squares;
    Rgb stored_flux = Rgb::Zero();  ///< indirect flux [lm] of the first lights, by the operator
    Rgb solved_flux = Rgb::Zero();  ///< the same by solving on the bounce operator

    /// Share of the indirect flux that the stored operator lacks against the solved one.
    double energy_dropped() const;
    /// Root mean square over the lights.
    double rms() const;
    /// The same with the interval of 95 % in which it lies for lamps anywhere (see rms_interval);
    /// the rms alone where there are less than two lights.
    Interval interval() const;
    /// The error that nine lights of ten stay below, from the lights there are.
    double ninth_of_ten() const;
};

/// How errors of these lights were obtained, in words: "path tracing of 8 lamps ...".
std::string basis_of(const std::vector<JudgedLight>& judged);

/// Adds the errors of an operator for the lights from `first` on to an estimate that has those of
/// the lights before. A light that nothing reflects has none.
void add_errors(const GlobalTransport& transport, const std::vector<Quad>& quads,
                const OccluderTree& occluders, const std::vector<JudgedLight>& judged,
                std::size_t first, const Progress& progress, ErrorEstimate& estimate);

/// The error of an operator for each of the lights.
ErrorEstimate estimate_error(const GlobalTransport& transport, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const std::vector<JudgedLight>& judged,
                             const Progress& progress);

}  // namespace lightwell
