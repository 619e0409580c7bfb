#include "solver/transport/directed_transport.h"

#include <cmath>

#include <gtest/gtest.h>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/basis/angular_shares.h"
#include "radiance4d/basis/direction_map.h"
#include "radiance4d/operator/global_transport.h"
#include "radiance4d/operator/reflection.h"
#include "radiance4d/scene/brdf.h"
#include "solver/series/bounce_truncation.h"
#include "solver/transport/closure.h"
#include "solver/transport/geometric_oracle.h"
#include "solver/transport/refiner.h"
#include "tests/unit/basis/samples.h"
#include "tests/unit/transport/box.h"

namespace lightwell {
namespace {

/// A closed box whose sides have cells in space and in direction, with all links between them.
class DirectedBox : public ::testing::Test {
  protected:
    static constexpr int space_levels = 2, angle_levels = 2, rays = 64;

    void SetUp() override { build(angle_levels); }

    void build(int angles) {
        elements = testing::uniform_elements(quads, space_levels);
        for (Element& element : elements)
            element.angle = angular_basis(angles).tree();
        space = RadianceSpace(elements);
        elements = space.elements();
        GeometricOracleOptions options;
        options.tolerance = 0;
        options.partial_tolerance = 0;
        const GeometricOracle oracle(options, quads, visibility, space.area());
        OracleCost cost;
        pairs = refine_links(elements, quads, OccluderTree(quads), oracle, {}, cost);
        directions =
            directed_links(elements, pairs, visibility, DirectedLinkOptions{rays}, {}, cost);
        EXPECT_EQ(cost.rays, angles == 0 ? 0 : std::uint64_t{rays} * space.functions());
    }

    SymmetricOperator propagation() {
        close_directions(elements, closed, directions);
        return BounceTruncation(space, closed, directed_transport(space, directions, {}),
                                Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(space.functions())))
            .at(0);
    }

    /// Radiance of one on the sides for which `lit` says so.
    RadianceField uniform(const std::vector<bool>& lit) const {
        RadianceField field = RadianceField::Zero(space.functions(), 3);
        for (std::size_t e = 0; e < elements.size(); ++e)
            if (lit[e]) field.row(elements[e].first) = std::sqrt(elements[e].area());
        return field;
    }

    /// Means of one channel over the finest cells (rows) and angular cells (columns) of an element.
    RowMatrix means(std::size_t e, const RadianceField& field) const {
        const Element& element = elements[e];
        const auto cells = static_cast<Eigen::Index>(element.space.tree().functions());
        const auto angles = static_cast<Eigen::Index>(element.angle.functions());
        RowMatrix rows =
            Eigen::Map<const RowMatrix>(field.col(0).data() + element.first, cells, angles);
        element.space.synthesise(rows, space_levels);
        for (Eigen::Index m = 0; m < cells; ++m)
            rows.row(m) *=
                std::sqrt(static_cast<double>(angles) /
                          element.space.area({space_levels, static_cast<std::uint32_t>(m)}));
        RowMatrix columns = rows.transpose();
        angular_basis(element.angle.levels()).synthesise(columns, element.angle.levels());
        return columns.transpose();
    }

    /// Means over a spatial cell, and by angular cell over the directions that belong to it, of a
    /// function of what rays from there meet.
    template <typename Function>
    Eigen::ArrayXd means_of_met(std::size_t e, std::uint32_t cell, const Function& function) const {
        const Element& element = elements[e];
        const ParameterRect r = element.space.tree().rect({space_levels, cell});
        const Eigen::Matrix3d frame = local_frame(element.geometry);
        constexpr int n = 5, directions_across = 20;
        Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(element.angle.functions());
        for (int k = 0; k < n * n; ++k)
            for (int l = 0; l < directions_across * directions_across; ++l) {
                const Vec3 from = element.geometry.point(r.u0 + (k / n + .5) / n * (r.u1 - r.u0),
                                                         r.v0 + (k % n + .5) / n * (r.v1 - r.v0));
                const Vec3 local =
                    direction_from_square({(l / directions_across + .5) / directions_across,
                                           (l % directions_across + .5) / directions_across});
                const Vec3 towards = frame * local;
                const double met =
                    function(visibility.nearest(from, element.quad, towards), towards);
                for (const AngularShare& one : angular_shares(element.angle, angle_levels, local))
                    sum[one.cell] += one.share * met;
            }
        return sum * element.angle.functions() / (n * n * directions_across * directions_across);
    }

