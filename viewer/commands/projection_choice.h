#pragma once

#include <memory>
#include <string>

#include "runtime/drawing/gl_functions.h"
#include "runtime/projection/light_projection.h"
#include "viewer/commands/opened_operator.h"

namespace lightwell {

/// How lamps are projected on the basis: by their shadows and rays, by occlusion queries, or by
/// what is faster on this machine.
enum class ProjectionWay { fastest, rays, queries };

/// "fastest", "rays" or "queries".
/// @throws InputError for anything else
ProjectionWay projection_argument(const std::string& option, const std::string& text);

/// A projection, and which of the two it is.
struct ChosenProjection {
    std::unique_ptr<LightProjection> projection;
    ProjectionWay way;  ///< never ProjectionWay::fastest
};

/// The fastest is found by projecting the scene's own lamps both ways, here and now.
/// @param loader  of the context that is current, here and whenever light is projected
ChosenProjection chosen_projection(const OpenedOperator& opened, const GlLoader& loader,
                                   ProjectionWay way);

}  // namespace lightwell
