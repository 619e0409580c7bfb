// Links of whole scenes: rooms with blocks, overlapping quads, rooms that share a wall.
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "radiance4d/scene/scene_quads.h"
#include "solver/reading/scene_reader.h"
#include "solver/transport/closure.h"
#include "solver/transport/direct_transport.h"
#include "solver/transport/elements.h"
#include "solver/transport/geometric_oracle.h"
#include "solver/transport/open_masks.h"
#include "solver/transport/refiner.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

/// A scene as far as its links.
struct Linked {
    std::vector<Element> elements;
    std::vector<bool> closed;
    std::vector<PairLinks> pairs;
    OracleCost cost;       ///< all
    OracleCost link_cost;  ///< that of the links alone
};

Linked linked(const Scene& scene, double cell_size, double tolerance,
              LinkRecords* records = nullptr) {
    const std::vector<Quad> quads = quads_of(scene);
    const Visibility visibility(quads);
    const OccluderTree tree(quads);
    Linked result;
    std::uint64_t blind = 0;
    result.elements = seeing_elements(scene, blind);
    for (const SideSurvey& side : survey_sides(result.elements, visibility, 128, result.cost))
        result.closed.push_back(side.escaped == 0);
    set_cells(result.elements, cell_size, 6);
    set_open_masks(quads, tree, visibility, result.elements, result.cost);
    double area = 0;
    for (const Element& element : result.elements)
        area += element.area();
    GeometricOracleOptions options;
    options.tolerance = tolerance;
    options.partial_tolerance = 2 * tolerance;
    const GeometricOracle oracle(options, quads, visibility, area);
    result.pairs =
        refine_links(result.elements, quads, tree, oracle, {}, result.link_cost, records);
    result.cost.rays += result.link_cost.rays;
    result.cost.links_judged += result.link_cost.links_judged;
    return result;
}

Scene sample_scene(const std::string& name) {
    return read_scene(std::string(LIGHTWELL_SCENES) + "/" + name + "/scene.toml").scene;
}

/// Largest |row sum - 1|.
double largest_gap(const Linked& scene) {
    double largest = 0;
    for (const std::vector<double>& rows : row_sums(scene.elements, scene.pairs))
        for (const double row : rows)
            largest = std::max(largest, std::abs(row - 1));
    return largest;
}

void expect_same(const std::vector<PairLinks>& a, const std::vector<PairLinks>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t p = 0; p < a.size(); ++p) {
        ASSERT_EQ(a[p].receiver, b[p].receiver);
        ASSERT_EQ(a[p].sender, b[p].sender);
        ASSERT_EQ(a[p].links.size(), b[p].links.size());
        for (std::size_t k = 0; k < a[p].links.size(); ++k) {
            EXPECT_EQ(a[p].links[k].receiver, b[p].links[k].receiver);
            EXPECT_EQ(a[p].links[k].sender, b[p].links[k].sender);
            EXPECT_EQ(a[p].links[k].exchange, b[p].links[k].exchange);
            EXPECT_EQ(a[p].links[k].sampled, b[p].links[k].sampled);
        }
    }
}

// The obvious way, from the start, beside the one that goes on: the same to the last bit, for less.
TEST(LinkRecords, LeadToTheLinksOfARefinementFromTheStart) {
    for (const char* name : {"cornell-box", "two-rooms", "maze"}) {
        SCOPED_TRACE(name);
        const Scene scene = sample_scene(name);
        const double cell_size = std::string(name) == "maze" ? 1.2 : 0.4;
        LinkRecords records;
        for (const double tolerance : {1e-3, 3e-4, 2.9e-4, 8e-5}) {
            SCOPED_TRACE(tolerance);
            const bool first = records.empty();
            const Linked gone_on = linked(scene, cell_size, tolerance, &records);
            const Linked from_the_start = linked(scene, cell_size, tolerance);
            expect_same(gone_on.pairs, from_the_start.pairs);
            if (first) continue;
            EXPECT_LT(gone_on.link_cost.links_judged, from_the_start.link_cost.links_judged);
            EXPECT_LE(gone_on.link_cost.rays, from_the_start.link_cost.rays);
        }
    }
}