    const std::vector<Quad> quads = testing::box_walls({2, 1.5, 1.2});
    const Visibility visibility{quads};
    const std::vector<bool> closed = std::vector<bool>(6, true);
    std::vector<Element> elements;
    RadianceSpace space;
    std::vector<PairLinks> pairs;
    std::vector<DirectedPair> directions;
};

// What rays find between two whole sides is their exchange area, which is known exactly.
TEST_F(DirectedBox, ExchangesWhatSidesExchange) {
    ASSERT_EQ(directions.size(), pairs.size());
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        ASSERT_EQ(directions[p].receiver, pairs[p].receiver);
        ASSERT_EQ(directions[p].sender, pairs[p].sender);
        double exact = 0, found = 0;
        for (const LinkValue& link : pairs[p].links)
            exact += link.exchange;
        for (const DirectedLink& link : directions[p].links)
            found += link.exchange;
        EXPECT_NEAR(found, exact, 0.01 * exact) << p;
    }
}

TEST_F(DirectedBox, FillsEveryDirection) {
    EXPECT_LT(close_directions(elements, closed, directions), 0.05);
    EXPECT_LT(close_directions(elements, closed, directions), 0.001);
}

// Rays from a floor half of whose cells are buried start where light can be.
TEST_F(DirectedBox, StartsFromWhatIsOpen) {
    std::vector<OpenMask> masks(16, all_open);
    masks[3] = 0x00000000FFFFFFFF;
    elements[4].set_space(elements[4].space.tree(), masks);
    OracleCost cost;
    double sum = 0;
    for (const DirectedPair& pair :
         directed_links(elements, pairs, visibility, DirectedLinkOptions{rays}, {}, cost))
        for (const DirectedLink& link : pair.links)
            if (pair.sender == 4 && link.sender == elements[4].space.tree().position({2, 3}))
                sum += link.exchange;
            else if (pair.receiver == 4 &&
                     link.receiver == elements[4].space.tree().position({2, 3}))
                sum += link.exchange;
    // Half of it from here, half from the rays of the others, which meet the whole cell.
    EXPECT_NEAR(sum, 0.75 * 2 * 1.5 / 16, 0.02 * 2 * 1.5 / 16);
}

TEST_F(DirectedBox, KeepsUniformLightUniform) {
    const SymmetricOperator propagate = propagation();
    const RadianceField one = uniform(closed);
    const RadianceField result = propagated(propagate, one);
    EXPECT_LT((result - one).matrix().norm(), 1e-3 * one.matrix().norm());
}

// The radiance from one wall arrives from where that wall is seen.
TEST_F(DirectedBox, LightArrivesFromWhereItsSourceIsSeen) {
    const SymmetricOperator propagate = propagation();
    constexpr std::size_t source = 1, receiver = 4;
    std::vector<bool> lit(6, false);
    lit[source] = true;
    const RowMatrix arrived = means(receiver, propagated(propagate, uniform(lit)));
    double squares = 0, off = 0;
    for (std::uint32_t m = 0; m < arrived.rows(); ++m) {
        const Eigen::ArrayXd exact = means_of_met(receiver, m, [&](const Hit& hit, const Vec3&) {
            return hit.quad == static_cast<int>(source) ? 1.0 : 0.0;
        });
        squares += exact.square().sum();
        off += (arrived.row(m).transpose().array() - exact).square().sum();
    }
    EXPECT_LT(std::sqrt(off / squares), 0.12);
}

class GlossyBox : public DirectedBox {
  protected:
    void SetUp() override {
        DirectedBox::SetUp();
        scene.materials.resize(1);
        scene.materials[0].reflectance = Rgb::Constant(0.1);
        scene.materials[0].lobe = PhongLobe{Rgb::Constant(0.8), 5};
        for (const Quad& quad : quads)
            scene.quads.push_back({quad, 0, 0, 0});
    }

    Scene scene;
};

// Uniform light comes back from every direction by what the surface there makes of it towards here;
// which is its albedo at that angle, as the test of the lobe's representation shows.
TEST_F(GlossyBox, UniformLightComesBackByTheDirectionalAlbedo) {
    const SymmetricOperator propagate = propagation();
    const RadianceField outgoing = Reflection(scene, space).outgoing(uniform(closed));
    const RadianceField result = propagated(propagate, outgoing);
    const RowMatrix leaving = means(0, outgoing);  // alike for all sides and cells
    double squares = 0, off = 0, flux = 0, area = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const RowMatrix arrived = means(e, result);
        for (std::uint32_t m = 0; m < arrived.rows(); ++m) {
            flux += arrived.row(m).mean() * elements[e].space.area({space_levels, m});
            area += elements[e].space.area({space_levels, m});
            if (e != 0) continue;
            const Eigen::ArrayXd exact = means_of_met(e, m, [&](const Hit& hit, const Vec3& way) {
                const Element& met = elements[static_cast<std::size_t>(hit.quad)];
                const Vec3 back = local_frame(met.geometry).transpose() * -way;
                double radiance = 0;
                for (const AngularShare& one : angular_shares(met.angle, angle_levels, back))
                    radiance += one.share * leaving(0, one.cell);
                return radiance;
            });
            squares += exact.square().sum();
            off += (arrived.row(m).transpose().array() - exact).square().sum();
        }
    }
    EXPECT_LT(std::sqrt(off / squares), 0.04);
    // Total reflected flux is the mean albedo times what was there, within 0.2 %.
    const double exact = mean_albedo(scene.materials[0])[0];
    EXPECT_NEAR(flux / area, exact, 0.002 * exact);
}

