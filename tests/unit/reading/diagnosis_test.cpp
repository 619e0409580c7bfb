#include "solver/reading/diagnosis.h"

#include <chrono>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "solver/reading/quad_contact.h"
#include "solver/reading/surface_mesh.h"

namespace lightwell {
namespace {

class SceneMaker {
  public:
    SceneMaker() { scene.materials.emplace_back(); }
    SceneMaker& quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        scene.quads.push_back({Quad{{a, b, c, d}}, 0, static_cast<int>(scene.quads.size()), 0});
        return *this;
    }
    /// An axis-parallel box that faces outwards: bottom, top, then the four walls.
    SceneMaker& box(const Vec3& low, const Vec3& size) {
        const auto at = [&](int x, int y, int z) {
            return Vec3(low + Vec3(x, y, z).cwiseProduct(size));
        };
        quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
        quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
        quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
        quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
        quad(at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1));
        return quad(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1));
    }
    Scene scene;
};

/// Counts in the order of Defect.
std::vector<int> counts(const Diagnosis& diagnosis) {
    std::vector<int> counts;
    for (const Finding& finding : diagnosis.findings)
        counts.push_back(finding.count);
    return counts;
}

TEST(Diagnosis, FindsNothingWrongWithAClosedBox) {
    const Diagnosis found = diagnose(SceneMaker().box({0, 0, 0}, {1, 2, 3}).scene);
    EXPECT_EQ(counts(found), std::vector<int>(8, 0));
    EXPECT_EQ(found.surfaces, 1);
    EXPECT_EQ(found.closed_surfaces, 1);
    EXPECT_TRUE(found.complete);
}

TEST(Diagnosis, FindsOpenEdgesRoundAMissingFace) {
    SceneMaker maker;
    maker.box({0, 0, 0}, {1, 1, 1});
    maker.scene.quads.erase(maker.scene.quads.begin() + 1);
    const Diagnosis found = diagnose(maker.scene);
    EXPECT_EQ(counts(found), (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 4}));
    EXPECT_TRUE(found.of(Defect::open_edge).matters);
    EXPECT_EQ(found.closed_surfaces, 0);
}

TEST(Diagnosis, FindsTheFlippedFaceOfABox) {
    SceneMaker maker;
    maker.box({0, 0, 0}, {1, 1, 1});
    maker.scene.quads[3].quad = maker.scene.quads[3].quad.reversed();
    Diagnosis found = diagnose(maker.scene);
    EXPECT_EQ(counts(found), (std::vector<int>{0, 0, 0, 0, 0, 1, 0, 0}));
    EXPECT_EQ(found.of(Defect::flipped).examples, std::vector<int>{3});
    EXPECT_FALSE(found.of(Defect::flipped).matters);
    EXPECT_EQ(found.closed_surfaces, 1);
    // A back that does not reflect makes it matter.
    maker.scene.materials[0].reflecting = Sides::front;
    EXPECT_TRUE(diagnose(maker.scene).of(Defect::flipped).matters);
}

TEST(Diagnosis, TellsOverlapsThatFaceTheSameWayFromABoxOnTheFloor) {
    SceneMaker maker;
    maker.quad({-1, -1, 0}, {3, -1, 0}, {3, 3, 0}, {-1, 3, 0}).box({0, 0, 0}, {1, 1, 1});
    Diagnosis found = diagnose(maker.scene);
    EXPECT_EQ(found.of(Defect::overlapping).count, 1);
    EXPECT_FALSE(found.of(Defect::overlapping).matters);
    EXPECT_EQ(found.of(Defect::interpenetrating).count, 0);
    maker.quad({0.5, 0.5, 1}, {2, 0.5, 1}, {2, 2, 1}, {0.5, 2, 1});
    found = diagnose(maker.scene);
    EXPECT_EQ(found.of(Defect::overlapping).count, 2);
    EXPECT_TRUE(found.of(Defect::overlapping).matters);
}

