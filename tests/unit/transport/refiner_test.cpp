#include "solver/transport/refiner.h"

#include <atomic>
#include <cmath>

#include <gtest/gtest.h>

#include "solver/transport/closure.h"
#include "solver/transport/geometric_oracle.h"
#include "solver/transport/kernel.h"
#include "tests/unit/basis/samples.h"
#include "tests/unit/transport/box.h"
#include "tests/unit/transport/partition.h"

namespace lightwell {
namespace {

/// Decides by lot, the same for the same link, and gives every stratum its share of one.
class LotOracle : public Oracle {
  public:
    explicit LotOracle(unsigned seed) : seed_(seed) {}

    Verdict judge(const LinkGeometry& link, std::vector<int>& /*occluders*/, LinkStrata& strata,
                  OracleCost& cost) const override {
        ++cost.links_judged;
        std::seed_seq key{seed_, link.link.receiver.element, link.link.sender.element,
                          link.receiver->space.tree().position(link.link.receiver.space),
                          link.sender->space.tree().position(link.link.sender.space)};
        std::mt19937 bits(key);
        unsigned sides = bits() % 4 == 0 ? 0 : bits() & (receiver_space | sender_space);
        if (link.receiver_finest) sides &= ~unsigned{receiver_space};
        if (link.sender_finest) sides &= ~unsigned{sender_space};
        if (sides != 0) return {Verdict::Act::refine, sides, {}};
        for (auto& row : strata.exchange)
            row.fill(1);
        strata.sampled = bits() % 2 == 0;
        return {Verdict::Act::keep, 0, {}};
    }
    bool needs_occluders() const override { return false; }

