#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/operator/reflection.h"
#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// How an operator came to be: what was asked for, what was done, what it cost. Goes into the file
/// and into reports.
struct Provenance {
    std::string program;     ///< name and version of the program that computed it
    std::string oracle;      ///< "geometric" or "variation"
    double error_asked = 0;  ///< relative rms error of indirect illuminance, as a picture shows it
    double error_estimated = 0;   ///< as measured after the computation; 0: not measured
    double cell_size = 0;         ///< largest side of a finest cell [m]
    double oracle_tolerance = 0;  ///< see GeometricOracleOptions or VariationOracleOptions
    double truncation = 0;        ///< share of the error that left-out coefficients may make
    std::uint64_t rays = 0;       ///< cast in the whole computation
    std::uint64_t links = 0;      ///< kept by the oracle, unordered pairs
    int bounces = 0;              ///< powers of T that the series holds
    double energy_dropped = 0;    ///< share of the indirect flux that truncation lost
    double error_bound = 0;       ///< upper end of the estimate's 95 % interval; 0: not measured
    std::string error_basis;  ///< how estimate and bound were obtained; empty: not measured, or not
                              ///< recorded
};

/// Everything that measuring and drawing need: the scene, the space, one bounce, and all bounces.
struct GlobalTransport {
    Scene scene;
    RadianceSpace space;
    /// The colourless geometric operator M; one bounce of channel c is T_c = M diag(rho_c), or
    /// P R_c with P = M where surfaces are glossy.
    SymmetricOperator bounce;
    /// R of a space with angular functions; not needed on others.
    Reflection reflection;
    /// H = G - I = T + T^2 + ... for each distinct channel: a scene whose reflectances are grey has
    /// one.
    std::vector<TransportOperator> indirect;
    /// Which of `indirect` the red, green and blue channels use.
    std::array<int, 3> channel = {0, 0, 0};
    Provenance provenance;
};

/// Reflectance of every basis function, one row each; of glossy materials the mean albedo.
RadianceField reflectance_of(const Scene& scene, const RadianceSpace& space);

/// Projection of the light that the emitting quads send out: emitted luminance as a field
/// (half-density) to be propagated by the bounce operator.
RadianceField emission_of(const Scene& scene, const RadianceSpace& space);

/// What the surfaces make of incident light x, per channel: R x, which is rho x without angular
/// functions.
RadianceField reflected(const GlobalTransport& transport, const RadianceField& x);

/// y = M x per channel: one propagation without reflection.
RadianceField propagated(const SymmetricOperator& bounce, const RadianceField& x);

/// X = E + H E: all bounces, by the stored operator.
RadianceField global_light(const GlobalTransport& transport, const RadianceField& direct);

/// Indirect light by the gathered operator in two stages, T (E + H E): one last bounce at the full
/// resolution of M (WRT section 4.4, "gathered GTO").
RadianceField gathered_light(const GlobalTransport& transport, const RadianceField& direct);

/// Indirect light solved to `tolerance` [relative residual] on the stored bounce operator: X = E +
/// T X by correction steps X += (I + H) r with the residual r = E + T X - X, so that what
/// truncation took from H does not matter. Returns T X.
RadianceField solved_light(const GlobalTransport& transport, const RadianceField& direct,
                           double tolerance = 1e-6);

}  // namespace lightwell