TEST(Diagnosis, TellsCrossingFromStandingOnAQuad) {
    const Vec3 floor[] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    const auto with_wall = [&](double low) {
        SceneMaker maker;
        maker.quad(floor[0], floor[1], floor[2], floor[3]);
        maker.quad({0.5, 1, low}, {1.5, 1, low}, {1.5, 1, 1}, {0.5, 1, 1});
        return diagnose(maker.scene);
    };
    // Of the wall that stands on the floor, three sides are open; of the floor, four.
    EXPECT_EQ(counts(with_wall(0)), (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 7}));
    EXPECT_EQ(counts(with_wall(-0.1)), (std::vector<int>{0, 0, 0, 0, 1, 0, 0, 8}));
    // Less than a millionth of the scene's diagonal is rounding.
    EXPECT_EQ(counts(with_wall(-1e-6)), counts(with_wall(0)));
    EXPECT_EQ(counts(with_wall(0.1)), (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 8}));
}

TEST(Diagnosis, FindsTVerticesWhereNothingIsOpen) {
    // Two quads beside a longer one: one vertex lies inside its side, and no side is open between.
    SceneMaker maker;
    maker.quad({0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0});
    maker.quad({0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0});
    maker.quad({1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0});
    const Diagnosis found = diagnose(maker.scene);
    EXPECT_EQ(counts(found), (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 7}));
    EXPECT_FALSE(found.of(Defect::t_vertex).matters);
}

TEST(Diagnosis, FindsDuplicatesDegenerateAndBentQuads) {
    SceneMaker maker;
    maker.box({0, 0, 0}, {1, 1, 1});
    maker.scene.quads.push_back(maker.scene.quads[2]);
    maker.scene.quads.back().quad = maker.scene.quads.back().quad.reversed();
    maker.quad({0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0});
    maker.quad({5, 0, 0}, {6, 0, 0}, {6, 1, 0.1}, {5, 1, 0});
    const Diagnosis found = diagnose(maker.scene);
    EXPECT_EQ(found.of(Defect::duplicate).examples, std::vector<int>{6});
    EXPECT_EQ(found.of(Defect::degenerate).examples, std::vector<int>{7});
    EXPECT_EQ(found.of(Defect::bent).examples, std::vector<int>{8});
    EXPECT_EQ(found.of(Defect::flipped).count, 0);
    EXPECT_EQ(found.closed_surfaces, 1);
}

TEST(Diagnosis, WeldsCornersThatDifferInTheLastDigits) {
    SceneMaker maker;
    maker.box({0, 0, 0}, {1, 1, 1});
    for (SceneQuad& quad : maker.scene.quads)
        for (std::size_t i = 0; i < 4; ++i)
            quad.quad.vertex[i] += Vec3(3e-8, -4e-8, 2e-8) * static_cast<double>(quad.face + 1);
    EXPECT_EQ(counts(diagnose(maker.scene)), std::vector<int>(8, 0));
}

TEST(Diagnosis, SurvivesSidesOfManyQuadsAndMoebiusStrips) {
    SceneMaker fan;
    for (int i = 0; i < 5; ++i) {
        const double angle = 2 * M_PI * i / 5;
        const Vec3 out(std::cos(angle), std::sin(angle), 0);
        fan.quad({0, 0, 0}, out, out + Vec3::UnitZ(), {0, 0, 1});
    }
    EXPECT_EQ(counts(diagnose(fan.scene)), (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 15}));

    SceneMaker strip;
    constexpr int parts = 12;
    const auto rim = [&](int i, double side) {
        const double around = 2 * M_PI * i / parts, tilt = around / 2;
        const double r = 3 + side * std::cos(tilt);
        return Vec3(r * std::cos(around), r * std::sin(around), side * std::sin(tilt));
    };
    for (int i = 0; i < parts; ++i)
        strip.quad(rim(i, -1), rim(i + 1, -1), rim(i + 1, 1), rim(i, 1));
    const Diagnosis found = diagnose(strip.scene);
    EXPECT_EQ(found.of(Defect::open_edge).count, 2 * parts);
    EXPECT_EQ(found.surfaces, 1);
}