  private:
    unsigned seed_;
};

std::vector<Element> mixed_elements(const std::vector<Quad>& quads) {
    const std::vector<CellTree> trees = testing::sample_trees();
    std::vector<Element> elements;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        Element element;
        element.quad = static_cast<int>(q);
        element.geometry = quads[q];
        element.set_space(trees[(q + 4) % trees.size()], {});
        elements.push_back(element);
    }
    return elements;
}

TEST(Refiner, LinksPartEveryPairOfElementsWhateverTheVerdicts) {
    const std::vector<Quad> walls = testing::box_walls({3, 2, 1});
    const std::vector<Element> elements = mixed_elements(walls);
    const OccluderTree tree(walls);
    for (unsigned seed = 0; seed < 20; ++seed) {
        OracleCost cost;
        const auto pairs = refine_links(elements, walls, tree, LotOracle(seed), {}, cost);
        ASSERT_EQ(pairs.size(), 15U);
        std::size_t next = 0;
        for (std::uint32_t i = 0; i < 6; ++i)
            for (std::uint32_t j = i + 1; j < 6; ++j, ++next) {
                EXPECT_EQ(pairs[next].receiver, i);
                EXPECT_EQ(pairs[next].sender, j);
                EXPECT_TRUE((testing::covered(elements, pairs[next]).array() == 1).all());
            }
        EXPECT_GT(cost.links_judged, 15U);
    }
}

TEST(Refiner, ElementsThatDoNotFaceGetNoLinks) {
    const Quad floor = testing::unit_square();
    Quad beside = floor, above = floor;
    for (Vec3& v : beside.vertex)
        v += Vec3(2, 0, 0);
    for (Vec3& v : above.vertex)
        v += Vec3(0, 0, 1);
    // Coplanar neighbours, and a quad that shows its back.
    const std::vector<Quad> quads = {floor, beside, above};
    OracleCost cost;
    EXPECT_TRUE(refine_links(testing::uniform_elements(quads, 1), quads, OccluderTree(quads),
                             LotOracle(1), {}, cost)
                    .empty());
}

TEST(Refiner, BuriedElementsGetNoLinks) {
    const std::vector<Quad> walls = testing::box_walls({3, 2, 1});
    std::vector<Element> elements = testing::uniform_elements(walls, 1);
    elements[2].set_space(CellTree(elements[2].space.tree()), std::vector<OpenMask>(4, 0));
    elements[3].set_space(CellTree(elements[3].space.tree()), {0, 0, 1, 0});
    OracleCost cost;
    const auto pairs = refine_links(elements, walls, OccluderTree(walls), LotOracle(1), {}, cost);
    EXPECT_EQ(pairs.size(), 10U) << "those of the five others";
    for (const PairLinks& pair : pairs)
        EXPECT_TRUE(pair.receiver != 2 && pair.sender != 2);
}

struct BoxLinks {
    std::vector<Element> elements;
    std::vector<PairLinks> pairs;
};

BoxLinks box_links(const Vec3& size, int levels, double tolerance) {
    const std::vector<Quad> walls = testing::box_walls(size);
    BoxLinks box{testing::uniform_elements(walls, levels), {}};
    const Visibility visibility(walls);
    GeometricOracleOptions options;
    options.tolerance = options.partial_tolerance = tolerance;
    double area = 0;
    for (const Quad& wall : walls)
        area += wall.area();
    const GeometricOracle oracle(options, walls, visibility, area);
    OracleCost cost;
    box.pairs = refine_links(box.elements, walls, OccluderTree(walls), oracle, {}, cost);
    EXPECT_EQ(cost.rays, 0U) << "an empty box needs no rays";
    return box;
}

TEST(GeometricOracle, LinksPartAnEmptyBoxAtAnyTolerance) {
    testing::Numbers numbers(60);
    std::size_t fewest = 1 << 20, most = 0;
    for (int k = 0; k < 12; ++k) {
        const double tolerance = k == 0 ? 0 : std::pow(10, numbers.between(-6, -1));
        const BoxLinks box = box_links({4, 3, 2}, 3, tolerance);
        std::size_t links = 0;
        for (const PairLinks& pair : box.pairs) {
            EXPECT_TRUE((testing::covered(box.elements, pair).array() == 1).all());
            links += pair.links.size();
        }
        fewest = std::min(fewest, links);
        most = std::max(most, links);
    }
    EXPECT_LT(2 * fewest, most) << "the tolerance decides how many";
}

TEST(GeometricOracle, RowsOfAFullyRefinedBoxSumToOne) {
    for (const Vec3& size : {Vec3(4, 4, 4), Vec3(5, 4, 3), Vec3(20, 6, 3)}) {
        const BoxLinks box = box_links(size, 3, 0);
        for (const std::vector<double>& rows : row_sums(box.elements, box.pairs))
            for (const double row : rows)
                EXPECT_NEAR(row, 1, 1e-5);
    }
}

// Where links are coarse, what their strata get of the exact whole is an estimate; the whole is
// not. So the energy that a wall exchanges is exact at any tolerance.
TEST(GeometricOracle, WallsOfABoxCloseAtAnyTolerance) {
    for (const double tolerance : {0.0, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const BoxLinks box = box_links({5, 4, 3}, 3, tolerance);
        const auto rows = row_sums(box.elements, box.pairs);
        for (std::size_t e = 0; e < 6; ++e) {
            double mean = 0;
            for (const double row : rows[e])
                mean += row / static_cast<double>(rows[e].size());
            EXPECT_NEAR(mean, 1, 1e-5) << "wall " << e << " at " << tolerance;
        }
    }
}

TEST(GeometricOracle, RowsComeToOneAsTheToleranceFalls) {
    double previous = 1;
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
        const BoxLinks box = box_links({5, 4, 3}, 4, tolerance);
        double squares = 0, count = 0;
        for (const std::vector<double>& rows : row_sums(box.elements, box.pairs))
            for (const double row : rows) {
                squares += (row - 1) * (row - 1);
                count += 1;
            }
        const double rms = std::sqrt(squares / count);
        EXPECT_LT(rms, 1.05 * previous) << "at " << tolerance;
        EXPECT_LT(rms, 0.05);
        previous = rms;
    }
    EXPECT_LT(previous, 3e-3);
}

// Two cells that meet at a right angle, and a speck between them, so that rays decide. The strip of
// the floor that is farthest from the wall, and exchanges least, is buried: rays from there are
// drawn again nearer by, where the kernel is larger. By no chance may that make more exchange than
// the open part has.
TEST(GeometricOracle, NoiseMakesNoMoreThanThereIs) {
    const Quad floor{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
    const Quad wall{{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, 1), Vec3(0, 0, 1)}};
    const Quad speck{{Vec3(0.4, 0.5, 0.4), Vec3(0.402, 0.5, 0.402), Vec3(0.402, 0.502, 0.402),
                      Vec3(0.4, 0.502, 0.4)}};
    const std::vector<Quad> quads = {floor, wall, speck};
    const Visibility visibility(quads);
    GeometricOracleOptions options;
    options.partial_tolerance = 1;  // not one ray more than these
    options.rays = 4;
    const GeometricOracle oracle(options, quads, visibility, 2);
    std::vector<Element> elements = testing::uniform_elements({floor, wall}, 0);
    constexpr OpenMask far_strip = 0x8080808080808080;  // the eighth with the highest u
    elements[0].set_space(CellTree(), {all_open & ~far_strip});

    LinkGeometry link;
    link.receiver = &elements[0];
    link.sender = &elements[1];
    link.receiver_finest = link.sender_finest = true;
    link.receiver_facet = Facet::of(floor, floor.normal());
    link.sender_facet = Facet::of(wall, wall.normal());
    const double whole = exchange_area(link.receiver_facet, link.sender_facet);
    constexpr double open_share = 7.0 / 8;
    int unhindered = 0;
    for (std::uint32_t lot = 0; lot < 200; ++lot) {
        link.link.receiver.element = lot;  // another sequence of samples
        std::vector<int> occluders = {2};
        LinkStrata strata;
        OracleCost cost;
        const Verdict verdict = oracle.judge(link, occluders, strata, cost);
        ASSERT_EQ(verdict.act, Verdict::Act::keep);
        ASSERT_EQ(cost.rays, 4U);
        EXPECT_LE(strata.exchange[0][0], (1 + 1e-12) * open_share * whole);
        unhindered += strata.exchange[0][0] > (1 - 1e-12) * open_share * whole ? 1 : 0;
    }
    EXPECT_GT(unhindered, 190) << "a speck stands in the way of few rays";
}

// A floor cell that a block's face cuts in two, the half behind it buried: the half before it is
// all that faces, so the exchange with the face is that half's, in full.
TEST(GeometricOracle, HalfOfACellUnderABlockFacesItsFootInFull) {
    const Quad floor{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
    const Quad face{{Vec3(0.5, 0, 0), Vec3(0.5, 0, 1), Vec3(0.5, 1, 1), Vec3(0.5, 1, 0)}};
    ASSERT_LT(face.normal()[0], 0) << "looks at the low half";
    const std::vector<Quad> quads = {floor, face};
    const Visibility visibility(quads);
    std::vector<Element> elements = testing::uniform_elements(quads, 0);
    elements[0].set_space(CellTree(), {0x0F0F0F0F0F0F0F0F});  // u < 1/2
    GeometricOracleOptions options;
    options.tolerance = options.partial_tolerance = 1;
    const GeometricOracle oracle(options, quads, visibility, 2);
    OracleCost cost;
    const auto pairs = refine_links(elements, quads, OccluderTree(quads), oracle, {}, cost);
    ASSERT_EQ(pairs.size(), 1U);
    ASSERT_EQ(pairs[0].links.size(), 1U);
    const Quad half = floor.part(0, 0.5, 0, 1);
    const double exact =
        exchange_area(Facet::of(half, half.normal()), Facet::of(face, face.normal()));
    EXPECT_NEAR(pairs[0].links[0].exchange, exact, 1e-9 * exact);
}

TEST(Refiner, StopsWhenAsked) {
    const std::vector<Quad> walls = testing::box_walls({1, 1, 1});
    Progress progress;
    progress.stop_requested = [] { return true; };
    OracleCost cost;
    EXPECT_THROW(refine_links(testing::uniform_elements(walls, 1), walls, OccluderTree(walls),
                              LotOracle(1), progress, cost),
                 Interrupted);
}

/// Refines everything to the finest cells, and counts what it is asked.
class FinestOracle : public Oracle {
  public:
    Verdict judge(const LinkGeometry& link, std::vector<int>& /*occluders*/, LinkStrata& strata,
                  OracleCost& /*cost*/) const override {
        ++asked;
        unsigned sides = 0;
        if (!link.receiver_finest) sides |= receiver_space;
        if (!link.sender_finest) sides |= sender_space;
        if (sides != 0) return {Verdict::Act::refine, sides, {}};
        strata.exchange[0].fill(1);
        return {Verdict::Act::keep, 0, {}};
    }
    bool needs_occluders() const override { return false; }

    mutable std::atomic<std::size_t> asked{0};
};

TEST(Refiner, MakesNoMoreLinksThanAllowed) {
    const std::vector<Quad> walls = testing::box_walls({1, 1, 1});
    const std::vector<Element> elements = testing::uniform_elements(walls, 1);
    const std::size_t all = 15 * 4 * 4;  // pairs of walls, of four cells each
    OracleCost cost;
    const auto links_of = [&](std::uint64_t most) {
        std::size_t links = 0;
        for (const PairLinks& pair : refine_links(elements, walls, OccluderTree(walls),
                                                  FinestOracle(), {}, cost, nullptr, {most}))
            links += pair.links.size();
        return links;
    };
    EXPECT_EQ(links_of(all), all);
    EXPECT_THROW(links_of(all - 1), TooManyLinks);
}

TEST(Refiner, RecordsNoMoreLinksThanAllowed) {
    const std::vector<Quad> walls = testing::box_walls({1, 1, 1});
    const std::vector<Element> elements = testing::uniform_elements(walls, 1);
    const std::size_t all = 15 * 4 * 4;
    for (const std::size_t recorded : {all, all - 1}) {
        LinkRecords records;
        LinkLimits limits;
        limits.recorded = recorded;
        OracleCost cost;
        const auto pairs = refine_links(elements, walls, OccluderTree(walls), FinestOracle(), {},
                                        cost, &records, limits);
        EXPECT_EQ(pairs.size(), 15U);
        EXPECT_EQ(records.empty(), recorded < all);
    }
}

TEST(Refiner, StopsAmidAPairWithTooManyLinks) {
    std::vector<Quad> facing = testing::box_walls({1, 1, 1});
    facing.resize(2);
    const std::vector<Element> elements = testing::uniform_elements(facing, 5);
    const FinestOracle oracle;
    OracleCost cost;
    EXPECT_THROW(
        refine_links(elements, facing, OccluderTree(facing), oracle, {}, cost, nullptr, {1}),
        TooManyLinks);
    EXPECT_LT(oracle.asked, 1024U * 1024U / 10);  // of links that there would be
}

}  // namespace
}  // namespace lightwell
