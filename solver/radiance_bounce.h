#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/progress.h"
#include "solver/ground.h"
#include "solver/transport/closure.h"
#include "solver/transport/direct_transport.h"
#include "solver/transport/directed_links.h"
#include "solver/transport/directed_refiner.h"
#include "solver/transport/geometric_oracle.h"

namespace lightwell {

/// How finely radiance is carried between surfaces of which some are glossy.
struct RadianceBounceOptions {
    double cell_size = 0.25;  ///< largest side of a finest spatial cell [m]; > 0
    double finer_gloss = 1;   ///< times that the cells of glossy sides are finer; >= 1
    GeometricOracleOptions oracle;
    AngularResolution angle;
    DirectionalOracleOptions directions;
    DirectedRefinerOptions refinement;
};

/// What lobes are represented to for an error of indirect light: the last reflection, towards the
/// eye, is not part of it.
AngularResolution angular_resolution(double error);

/// What a glossy material asks for.
struct AngularNeed {
    std::string material;
    int level = 0;     ///< angular levels that its sides get at first
    double error = 0;  ///< of the lobe there, see AngularReflection
    /// Of all light that the material reflects, in the finest directions that were tried.
    double finest_error = 0;
    /// Whether the finest directions there are can be expected to meet the error of indirect light.
    bool follows = true;
};

/// How far the light that a material reflects may be off, in the finest directions, for an error
/// asked for of indirect light to be met.
double followed_error(double error);

/// The needs of the glossy materials of a scene, known before anything else is computed.
/// @param lobes of the scene; receives the levels that were looked at
/// @param error asked for of indirect light; > 0
std::vector<AngularNeed> angular_needs(const Scene& scene, const SceneLobes& lobes, double error);

/// Basis functions that the sides get, in space and direction.
double directed_functions(const Ground& ground, const RadianceBounceOptions& options);

/// The propagation P before anything is left out.
struct DirectedBounce {
    RadianceSpace space;
    std::vector<bool> closed;               ///< by element: nothing escapes from it
    std::vector<Coefficient> coefficients;  ///< see directed_transport
    std::uint64_t links = 0;                ///< between diffuse sides
    std::uint64_t directed_links = 0;       ///< others
    ClosureReport closure;                  ///< of the former
    double directions_off = 0;              ///< see close_directions
};

/// Elements, links, directed links and their operator: sides of glossy materials get the angular
/// cells that these need, the others none.
DirectedBounce directed_bounce(const Ground& ground, const RadianceBounceOptions& options,
                               const Progress& progress, OracleCost& cost);

/// The propagation P over space and direction, and what it cost.
struct RadianceBounce {
    RadianceSpace space;
    SymmetricOperator propagation;  ///< one bounce is P R, with R the space's Reflection
    std::uint64_t links = 0;        ///< between diffuse sides
    std::uint64_t directed_links = 0;
    std::uint64_t rays = 0;
    double directions_off = 0;  ///< see close_directions
};

/// The operator of directed_bounce, untruncated. Of a scene without gloss it is the bounce of the
/// diffuse pipeline.
RadianceBounce radiance_bounce(const Ground& ground, const RadianceBounceOptions& options,
                               const Progress& progress = {});

}  // namespace lightwell