TEST(Diagnosis, SurvivesTangles) {
    // Quads between few places: sides of many quads, vertices of many fans, folded quads.
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round) {
        SceneMaker maker;
        const auto corner = [&] {
            return Vec3(static_cast<double>(random() % 3), static_cast<double>(random() % 3),
                        static_cast<double>(random() % 2));
        };
        for (int i = 0; i < 30; ++i) {
            const Vec3 a = corner(), b = corner(), c = corner(), d = corner();
            maker.quad(a, b, c, d);
        }
        const Diagnosis found = diagnose(maker.scene);
        EXPECT_TRUE(found.complete);
    }
}

TEST(Diagnosis, StopsWhenQuadsTouchTooOften) {
    SceneMaker maker;
    for (int i = 0; i < 500; ++i) {
        const double angle = M_PI * i / 500;
        const Vec3 out(std::cos(angle), std::sin(angle), 0);
        maker.quad(-out, out, out + Vec3::UnitZ(), Vec3::UnitZ() - out);
    }
    DiagnosisRule rule;
    rule.most_tests = 1000;
    EXPECT_FALSE(diagnose(maker.scene, rule).complete);
    const Diagnosis found = diagnose(maker.scene);
    EXPECT_TRUE(found.complete);
    EXPECT_EQ(found.of(Defect::interpenetrating).count, 500 * 499 / 2);
}

TEST(Diagnosis, TakesSecondsForTensOfThousandsOfQuads) {
    // A field of 8,000 boxes side by side: 48,000 quads, the walls between them twice.
#ifdef __SANITIZE_ADDRESS__
    constexpr int rows = 8;
#else
    constexpr int rows = 80;
#endif
    SceneMaker maker;
    for (int x = 0; x < 100; ++x)
        for (int y = 0; y < rows; ++y)
            maker.box(Vec3(x, y, 0), {1, 1, 1});
    const auto start = std::chrono::steady_clock::now();
    const Diagnosis found = diagnose(maker.scene);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(found.of(Defect::duplicate).count, 99 * rows + 100 * (rows - 1));
    EXPECT_EQ(found.of(Defect::interpenetrating).count, 0);
    EXPECT_EQ(found.of(Defect::overlapping).count, 0);
    EXPECT_EQ(found.of(Defect::t_vertex).count, 0);
    EXPECT_EQ(found.of(Defect::open_edge).count, 0);
    EXPECT_LT(time.count(), 20) << "seconds";
}

TEST(Diagnosis, ExplainsItselfInLines) {
    SceneMaker maker;
    maker.box({0, 0, 0}, {1, 1, 1});
    maker.scene.quads.erase(maker.scene.quads.begin());
    maker.scene.geometry_file = "room.obj";
    const std::string text = to_string(diagnose(maker.scene), maker.scene);
    EXPECT_NE(text.find("open edges: 4 (first at quad 1"), std::string::npos) << text;
    EXPECT_NE(text.find("matters"), std::string::npos);
}

TEST(SurfaceMesh, JoinsNothingAtASideOfManyQuads) {
    std::vector<Quad> fan;
    for (int i = 0; i < 5; ++i) {
        const double angle = 2 * M_PI * i / 5;
        const Vec3 out(std::cos(angle), std::sin(angle), 0);
        fan.push_back({{Vec3::Zero(), out, out + Vec3::UnitZ(), Vec3::UnitZ()}});
    }
    const SurfaceMesh mesh = surface_mesh(weld(fan), std::vector<bool>(5, false));
    EXPECT_EQ(mesh.open_sides.size(), 15u);
    EXPECT_EQ(mesh.many_quad_sides, 1);
    EXPECT_EQ(mesh.surfaces, 5);
}

TEST(QuadContact, KnowsPointsOnAQuad) {
    const Quad quad{{Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(2, 1, 1), Vec3(0, 1, 1)}};
    EXPECT_TRUE(lies_on({1, 0.5, 1}, quad, 1e-9));
    EXPECT_TRUE(lies_on({2, 1, 1}, quad, 1e-9));
    EXPECT_FALSE(lies_on({2.001, 1, 1}, quad, 1e-9));
    EXPECT_FALSE(lies_on({1, 0.5, 1.001}, quad, 1e-9));
}

}  // namespace
}  // namespace lightwell
