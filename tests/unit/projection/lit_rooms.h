#pragma once

#include <string>
#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/light.h"
#include "radiance4d/scene/occluder_tree.h"
#include "runtime/projection/light_projection.h"
#include "runtime/propagation/packed_field.h"

namespace lightwell::testing {

/// Quads to project light on, their fronts as elements.
struct LitRoom {
    std::vector<Quad> quads;
    RadianceSpace space;
    OccluderTree occluders;

    /// E by the exact projector.
    RadianceField truth(const std::vector<Light>& lights) const;
    /// Flux on an element [lm], red.
    double flux(std::size_t element, const RadianceField& field) const;
    double total_flux(const RadianceField& field) const;
    /// A darkness of the right size.
    PackedField darkness() const;
};

/// @param cell  largest side of a finest cell [m]
LitRoom lit_room(const std::vector<Quad>& quads, double cell);

/// The closed room of 3 x 4 x 2.5 m with a tall and a low block; see room_with_blocks.
LitRoom closed_room(double cell = 0.2);

/// Points in the free air of the closed room: some anywhere, then one a millimetre off each wall.
std::vector<Vec3> places_in_closed_room(int anywhere);

PointLight lamp(const Vec3& position);
SpotLight spot(const Vec3& position, const Vec3& direction, double inner, double outer);

/// Checks flux on every element that receives more than a share `least` of the light, to within
/// `relative` of it, on others to within twice that of `least`, and the flux on all, to within
/// `of_total`.
void expect_same_flux(const LitRoom& room, const RadianceField& field, const RadianceField& truth,
                      double relative, double of_total, const std::string& name,
                      double least = 1e-4);

/// How the error of E jumps about while a lamp moves: of (E - E_exact) / E on any element that
/// receives more than 1e-3 of all.
struct Flicker {
    double second_difference = 0;  ///< root mean square over the frames
    double largest_step = 0;       ///< between two frames
};

/// Across the closed room, a centimetre a frame.
Flicker flicker_of(const LitRoom& room, LightProjection& projection, int frames);

}  // namespace lightwell::testing
