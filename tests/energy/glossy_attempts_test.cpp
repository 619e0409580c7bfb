// Operators of glossy rooms that are built one after the other until one is good enough.
#include <array>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "radiance4d/failure.h"
#include "solver/glossy_operator.h"
#include "solver/precompute.h"
#include "tests/energy/glossy_floor.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

// Where the first operator misses its error, a tighter one is built.
TEST(GlossyAttempts, GoOnWhereTheErrorIsMissed) {
    const Scene scene = box_with_floor(phong(20), 0.1);
    PrecomputeOptions options;
    options.error = 0.05;
    options.cell_size = 1.6;
    options.most_attempts = 2;
    PrecomputeReport report;
    const Provenance reached = precompute(scene, options, {}, report).provenance;
    EXPECT_EQ(report.attempts, 2);
    OracleCost cost;
    const Settings first = glossy_settings(options, Ground(scene, cost));
    EXPECT_LT(reached.oracle_tolerance, first.oracle_tolerance);
    EXPECT_LT(reached.truncation, first.truncation);
    EXPECT_GT(reached.error_estimated, options.error);
}

// Small glossy things do not make the cells of a room wide and its truncation loose.
TEST(GlossyAttempts, StartByHowMuchIsGlossy) {
    PrecomputeOptions options;
    const auto looser = [&options](const Scene& scene) {
        OracleCost cost;
        const Ground ground(scene, cost);
        const Settings glossy = glossy_settings(options, ground);
        const Settings diffuse = settings_for(options, ground.distance, ground.elements.size());
        EXPECT_DOUBLE_EQ(glossy.truncation / diffuse.truncation,
                         glossy.cell_size / diffuse.cell_size);
        return glossy.truncation / diffuse.truncation;
    };
    EXPECT_DOUBLE_EQ(looser(box_with_floor(phong(5), 0.1)), 2);
    Scene room = box_with_floor(Lobe(NoLobe{}), 0.1);
    EXPECT_DOUBLE_EQ(looser(room), 1);
    add_block(room, {2, 1, 1}, {2.2, 1.2, 1.2}, Rgb::Constant(0.3));
    room.materials.back().lobe = phong(5);
    EXPECT_GT(looser(room), 1);
    EXPECT_LT(looser(room), 1.3);
}

// Walls show what a floor reflects no better than its directions are known.
TEST(GlossyAttempts, GlossySidesHaveTheFinerCells) {
    const Scene scene = box_with_floor(phong(20), 0.1);
    PrecomputeOptions options;
    options.error = 0.2;
    options.most_attempts = 0;
    PrecomputeReport report;
    const auto cells_by_gloss = [&] {
        std::array<std::uint32_t, 2> cells{};
        const GlobalTransport made = precompute(scene, options, {}, report);
        for (const Element& element : made.space.elements()) {
            const bool glossy = element.angle.levels() > 0;
            // The floor is as large as the ceiling.
            if (std::abs(element.geometry.normal()[2]) > 0.5)
                cells[glossy ? 1 : 0] = element.space.tree().functions();
        }
        return cells;
    };
    const auto [ceiling, floor] = cells_by_gloss();
    EXPECT_GT(ceiling, 0U);
    EXPECT_EQ(floor, 4 * ceiling);
    options.cell_size = 0.5;  // set by hand: the same everywhere
    const auto [ceiling_by_hand, floor_by_hand] = cells_by_gloss();
    EXPECT_EQ(floor_by_hand, ceiling_by_hand);
}

// What a tighter one would take is known before it is built.
TEST(GlossyAttempts, EndWhereMemoryDoes) {
    const Scene scene = box_with_floor(phong(5), 0.1);
    PrecomputeOptions options;
    options.error = 0.03;
    OracleCost cost;
    const Ground ground(scene, cost);
    const Settings first = glossy_settings(options, ground);
    const double functions = glossy_functions(ground, options, first);
    options.max_memory = static_cast<std::uint64_t>(1.01 * glossy_memory_for(ground, functions, 1));
    PrecomputeReport report;
    const GlobalTransport reached = precompute(scene, options, {}, report);
    EXPECT_EQ(report.attempts, 1);
    EXPECT_GT(reached.provenance.error_bound, options.error);
    EXPECT_EQ(reached.space.functions(), functions);
    EXPECT_EQ(reached.provenance.cell_size, first.cell_size);
}