TEST(LinkRecords, CostNothingWhereNothingChanges) {
    const Scene scene = sample_scene("cornell-box");
    LinkRecords records;
    const Linked once = linked(scene, 0.5, 1e-4, &records);
    const Linked again = linked(scene, 0.5, 1e-4, &records);
    expect_same(once.pairs, again.pairs);
    EXPECT_GT(once.link_cost.rays, 0U);
    EXPECT_EQ(again.link_cost.rays, 0U);
    EXPECT_EQ(again.link_cost.links_judged, 0U);
}

TEST(Closure, MakesTheRowsOfAFurnaceSumToOne) {
    Linked furnace = linked(sample_scene("furnace"), 0.5, 1e-4);
    for (const bool closed : furnace.closed)
        EXPECT_TRUE(closed);
    const double before = largest_gap(furnace);
    const ClosureReport report = close_links(furnace.elements, furnace.closed, {}, furnace.pairs);
    const double after = largest_gap(furnace);
    RecordProperty("before", std::to_string(before));
    RecordProperty("after", std::to_string(after));
    EXPECT_GT(report.deficit_before, 1e-3) << "rays leave something to mend";
    EXPECT_LT(report.deficit_after, 1e-3);
    EXPECT_LT(after, 0.5 * before);
}

TEST(Closure, LeavesExactLinksAlone) {
    Linked furnace = linked(sample_scene("furnace"), 1, 1e-4);
    const std::vector<PairLinks> before = furnace.pairs;
    close_links(furnace.elements, furnace.closed, {}, furnace.pairs);
    int changed = 0;
    for (std::size_t p = 0; p < before.size(); ++p)
        for (std::size_t k = 0; k < before[p].links.size(); ++k) {
            const double was = before[p].links[k].exchange, is = furnace.pairs[p].links[k].exchange;
            EXPECT_GE(is, 0);
            if (!before[p].links[k].sampled) {
                EXPECT_EQ(was, is);
            } else {
                EXPECT_LE(is, was * ClosureOptions().most_change * (1 + 1e-12));
                EXPECT_GE(is, was / ClosureOptions().most_change * (1 - 1e-12));
            }
            changed += was != is ? 1 : 0;
        }
    EXPECT_GT(changed, 100);
}

TEST(Closure, SendsNothingIntoTheOpen) {
    // A box without its ceiling: most rows are below one, and rightly so.
    std::array<Rgb, 6> grey;
    grey.fill(Rgb::Constant(0.5));
    Scene scene = box_scene({3, 3, 3}, grey);
    scene.quads.pop_back();
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    add_block(scene, {1, 1, 0}, {2, 2, 1}, Rgb::Constant(0.5));
    Linked open = linked(scene, 0.75, 1e-4);
    const auto before = row_sums(open.elements, open.pairs);
    close_links(open.elements, std::vector<bool>(open.elements.size(), false), {}, open.pairs);
    const auto after = row_sums(open.elements, open.pairs);
    for (std::size_t e = 0; e < before.size(); ++e)
        for (std::size_t m = 0; m < before[e].size(); ++m)
            EXPECT_LE(after[e][m], before[e][m] + 1e-12);
}

TEST(SceneLinks, AreTheSameForAnyNumberOfThreads) {
    const Scene scene = sample_scene("furnace");
    const auto with = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Linked result = linked(scene, 0.75, 1e-4);
        close_links(result.elements, result.closed, {}, result.pairs);
        const RadianceSpace space(result.elements);
        return std::pair{result, direct_transport(space, result.pairs, {})};
    };
    const auto [one, one_operator] = with(1);
    const auto [two, two_operator] = with(2);
    EXPECT_GT(one.cost.rays, 1000U);
    EXPECT_EQ(one.cost.rays, two.cost.rays);
    ASSERT_EQ(one.pairs.size(), two.pairs.size());
    for (std::size_t p = 0; p < one.pairs.size(); ++p) {
        ASSERT_EQ(one.pairs[p].links.size(), two.pairs[p].links.size());
        for (std::size_t k = 0; k < one.pairs[p].links.size(); ++k) {
            const LinkValue &a = one.pairs[p].links[k], &b = two.pairs[p].links[k];
            ASSERT_TRUE(a.receiver == b.receiver && a.sender == b.sender &&
                        a.exchange == b.exchange && a.sampled == b.sampled);
        }
    }
    ASSERT_EQ(one_operator.size(), two_operator.size());
    for (std::size_t k = 0; k < one_operator.size(); ++k)
        ASSERT_TRUE(one_operator[k].row == two_operator[k].row &&
                    one_operator[k].column == two_operator[k].column &&
                    one_operator[k].value == two_operator[k].value);
}

