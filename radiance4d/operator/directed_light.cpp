#include "radiance4d/operator/directed_light.h"

#include <array>
#include <cmath>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/angular_shares.h"
#include "radiance4d/basis/direction_map.h"

namespace lightwell {

namespace {

/// Points along either side of a cell at which its direction to the source is looked at.
constexpr int points = 4;

/// How the light on a finest spatial cell is divided among the finest angular cells; the shares sum
/// to one, or to nothing where the source is behind.
Eigen::VectorXd shares_of_directions(const Element& element, const Eigen::Matrix3d& frame,
                                     std::uint32_t cell, const Vec3& from) {
    const CellTree& tree = element.space.tree();
    const ParameterRect r = tree.rect({tree.levels(), cell});
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(element.angle.functions());
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) {
            const Vec3 at = element.geometry.point(r.u0 + (i + 0.5) / points * (r.u1 - r.u0),
                                                   r.v0 + (j + 0.5) / points * (r.v1 - r.v0));
            const Vec3 local = frame.transpose() * (from - at);
            const double distance = local.norm();
            if (!(local[2] > 0)) continue;
            const double seen = local[2] / (distance * distance * distance);
            for (const AngularShare& one :
                 angular_shares(element.angle, element.angle.levels(), local))
                shares[one.cell] += seen * one.share;
        }
    const double sum = shares.sum();
    return sum > 0 ? Eigen::VectorXd(shares / sum) : shares;
}

}  // namespace

void add_directed_light(const Element& element, const Vec3& from, const RadianceField& irradiance,
                        RadianceField& field) {
    const CellTree& tree = element.space.tree();
    const auto cells = static_cast<Eigen::Index>(tree.functions());
    const auto angles = static_cast<Eigen::Index>(element.angle.functions());
    const Eigen::Matrix3d frame = local_frame(element.geometry);
    const HaarBasis angular = angular_basis(element.angle.levels());
    // The coefficient of cell X and angular cell A is the share in A of sqrt(|X|) E / pi, over
    // sqrt(|A|); A is one of `angles` equal ones.
    RowMatrix share(angles, cells);
    for (Eigen::Index m = 0; m < cells; ++m)
        share.col(m) =
            std::sqrt(static_cast<double>(angles) *
                      element.space.area({tree.levels(), static_cast<std::uint32_t>(m)})) /
            M_PI * shares_of_directions(element, frame, static_cast<std::uint32_t>(m), from);
    angular.analyse(share, element.angle.levels());
    RowMatrix by_cell;
    for (int c = 0; c < 3; ++c) {
        const bool as_before =
            c > 0 && (irradiance.col(c) == irradiance.col(c - 1)).all();  // of white light
        if (!as_before) {
            by_cell = (share * irradiance.col(c).matrix().asDiagonal()).transpose();
            element.space.analyse(by_cell, tree.levels());
        }
        Eigen::Map<RowMatrix>(field.col(c).data() + element.first, cells, angles) += by_cell;
    }
}

RadianceField without_directions(const RadianceSpace& space, RadianceField field) {
    for (const Element& element : space.elements()) {
        const std::uint32_t angles = element.angle.functions();
        for (std::uint32_t f = 0; f < element.functions(); ++f)
            if (f % angles != 0) field.row(element.first + f).setZero();
    }
    return field;
}

}  // namespace lightwell
