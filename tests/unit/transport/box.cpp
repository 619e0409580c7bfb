#include "tests/unit/transport/box.h"

#include "solver/series/bounce_truncation.h"
#include "solver/transport/geometric_oracle.h"
#include "solver/transport/refiner.h"

namespace lightwell::testing {

std::vector<Quad> box_walls(const Vec3& size) {
    const auto at = [&](int x, int y, int z) -> Vec3 { return size.cwiseProduct(Vec3(x, y, z)); };
    return {Quad{{at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}},
            Quad{{at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)}},
            Quad{{at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)}},
            Quad{{at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}},
            Quad{{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}},
            Quad{{at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}}};
}

std::vector<Element> uniform_elements(const std::vector<Quad>& quads, int levels) {
    const CellTree tree(std::vector<Split>(static_cast<std::size_t>(levels), Split::both));
    std::vector<Element> elements;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        Element element;
        element.quad = static_cast<int>(q);
        element.geometry = quads[q];
        element.space = HaarBasis(quads[q], tree);
        elements.push_back(element);
    }
    return elements;
}

std::vector<RadianceField> solve_uniform(const std::vector<Quad>& quads, int levels,
                                         const std::vector<Rgb>& reflectance,
                                         const std::vector<RadianceField>& irradiance) {
    const std::vector<Element> elements = uniform_elements(quads, levels);
    const Visibility visibility(quads);
    GeometricOracleOptions options;
    options.tolerance = 0;
    options.partial_tolerance = 0;
    const RadianceSpace space(elements);
    const GeometricOracle oracle(options, quads, visibility, space.area());
    OracleCost cost;
    const std::vector<PairLinks> pairs =
        refine_links(elements, quads, OccluderTree(quads), oracle, {}, cost);
    const SymmetricOperator bounce =
        BounceTruncation(space, std::vector<bool>(elements.size(), true),
                         direct_transport(space, pairs, {}),
                         Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(space.functions())))
            .at(0);

    RadianceField direct = RadianceField::Zero(space.functions(), 3);
    RadianceField rho = RadianceField::Zero(space.functions(), 3);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        set_cell_irradiance(space, e, irradiance[e], direct);
        rho.middleRows(space.element(e).first, space.element(e).functions()).rowwise() =
            reflectance[e].transpose();
    }
    RadianceField x = direct;
    double change = 1;
    while (change > 1e-12) {
        RadianceField next = direct;
        for (int c = 0; c < 3; ++c)
            bounce.apply((rho.col(c) * x.col(c)).eval(), next.col(c));
        change = ((next - x).matrix().norm()) / next.matrix().norm();
        x = next;
    }
    std::vector<RadianceField> result;
    for (std::size_t e = 0; e < elements.size(); ++e)
        result.push_back(cell_irradiance(space, e, x));
    return result;
}

}  // namespace lightwell::testing
