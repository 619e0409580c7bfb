#include "solver/transport/facet.h"

namespace lightwell {

Facet Facet::of(const Quad& quad, const Vec3& normal) {
    return {ConvexPolygon(quad), normal};
}

Facet Facet::in_front_of(const Vec3& n, double d, double tolerance) const {
    return {clipped(*this, {n, d}, tolerance), normal};
}

}  // namespace lightwell