// A carpet in the plane of the floor, smaller than it and not on its grid.
TEST(SceneLinks, CoplanarQuadsDoNotCountTwice) {
    std::array<Rgb, 6> grey;
    grey.fill(Rgb::Constant(0.5));
    Scene scene = box_scene({4, 3, 2}, grey);
    add_quad(scene, {{Vec3(0.7, 0.7, 0), Vec3(3.1, 0.7, 0), Vec3(3.1, 2.2, 0), Vec3(0.7, 2.2, 0)}},
             Rgb::Constant(0.5));
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    const Linked room = linked(scene, 0.5, 1e-4);
    const auto rows = row_sums(room.elements, room.pairs);
    for (std::size_t e = 0; e < rows.size(); ++e) {
        if (room.elements[e].geometry.normal()[2] > 0.5) continue;
        double mean = 0;
        for (const double row : rows[e]) {
            EXPECT_NEAR(row, 1, 0.1) << "element " << e;
            mean += row / static_cast<double>(rows[e].size());
        }
        EXPECT_NEAR(mean, 1, 0.02) << "element " << e;
    }
}

// Where two solid walls meet, each goes on inside of the other. A sliver of one's first cell sticks
// out, between samples of its mask. Next to nothing of that cell is measured: a link for the whole
// of it would carry many times its light. What coarser cells spread to it is no harm.
TEST(SceneLinks, SliversOfBuriedCellsSendNothing) {
    std::array<Rgb, 6> grey;
    grey.fill(Rgb::Constant(0.5));
    Scene scene = box_scene({2, 2, 2}, grey);
    add_block(scene, {0, 0, 0}, {0.12, 2, 2}, Rgb::Constant(0.5));
    add_block(scene, {0, 0, 0}, {2, 0.15, 2}, Rgb::Constant(0.5));
    for (Material& material : scene.materials)
        material.reflecting = Sides::front;
    const Linked room = linked(scene, 0.125, 1e-4);
    const auto rows = row_sums(room.elements, room.pairs);
    int buried = 0;
    for (std::size_t e = 0; e < rows.size(); ++e) {
        for (std::size_t m = 0; m < rows[e].size(); ++m) {
            const bool is_buried = !room.elements[e].open.empty() && room.elements[e].open[m] == 0;
            buried += is_buried ? 1 : 0;
            EXPECT_LT(rows[e][m], is_buried ? 0.5 : 1.5) << "element " << e << ", cell " << m;
        }
    }
    EXPECT_GT(buried, 0);
}

TEST(SceneLinks, NothingLeaksThroughAWallWithoutThickness) {
    const Linked rooms = linked(sample_scene("two-rooms"), 0.5, 1e-4);
    const auto is_in_first_room = [&](std::uint32_t e) {
        const Quad& side = rooms.elements[e].geometry;
        return (side.centre() + 1e-3 * side.normal())[0] < 4;
    };
    int first = 0;
    for (std::uint32_t e = 0; e < rooms.elements.size(); ++e)
        first += is_in_first_room(e) ? 1 : 0;
    ASSERT_GE(first, 6);
    ASSERT_GE(static_cast<int>(rooms.elements.size()) - first, 6);
    ASSERT_FALSE(rooms.pairs.empty());
    for (const PairLinks& pair : rooms.pairs)
        EXPECT_EQ(is_in_first_room(pair.receiver), is_in_first_room(pair.sender))
            << rooms.elements[pair.receiver].quad << " and " << rooms.elements[pair.sender].quad;
}

}  // namespace
}  // namespace lightwell
