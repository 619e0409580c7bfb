#pragma once

#include <vector>

#include <Eigen/Geometry>

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
    /// Axis-aligned bounds of the shaft.
    const Eigen::AlignedBox3d& box() const { return box_; }
    /// Planes with the shaft on their negative side, n.x <= d.
    struct Plane {
        Vec3 n;
        double d;
    };
    const std::vector<Plane>& planes() const { return planes_; }
    /// Distances below this count as zero [m].
    double tolerance() const { return tolerance_; }

  private:
    Facet x_;
    Facet y_;
    Eigen::AlignedBox3d box_;
    std::vector<Plane> planes_;
    double tolerance_ = 0;
};

}  // namespace lightwell
