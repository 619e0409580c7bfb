// Operators of rooms without gloss that are built one after the other until one is good enough.
#include <array>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "solver/diffuse_operator.h"
#include "solver/pipeline.h"
#include "solver/precompute.h"
#include "solver/tightening.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

Scene grey_box(const Vec3& size) {
    std::array<Rgb, 6> reflectance;
    reflectance.fill(Rgb::Constant(0.5));
    return box_scene(size, reflectance);
}

// All walls of a cube are halved at the same limit: one that is a little lower than a limit before
// it either changes nothing or makes four times as many cells.
TEST(Attempts, FinerCellsAreMore) {
    const Scene cube = grey_box({1, 1, 1}), hall = grey_box({3.1, 7.3, 2.2});
    PrecomputeOptions options;
    for (const Scene& scene : {cube, hall}) {
        OracleCost cost;
        const Ground ground(scene, cost);
        for (const double limit : {0.24, 0.2, 0.17, 0.14, 0.126}) {
            for (const double missed : {1.02, 1.3, 3.0}) {
                Settings settings;
                settings.cell_size = limit;
                const double before = cells_at(ground, settings);
                diffuse_pipeline().tighten_else(ground, options, missed, settings);
                const double more = cells_at(ground, settings) / before;
                EXPECT_GE(more, 1.4) << limit << " missed by " << missed;
                EXPECT_LE(more, 4) << limit << " missed by " << missed;
            }
        }
        options.cell_size = 0.2;
        Settings settings;
        settings.cell_size = 0.2;
        diffuse_pipeline().tighten_else(ground, options, 3, settings);
        EXPECT_EQ(settings.cell_size, 0.2) << "set by hand";
        options.cell_size.reset();
    }
}

// Where all cells are linked with all others, finer ones have more links than is foreseen.
TEST(Attempts, OneThatProvesTooLargeLeavesTheLast) {
    const Scene scene = grey_box({1, 1, 1});
    PrecomputeOptions options;
    options.error = 0.2;
    options.oracle_tolerance = 1e-8;
    options.truncation = 0.95;
    options.most_attempts = 1;
    PrecomputeReport one;
    const Provenance first = precompute(scene, options, {}, one).provenance;
    ASSERT_GT(first.error_bound, options.error);

    options.most_attempts = 2;
    options.max_memory = std::uint64_t{256} << 20;
    OracleCost cost;
    Settings before, after;
    before.cell_size = after.cell_size = first.cell_size;
    before.oracle_tolerance = after.oracle_tolerance = first.oracle_tolerance;
    const Ground ground(scene, cost);
    diffuse_pipeline().tighten_else(ground, options, 2, after);
    const auto allowed = static_cast<double>(options.max_memory);
    ASSERT_LT(memory_for_links(first.links, before, after), allowed) << "not even tried";
    ASSERT_LT(memory_for(cells_at(ground, after), 1), allowed) << "not even tried";
    PrecomputeReport two;
    const Provenance last = precompute(scene, options, {}, two).provenance;
    EXPECT_EQ(two.attempts, 1);
    EXPECT_EQ(last.links, first.links);
    EXPECT_EQ(last.cell_size, first.cell_size);
    EXPECT_EQ(last.error_bound, first.error_bound);
}

TEST(Attempts, AFirstThatProvesTooLargeIsRefused) {
    const Scene scene = grey_box({1, 1, 1});
    PrecomputeOptions options;
    options.error = 0.2;
    options.oracle_tolerance = 1e-8;
    options.most_attempts = 0;
    options.max_memory = std::uint64_t{32} << 20;
    PrecomputeReport report;
    try {
        precompute(scene, options, {}, report);
        FAIL() << "it was computed";
    } catch (const MemoryExceeded& refused) {
        const std::string message = refused.what();
        EXPECT_NE(message.find("million links"), std::string::npos) << message;
        EXPECT_NE(message.find("the 32 MiB that are allowed (--max-memory)"), std::string::npos)
            << message;
    }
}

}  // namespace
}  // namespace lightwell
