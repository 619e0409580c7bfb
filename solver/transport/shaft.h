#pragma once

#include "radiance4d/scene/convex_region.h"
#include "solver/transport/facet.h"

namespace lightwell {

/// The shaft between two facets: the convex hull of both, which every ray between them stays in
/// (Haines and Wallace 1991). Facets lie in front of each other.
class Shaft {
  public:
    Shaft(const Facet& x, const Facet& y);

    /// Whether a quad may block some ray between the facets. False is certain; true is a suspicion.
    bool may_be_cut_by(const Quad& quad) const;
    /// Whether a quad blocks every ray between the facets. True is certain.
    bool is_covered_by(const Quad& quad) const;
    /// The shaft as a region to look for quads in.
    const ConvexRegion& region() const { return region_; }

  private:
    Facet x_;
    Facet y_;
    ConvexRegion region_;
    double tolerance_ = 0;  ///< distances below this count as zero [m]
};

}  // namespace lightwell
