#pragma once

#include <Eigen/Core>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// Four points relative to some origin [m], laid out to be worked on together.
struct FourPoints {
    Eigen::Array4f x, y, z;

    FourPoints() = default;
    FourPoints(const Quad& quad, const Vec3& origin);
    /// Points in the order of a quad's vertices.
    Eigen::Vector3f operator[](int k) const { return {x[k], y[k], z[k]}; }
};

/// Of the quad with these corners: the corners of the quarter at one of them, by the bilinear
/// centre and the middles of the sides.
FourPoints quarter(const FourPoints& corners, int number);
/// The centres of the four quarters.
FourPoints quarter_centres(const FourPoints& corners);
/// Mean of the corners.
Eigen::Vector3f centroid(const FourPoints& corners);
/// [m2]
float area(const FourPoints& corners);
/// Square of the longer diagonal [m2].
float squared_size(const FourPoints& corners);

/// The part of a quad on the outer side of a line: its share of the area, and its centroid.
struct OuterPart {
    float share = 0;
    Eigen::Vector3f centroid = Eigen::Vector3f::Zero();
};

/// @param height  of the corners over the line, in any unit; negative outside
OuterPart outer_part(const FourPoints& corners, const Eigen::Array4f& height);

}  // namespace lightwell