// What does not fit is said before anything is computed; the directions count.
TEST(GlossyAttempts, RefuseWhatMemoryDoesNotAllow) {
    const Scene scene = box_with_floor(phong(20), 0.1);
    PrecomputeOptions options;
    options.cell_size = 0.8;
    options.most_attempts = 0;
    OracleCost cost;
    const Ground ground(scene, cost);
    const double functions = glossy_functions(ground, options, glossy_settings(options, ground));
    PrecomputeReport report, refused;
    EXPECT_EQ(precompute(scene, options, {}, report).space.functions(), functions);
    options.max_memory = static_cast<std::uint64_t>(0.9 * glossy_memory_for(ground, functions, 1));
    EXPECT_THROW(precompute(scene, options, {}, refused), InputError);
    EXPECT_EQ(refused.links_judged, 0U);
}

/// A room with a glossy floor, and settings in it to tighten.
class Tightened : public ::testing::Test {
  protected:
    Settings by_directions(double missed) const { return by(tighten_glossy, missed); }
    Settings by_cells(double missed) const { return by(tighten_glossy_cells, missed); }
    double functions(const Settings& settings) const {
        return glossy_functions(ground_, options, settings);
    }

    PrecomputeOptions options;
    Settings before{0.4, 1e-4, 0.06, 0.6};

  private:
    Settings by(decltype(tighten_glossy)* way, double missed) const {
        Settings settings = before;
        way(ground_, options, missed, settings);
        return settings;
    }

    const Scene scene_ = box_with_floor(phong(20), 0.1);
    OracleCost cost_;
    const Ground ground_{scene_, cost_};
};

TEST_F(Tightened, CutsDirectionsAndWhereMuchIsMissingCells) {
    for (const double missed : {1.2, 3.0}) {
        const Settings directed = by_directions(missed), celled = by_cells(missed);
        EXPECT_LT(directed.angular_tolerance, before.angular_tolerance);
        EXPECT_EQ(directed.cell_size, missed > 2 ? 0.2 : 0.4);
        EXPECT_EQ(celled.angular_tolerance, before.angular_tolerance);
        EXPECT_LT(celled.cell_size, before.cell_size);
        for (const Settings& settings : {directed, celled}) {
            EXPECT_LT(settings.oracle_tolerance, before.oracle_tolerance);
            EXPECT_LT(settings.truncation, before.truncation);
        }
    }
}

TEST_F(Tightened, LeavesAloneWhatIsSetByHand) {
    options.cell_size = 0.4;
    options.truncation = 0.06;
    options.oracle_tolerance = 1e-4;
    const Settings directed = by_directions(3);
    EXPECT_EQ(directed.cell_size, before.cell_size);
    EXPECT_EQ(directed.truncation, before.truncation);
    EXPECT_EQ(directed.oracle_tolerance, before.oracle_tolerance);
    EXPECT_LT(directed.angular_tolerance, before.angular_tolerance);
    EXPECT_EQ(by_cells(3), before);
}

// However far the lobe is below the tolerance: an attempt with the same directions again would cost
// as much as the last and be no better.
TEST_F(Tightened, GivesTheFloorOneLevelMore) {
    for (const double tolerance : {0.6, 0.45, 0.35}) {
        before.angular_tolerance = tolerance;
        const double functions_before = functions(before), now = functions(by_directions(1.2));
        EXPECT_GT(now, 3.5 * functions_before) << tolerance;
        EXPECT_LT(now, 4.1 * functions_before) << tolerance;
    }
}

TEST_F(Tightened, CutsCellsWhereDirectionsAreFinest) {
    before.angular_tolerance = 1e-3;
    const Settings after = by_directions(1.2);
    EXPECT_EQ(after.angular_tolerance, before.angular_tolerance);
    EXPECT_LT(after.cell_size, before.cell_size);
}

}  // namespace
}  // namespace lightwell
