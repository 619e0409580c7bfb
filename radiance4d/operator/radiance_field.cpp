#include "radiance4d/operator/radiance_field.h"

#include <cmath>

#include "radiance4d/failure.h"

namespace lightwell {

RadianceField cell_irradiance(const RadianceSpace& space, std::size_t element,
                              const RadianceField& field) {
    const Element& e = space.element(element);
    const CellTree& tree = e.space.tree();
    // The angular mean is the first angular function of each spatial one.
    const std::uint32_t angles = e.angle.functions();
    RowMatrix rows(tree.functions(), 3);
    for (std::uint32_t k = 0; k < tree.functions(); ++k)
        rows.row(k) = field.row(e.first + k * angles).matrix();
    e.space.synthesise(rows, tree.levels());
    for (std::uint32_t m = 0; m < tree.functions(); ++m)
        rows.row(m) *= M_PI / std::sqrt(e.space.area({tree.levels(), m}));
    return rows.array();
}

void set_cell_irradiance(const RadianceSpace& space, std::size_t element,
                         const RadianceField& irradiance, RadianceField& field) {
    const Element& e = space.element(element);
    LIGHTWELL_CHECK_OP(e.angle.functions(), ==, 1U);
    const CellTree& tree = e.space.tree();
    RowMatrix rows = irradiance.matrix();
    for (std::uint32_t m = 0; m < tree.functions(); ++m)
        rows.row(m) *= std::sqrt(e.space.area({tree.levels(), m})) / M_PI;
    e.space.analyse(rows, tree.levels());
    field.middleRows(e.first, tree.functions()) = rows.array();
}

Rgb total_flux(const RadianceSpace& space, const RadianceField& field) {
    // Only the scaling function of a whole element has a mean: Int E dA = pi * sqrt(A) *
    // coefficient.
    Rgb flux = Rgb::Zero();
    for (const Element& element : space.elements())
        flux += M_PI * std::sqrt(element.area()) * field.row(element.first).transpose();
    return flux;
}

}  // namespace lightwell
