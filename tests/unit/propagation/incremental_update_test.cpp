#include "runtime/propagation/incremental_update.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/propagation/coloured_room.h"

namespace lightwell {
namespace {

using testing::coloured_room;
using testing::light_path;
using testing::light_paths;

const GlobalPropagation& propagation() {
    static const GlobalPropagation held(coloured_room().transport);
    return held;
}

PackedField exact(const PackedField& direct) {
    PackedField indirect = PackedField::Zero(4, direct.cols());
    propagation().apply(direct, indirect);
    return indirect;
}

double distance(const PackedField& a, const PackedField& b) {
    return (a - b).cast<double>().matrix().norm();
}

double relative_distance(const PackedField& a, const PackedField& b) {
    return distance(a, b) / b.cast<double>().matrix().norm();
}

UpdateOptions options(UpdateMode mode, std::uint32_t budget) {
    UpdateOptions result;
    result.mode = mode;
    result.budget = budget;
    return result;
}

Vec3 random_place(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0.05, 0.95);
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return {3 * x, 4 * y, 1.25 + 1.25 * z};
}

class OfMode : public ::testing::TestWithParam<UpdateMode> {};

TEST_P(OfMode, IsTheProductInEveryFrameWithoutABudget) {
    IncrementalUpdate update(coloured_room().transport.space, propagation());
    for (const Vec3& place : light_path(1, 12)) {
        const PackedField direct = coloured_room().lamp_at(place);
        const UpdateReport report = update.update(direct, options(GetParam(), 0));
        EXPECT_EQ(report.pending, 0U);
        EXPECT_LT(relative_distance(update.indirect(), exact(direct)), 1e-6);
    }
}

TEST_P(OfMode, MultipliesNoMoreThanTheBudgetInMotion) {
    IncrementalUpdate update(coloured_room().transport.space, propagation());
    for (const Vec3& place : light_path(1, 12)) {
        const UpdateReport report =
            update.update(coloured_room().lamp_at(place), options(GetParam(), 30));
        EXPECT_EQ(report.coefficients, 30U);
        EXPECT_GT(report.pending, 0U);
    }
}

TEST_P(OfMode, HoldsTheProductOfTheLightThatItSaysItRepresents) {
    IncrementalUpdate update(coloured_room().transport.space, propagation());
    for (const Vec3& place : light_path(2, 12)) {
        update.update(coloured_room().lamp_at(place), options(GetParam(), 50));
        EXPECT_LT(relative_distance(update.indirect(), exact(update.represented())), 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(IncrementalUpdate, OfMode,
                         ::testing::Values(UpdateMode::fresh, UpdateMode::incremental,
                                           UpdateMode::per_band));

/// The update as the paper has it, without any of the scratch space: coefficients of E' alone.
class PlainUpdate {
  public:
    PackedField represented;

    void update(const PackedField& direct, std::size_t budget) {
        const RadianceSpace& space = coloured_room().transport.space;
        if (represented.cols() == 0) represented = PackedField::Zero(4, direct.cols());
        const auto band_of = [&](std::uint32_t j) {
            const Element& element = space.element(space.element_of(j));
            return element.space.tree().level_of_function((j - element.first) /
                                                          element.angle.functions());
        };
        const auto l1 = [&](const PackedField& field, int band) {
            double sum = 0;
            for (std::uint32_t j = 0; j < propagation().size(); ++j)
                if (band_of(j) == band && propagation().energy()[j] > 0)
                    sum += static_cast<double>(field.col(j).abs().sum());
            return sum;
        };
        for (int band = 0; band < 16; ++band)
            if (!(l1(direct - represented, band) < l1(direct, band)))
                for (std::uint32_t j = 0; j < propagation().size(); ++j)
                    if (band_of(j) == band) represented.col(j).setZero();
        std::vector<std::pair<float, std::uint32_t>> order;
        for (std::uint32_t j = 0; j < propagation().size(); ++j) {
            const double change = (direct.col(j) - represented.col(j)).head<3>().abs().sum() *
                                  static_cast<double>(propagation().energy()[j]);
            if (change > 0) order.emplace_back(-change, j);
        }
        std::sort(order.begin(), order.end());
        for (std::size_t k = 0; k < std::min(budget, order.size()); ++k)
            represented.col(order[k].second) = direct.col(order[k].second);
    }
};

TEST(IncrementalUpdate, ChoosesAsThePlainAlgorithmDoes) {
    IncrementalUpdate update(coloured_room().transport.space, propagation());
    PlainUpdate plain;
    for (const testing::LightPath& path : light_paths(10))
        for (const Vec3& place : path) {
            const PackedField direct = coloured_room().lamp_at(place);
            const UpdateReport report = update.update(direct, options(UpdateMode::per_band, 40));
            plain.update(direct, report.coefficients);
            for (std::uint32_t j = 0; j < propagation().size(); ++j) {
                const bool same = (update.represented().col(j) == plain.represented.col(j)).all();
                ASSERT_TRUE(same || propagation().energy()[j] == 0) << "coefficient " << j;
            }
        }
}

TEST(IncrementalUpdate, IsExactWithinTenFramesOfRest) {
    for (const UpdateMode mode : {UpdateMode::incremental, UpdateMode::per_band}) {
        IncrementalUpdate update(coloured_room().transport.space, propagation());
        PackedField direct;
        for (const Vec3& place : light_path(1, 20)) {
            direct = coloured_room().lamp_at(place);
            update.update(direct, options(mode, 30));
        }
        const PackedField truth = exact(direct);
        ASSERT_GT(relative_distance(update.indirect(), truth), 1e-3);
        UpdateReport report;
        for (int frame = 0; frame < 10; ++frame)
            report = update.update(direct, options(mode, 30));
        EXPECT_EQ(report.pending, 0U);
        EXPECT_FALSE(report.changed);
        EXPECT_LT(relative_distance(update.indirect(), truth), 1e-6);
    }
}

TEST(IncrementalUpdate, ThereAndBackLeavesNoGhost) {
    const PackedField here = coloured_room().lamp_at(Vec3(0.6, 0.7, 1.8));
    // A millimetre off the ceiling it is many thousand times brighter there.
    const PackedField there = coloured_room().lamp_at(Vec3(2.2, 3.1, 2.499));
    for (const UpdateMode mode : {UpdateMode::incremental, UpdateMode::per_band}) {
        IncrementalUpdate update(coloured_room().transport.space, propagation());
        update.update(here, options(mode, 0));
        update.update(there, options(mode, 0));
        update.update(here, options(mode, 0));
        EXPECT_LT(relative_distance(update.indirect(), exact(here)), 1e-6);
    }
}

TEST(IncrementalUpdate, WithABudgetALightThatJumpsBackLeavesNoMoreThanItsOwnError) {
    const PackedField here = coloured_room().lamp_at(Vec3(0.6, 0.7, 1.8));
    const PackedField there = coloured_room().lamp_at(Vec3(2.2, 3.1, 2.2));
    IncrementalUpdate update(coloured_room().transport.space, propagation());
    IncrementalUpdate first(coloured_room().transport.space, propagation());
    first.update(here, options(UpdateMode::per_band, 100));
    for (const PackedField& light : {here, there, here})
        update.update(light, options(UpdateMode::per_band, 100));
    const PackedField truth = exact(here);
    EXPECT_LT(relative_distance(update.indirect(), truth),
              1.5 * relative_distance(first.indirect(), truth));
}

TEST(IncrementalUpdate, ALightThatGoesOutLeavesDarkness) {
    const PackedField lamp = coloured_room().lamp_at(Vec3(0.6, 0.7, 1.8));
    const PackedField dark = PackedField::Zero(4, lamp.cols());
    IncrementalUpdate update(coloured_room().transport.space, propagation());
    update.update(lamp, options(UpdateMode::per_band, 0));
    const UpdateReport report = update.update(dark, options(UpdateMode::per_band, 30));
    EXPECT_EQ(report.fresh_bands, update.bands());
    EXPECT_EQ(report.pending, 0U);
    EXPECT_LT(distance(update.indirect(), dark), 1e-6 * distance(exact(lamp), dark));
}

TEST(IncrementalUpdate, AThousandRandomEditsLeaveNoDrift) {
    std::mt19937 random(3);
    std::vector<PackedField> lights;
    for (int k = 0; k < 25; ++k)
        lights.push_back(coloured_room().lamp_at(random_place(random)));
    for (const UpdateMode mode : {UpdateMode::incremental, UpdateMode::per_band}) {
        IncrementalUpdate update(coloured_room().transport.space, propagation());
        PackedField direct;
        for (int edit = 0; edit < 1000; ++edit) {
            const float dimmed = std::exp2(static_cast<float>(random() % 20) - 10);
            direct = dimmed * lights[random() % lights.size()];
            update.update(direct, options(mode, 30));
        }
        EXPECT_LT(relative_distance(update.indirect(), exact(update.represented())), 1e-5);
        for (int frame = 0; frame < 10; ++frame)
            update.update(direct, options(mode, 30));
        EXPECT_LT(relative_distance(update.indirect(), exact(direct)), 1e-5);
    }
}

// The claim of the paper (its figure 7), in the error of X over whole paths.
TEST(IncrementalUpdate, ThirtyCoefficientsPerBandAreAsAccurateAsAHundredFresh) {
    for (const testing::LightPath& path : light_paths(120)) {
        IncrementalUpdate banded(coloured_room().transport.space, propagation());
        IncrementalUpdate fresh(coloured_room().transport.space, propagation());
        const PackedField start = coloured_room().lamp_at(path[0]);
        banded.update(start, options(UpdateMode::per_band, 0));
        double banded_squares = 0, fresh_squares = 0;
        for (const Vec3& place : path) {
            const PackedField direct = coloured_room().lamp_at(place);
            const PackedField truth = exact(direct);
            banded.update(direct, options(UpdateMode::per_band, 30));
            fresh.update(direct, options(UpdateMode::fresh, 100));
            banded_squares += std::pow(relative_distance(banded.indirect(), truth), 2);
            fresh_squares += std::pow(relative_distance(fresh.indirect(), truth), 2);
        }
        EXPECT_LE(std::sqrt(banded_squares), std::sqrt(fresh_squares));
    }
}

}  // namespace
}  // namespace lightwell