// Emission of what is not reflected makes radiance one everywhere and in every direction, within
// 0.5 %, through all bounces.
TEST_F(GlossyBox, IsAFurnace) {
    const SymmetricOperator propagate = propagation();
    const Reflection reflection(scene, space);
    const RadianceField one = uniform(closed);
    const RadianceField emitted = propagated(propagate, one - reflection.outgoing(one));
    RadianceField x = emitted;
    for (int bounce = 0; bounce < 200; ++bounce)
        x = emitted + propagated(propagate, reflection.outgoing(x));
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const RowMatrix radiance = means(e, x);
        EXPECT_NEAR(radiance.minCoeff(), 1, 0.005);
        EXPECT_NEAR(radiance.maxCoeff(), 1, 0.005);
    }
}

TEST_F(DirectedBox, HasNoNormAboveOne) {
    const SymmetricOperator propagate = propagation();
    RadianceField light = RadianceField::Random(space.functions(), 3);
    double norm = 0;
    for (int step = 0; step < 100; ++step) {
        light = propagated(propagate, light / light.matrix().norm());
        norm = light.matrix().norm();
    }
    EXPECT_NEAR(norm, 1, 1e-3);
}

// Without directions it is the operator of diffuse scenes, to rounding.
TEST_F(DirectedBox, WithoutDirectionsIsTheDirectTransport) {
    build(0);
    const std::vector<Coefficient> plain = direct_transport(space, pairs, {});
    const std::vector<Coefficient> with_directions = directed_transport(space, directions, {});
    ASSERT_EQ(with_directions.size(), plain.size());
    for (std::size_t k = 0; k < plain.size(); ++k) {
        EXPECT_EQ(with_directions[k].row, plain[k].row);
        EXPECT_EQ(with_directions[k].column, plain[k].column);
        EXPECT_NEAR(with_directions[k].value, plain[k].value, 1e-6);
    }
}

/// Value of basis function `function` of a basis on one of its finest cells.
Eigen::MatrixXd values_on_cells(const HaarBasis& basis) {
    RowMatrix identity = RowMatrix::Identity(basis.tree().functions(), basis.tree().functions());
    basis.synthesise(identity, basis.tree().levels());
    // Column f holds the scaling coefficients of function f over the finest cells.
    return identity.transpose();
}

// <b_r, P b_s> by the slow sum over links, for a pair of which one side has no directions.
TEST_F(DirectedBox, CoefficientsAreInnerProducts) {
    elements[1].angle = CellTree();
    space = RadianceSpace(elements);
    elements = space.elements();
    DirectedPair pair{0, 1, {}};
    testing::Numbers numbers(7);
    const CellTree& tree = elements[0].space.tree();
    const std::uint32_t first_angle = elements[0].angle.positions() - elements[0].angle.functions();
    for (std::uint32_t k = 0; k < 20; ++k)
        pair.links.push_back({tree.position({static_cast<int>(1 + k % 2), k % 4}),
                              first_angle + (3 * k) % 16, tree.position({2, (5 * k) % 16}), 0,
                              numbers.between(0.1, 1)});
    const Eigen::MatrixXd bx = values_on_cells(elements[0].space),
                          by = values_on_cells(elements[1].space),
                          ba = values_on_cells(angular_basis(angle_levels));
    Eigen::MatrixXd slow = Eigen::MatrixXd::Zero(elements[0].functions(), elements[1].functions());
    for (const DirectedLink& link : pair.links) {
        const Cell cell = tree.at(link.receiver);
        const double share = cell.level == 2 ? 1 : 0.25;  // of each finest cell below
        for (std::uint32_t m = 0; m < 16; ++m) {
            if (cell.level == 2 ? m != cell.index : m / 4 != cell.index) continue;
            const std::uint32_t a = link.receiver_angle - first_angle;
            const std::uint32_t n = tree.at(link.sender).index;
            const double value =
                share * link.exchange /
                std::sqrt(elements[0].space.area({2, m}) / 16 * elements[1].space.area({2, n}));
            for (Eigen::Index f = 0; f < 16; ++f)
                for (Eigen::Index g = 0; g < 16; ++g)
                    for (Eigen::Index h = 0; h < 16; ++h)
                        slow(16 * f + g, h) += value * bx(f, m) * ba(g, a) * by(h, n);
        }
    }
    Eigen::MatrixXd fast = Eigen::MatrixXd::Zero(slow.rows(), slow.cols());
    for (const Coefficient& c : directed_transport(space, {pair}, {}))
        fast(c.row - elements[0].first, c.column - elements[1].first) = c.value;
    EXPECT_LT((fast - slow).cwiseAbs().maxCoeff(), 1e-6 * slow.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace lightwell
