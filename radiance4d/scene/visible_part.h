#pragma once

#include <vector>

#include "radiance4d/scene/shadow.h"

namespace lightwell {

/// The part of a convex polygon that is seen from x past some quads, as convex pieces that do not
/// overlap. Exact up to rounding: pieces narrower than 1e-12 of the target's extent vanish.
///
/// Either side of the target is looked at; from its own plane nothing is seen. `candidates` are
/// indices into `quads`: leave out the quad that x lies on and the one that the target is part of.
/// A quad whose plane holds x, or that touches the target from inside its plane (up to 1e-6 of the
/// target's extent, so that a lamp drawn flush into a ceiling shines), hides nothing.
std::vector<ConvexPolygon> visible_part(const Vec3& x, const ConvexPolygon& target,
                                        const std::vector<Quad>& quads,
                                        const std::vector<int>& candidates);

/// As above, with shadows that all have the apex x: worth making once when one point looks at many
/// targets.
std::vector<ConvexPolygon> visible_part(const Vec3& x, const ConvexPolygon& target,
                                        std::vector<Shadow> shadows);

/// Whether one shadow leaves nothing of the target: what visible_part would say, sooner. False may
/// be wrong only by rounding.
bool hides_all(const Shadow& shadow, const ConvexPolygon& target);

/// Whether a quad reaches into the pyramid from x to the target. Conservative: false means that it
/// hides nothing of the target. For many quads make the region once (region_between).
bool may_occlude(const Vec3& x, const ConvexPolygon& target, const Quad& quad);

}  // namespace lightwell
