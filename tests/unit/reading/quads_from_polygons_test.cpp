#include "solver/reading/quads_from_polygons.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "solver/reading/polygon_cutting.h"
#include "solver/reading/polygon_shape.h"

namespace lightwell {
namespace {

/// A soup whose polygons have their vertices to themselves unless `corners` says otherwise.
class SoupMaker {
  public:
    SoupMaker& face(const Outline& outline, int material = -1) {
        Polygon polygon;
        polygon.first = static_cast<int>(soup.corners.size());
        polygon.count = static_cast<int>(outline.size());
        polygon.material = material;
        polygon.line = static_cast<int>(soup.polygons.size()) + 1;
        for (const Vec3& corner : outline) {
            soup.corners.push_back(static_cast<int>(soup.vertices.size()));
            soup.vertices.push_back(corner);
        }
        soup.polygons.push_back(polygon);
        return *this;
    }
    SoupMaker() { soup.file = "a.obj"; }
    PolygonSoup soup;
};

double total_area(const QuadsOfPolygons& made) {
    double area = 0;
    for (const SceneQuad& quad : made.quads)
        area += quad.quad.area();
    return area;
}

/// Every element must be planar, strictly convex and face `normal`.
void expect_sound(const QuadsOfPolygons& made, const Vec3& normal) {
    for (const SceneQuad& quad : made.quads) {
        EXPECT_LE(quad.quad.out_of_plane(), 1e-12 * std::sqrt(quad.quad.area()));
        EXPECT_GT(quad.quad.normal().dot(normal), 0.999);
        const auto& v = quad.quad.vertex;
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_GT(normal.dot((v[(i + 1) % 4] - v[i]).cross(v[(i + 2) % 4] - v[(i + 1) % 4])),
                      0);
    }
}

Outline flat(const std::vector<Vec2>& points) {
    Outline outline;
    for (const Vec2& point : points)
        outline.emplace_back(point[0], point[1], 0);
    return outline;
}

const Vec3 up = Vec3::UnitZ();

TEST(QuadsFromPolygons, KeepsConvexQuadsBitByBit) {
    const Outline trapezoid = {{0.1, 0.2, 3}, {2.3, 0.1, 3}, {1.7, 1.9, 3}, {0.4, 1.1, 3}};
    const auto made = quads_from_polygons(SoupMaker().face(trapezoid, 5).soup);
    ASSERT_EQ(made.quads.size(), 1u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(made.quads[0].quad.vertex[i], trapezoid[i]);
    EXPECT_EQ(made.quads[0].material, 5);
    EXPECT_EQ(made.quads[0].line, 1);
    EXPECT_EQ(to_string(made.counts), "1 face: 1 quad; 1 quad in all");
    EXPECT_TRUE(made.warnings.empty());
}

TEST(QuadsFromPolygons, ScalesToMetres) {
    const auto made = quads_from_polygons(
        SoupMaker().face(flat({{0, 0}, {100, 0}, {100, 100}, {0, 100}})).soup, 0.01);
    EXPECT_DOUBLE_EQ(total_area(made), 1);
}

TEST(QuadsFromPolygons, CutsALoneTriangleIntoThreeEqualParts) {
    const auto made = quads_from_polygons(SoupMaker().face(flat({{0, 0}, {3, 0}, {1, 2}})).soup);
    ASSERT_EQ(made.quads.size(), 3u);
    for (const SceneQuad& quad : made.quads)
        EXPECT_NEAR(quad.quad.area(), 1, 1e-14);
    expect_sound(made, up);
    EXPECT_EQ(to_string(made.counts),
              "1 face: 0 quads, 1 triangle; 1 triangle cut into 3 quads; 3 quads in all");
}

TEST(QuadsFromPolygons, JoinsTheTwoTrianglesOfARectangle) {
    // Vertices are repeated for each face, as exporters write them.
    const auto made = quads_from_polygons(
        SoupMaker().face(flat({{0, 0}, {3, 0}, {3, 2}})).face(flat({{0, 0}, {3, 2}, {0, 2}})).soup);
    ASSERT_EQ(made.quads.size(), 1u);
    EXPECT_DOUBLE_EQ(made.quads[0].quad.area(), 6);
    expect_sound(made, up);
    EXPECT_EQ(to_string(made.counts),
              "2 faces: 0 quads, 2 triangles; 2 triangles paired into 1 quad; 1 quad in all");
}

TEST(QuadsFromPolygons, PrefersRectanglesToParallelograms) {
    // Two squares, each cut along the same diagonal. The first two triangles are of different
    // squares and would make a parallelogram; a choice by order would join them.
    const auto lower = [](double x) { return flat({{x, 0}, {x + 1, 0}, {x + 1, 1}}); };
    const auto upper = [](double x) { return flat({{x, 0}, {x + 1, 1}, {x, 1}}); };
    SoupMaker strip;
    strip.face(lower(0)).face(upper(1)).face(upper(0)).face(lower(1));
    const auto made = quads_from_polygons(strip.soup);
    ASSERT_EQ(made.quads.size(), 2u);
    for (const SceneQuad& quad : made.quads)
        for (const double u : {0., 1.})
            EXPECT_NEAR(quad.quad.jacobian(u, 0.5), 1, 1e-15);
    expect_sound(made, up);
}

TEST(QuadsFromPolygons, DoesNotJoinAcrossMaterialsFoldsOrFlippedFaces) {
    const Outline lower = flat({{0, 0}, {1, 0}, {1, 1}});
    const Outline upper = flat({{0, 0}, {1, 1}, {0, 1}});
    const Outline flipped = flat({{0, 0}, {0, 1}, {1, 1}});
    const Outline folded = {{0, 0, 0}, {1, 1, 0}, {0, 1, 0.001}};
    const Outline concave = flat({{0, 0}, {1, 1}, {0.6, 0.7}});
    EXPECT_EQ(quads_from_polygons(SoupMaker().face(lower, 0).face(upper, 1).soup).counts.pairs, 0);
    EXPECT_EQ(quads_from_polygons(SoupMaker().face(lower).face(flipped).soup).counts.pairs, 0);
    EXPECT_EQ(quads_from_polygons(SoupMaker().face(lower).face(folded).soup).counts.pairs, 0);
    EXPECT_EQ(quads_from_polygons(SoupMaker().face(lower).face(upper).soup).counts.pairs, 1);
    // Both joined would be a triangle with a fourth corner on its side.
    const Outline collinear = flat({{0, 0}, {1, 1}, {1, 2}});
    const Outline half = flat({{1, 0}, {1, 1}, {0, 0}});
    EXPECT_EQ(quads_from_polygons(SoupMaker().face(half).face(collinear).soup).counts.pairs, 0);
    EXPECT_EQ(quads_from_polygons(SoupMaker().face(half).face(concave).soup).counts.pairs, 1);
}

TEST(QuadsFromPolygons, CutsLargerConvexPolygons) {
    for (int corners = 5; corners <= 12; ++corners) {
        Outline outline;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * M_PI * i / corners;
            outline.emplace_back(2 * std::cos(angle), std::sin(angle), 1);
        }
        const auto made = quads_from_polygons(SoupMaker().face(outline).soup);
        const int expected = (corners - 2) / 2 + (corners % 2 == 1 ? 3 : 0);
        EXPECT_EQ(made.counts.elements, expected) << corners;
        EXPECT_EQ(made.counts.larger, 1);
        EXPECT_NEAR(total_area(made), corners * std::sin(2 * M_PI / corners), 1e-12);
        expect_sound(made, up);
    }
}

TEST(QuadsFromPolygons, CutsConcavePolygonsAndPairsThePieces) {
    // An L of three unit squares.
    const auto made = quads_from_polygons(
        SoupMaker().face(flat({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})).soup);
    EXPECT_EQ(made.counts.concave, 1);
    EXPECT_NEAR(total_area(made), 3, 1e-14);
    expect_sound(made, up);
    EXPECT_GE(made.counts.pairs, 1);
    ASSERT_EQ(made.warnings.size(), 1u);
}

TEST(QuadsFromPolygons, KeepsTheAreaOfRandomStars) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.2, 1);
    for (int corners = 4; corners < 40; ++corners) {
        Outline star;
        double area = 0;
        std::vector<Vec2> points;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * M_PI * i / corners, r = radius(random);
            points.emplace_back(r * std::cos(angle), r * std::sin(angle));
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
            area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        }
        const auto made = quads_from_polygons(SoupMaker().face(flat(points)).soup);
        EXPECT_NEAR(total_area(made), area, 1e-12) << corners;
        expect_sound(made, up);
    }
}

TEST(QuadsFromPolygons, LeavesOutCornersThatDoNotShape) {
    // A rectangle with corners in the middle of its sides, one of them twice, and a whisker.
    const auto made = quads_from_polygons(
        SoupMaker()
            .face(flat({{0, 0}, {1, 0}, {1, 0}, {2, 0}, {3, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}))
            .soup);
    EXPECT_EQ(to_string(made.counts), "1 face: 1 quad; 1 quad in all");
    EXPECT_DOUBLE_EQ(total_area(made), 2);
}

TEST(QuadsFromPolygons, TakesAQuadWithARepeatedCornerAsATriangle) {
    const auto made =
        quads_from_polygons(SoupMaker().face(flat({{0, 0}, {0, 0}, {2, 0}, {0, 2}})).soup);
    EXPECT_EQ(made.counts.triangles, 1);
    EXPECT_DOUBLE_EQ(total_area(made), 2);
}

TEST(QuadsFromPolygons, LeavesOutPolygonsWithoutArea) {
    const auto made = quads_from_polygons(SoupMaker()
                                              .face(flat({{0, 0}, {1, 1}, {2, 2}}))
                                              .face(flat({{1, 1}, {1, 1}, {1, 1}, {1, 1}}))
                                              .face(flat({{0, 0}, {1, 0}}))
                                              .face({})
                                              .face(flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}}))
                                              .soup);
    EXPECT_EQ(made.counts.degenerate, 4);
    EXPECT_EQ(made.counts.elements, 1);
    ASSERT_EQ(made.warnings.size(), 1u);
    EXPECT_EQ(made.warnings[0].to_string(),
              "a.obj:1: polygon without area: left out (also at lines 2, 3, 4)");
}

TEST(QuadsFromPolygons, LeavesOutOutlinesThatCrossThemselves) {
    const auto made = quads_from_polygons(SoupMaker()
                                              .face(flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}}))
                                              .face(flat({{0, 0}, {2, 1}, {1, 0}, {0, 1}}))
                                              .soup);
    EXPECT_EQ(made.counts.crossing, 2);
    EXPECT_EQ(made.counts.elements, 0);
    // A pentagram turns left at every corner.
    std::vector<Vec2> star;
    for (int i = 0; i < 5; ++i)
        star.emplace_back(std::cos(0.8 * M_PI * i), std::sin(0.8 * M_PI * i));
    EXPECT_EQ(quads_from_polygons(SoupMaker().face(flat(star)).soup).counts.crossing, 1);
}

TEST(QuadsFromPolygons, CutsBentQuadsIntoTriangles) {
    const Outline bent = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}};
    const auto made = quads_from_polygons(SoupMaker().face(bent).soup);
    EXPECT_EQ(made.counts.bent, 1);
    EXPECT_EQ(made.counts.pairs, 0);
    ASSERT_EQ(made.counts.elements, 6);
    for (const SceneQuad& quad : made.quads)
        EXPECT_LE(quad.quad.out_of_plane(), 1e-15);
    // The shorter diagonal, from corner 1 to corner 3, leaves the rounder triangles.
    EXPECT_NEAR(total_area(made), 0.5 + 0.5 * std::sqrt(1 + 2 * 0.01), 1e-12);
}

TEST(QuadsFromPolygons, FlattensQuadsThatAreHardlyBent) {
    const double off = 1e-4;  // half of it to each side of the mean plane: below 1e-4 of 1.41
    const Outline bent = {{0, 0, 0}, {1, 0, 0}, {1, 1, off}, {0, 1, 0}};
    const auto made = quads_from_polygons(SoupMaker().face(bent).soup);
    EXPECT_EQ(made.counts.flattened, 1);
    ASSERT_EQ(made.counts.quads, 1);
    EXPECT_LT(made.quads[0].quad.out_of_plane(), 1e-16);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LE((made.quads[0].quad.vertex[i] - bent[i]).norm(), off / 2);
    ASSERT_EQ(made.warnings.size(), 1u);
}

TEST(QuadsFromPolygons, RefusesGiantPolygons) {
    SoupMaker soup;
    soup.face(Outline(most_corners + 1, Vec3::Zero()));
    EXPECT_THROW(quads_from_polygons(soup.soup), InputError);
}

TEST(QuadsFromPolygons, JudgesShapesWhateverTheScaleAndPlace) {
    const std::vector<Vec2> ell = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (const double scale : {1e-6, 1., 1e6})
        for (const double offset : {0., 1e4}) {
            Outline outline;
            for (const Vec2& p : ell)
                outline.push_back(scale * Vec3(p[0] + offset, p[1] - offset, offset));
            const auto made = quads_from_polygons(SoupMaker().face(outline).soup);
            EXPECT_EQ(made.counts.concave, 1) << scale << " " << offset;
            EXPECT_NEAR(total_area(made) / (scale * scale), 3, 1e-7);
        }
}

TEST(CutConvex, MakesTrapezoidsOfAHexagon) {
    std::vector<Vec2> hexagon;
    for (int i = 0; i < 6; ++i)
        hexagon.emplace_back(std::cos(M_PI * i / 3), std::sin(M_PI * i / 3));
    const ConvexCut cut = cut_convex(hexagon);
    ASSERT_EQ(cut.quads.size(), 2u);
    EXPECT_TRUE(cut.triangles.empty());
}

TEST(ClipEars, CoversASpiral) {
    // Ears are rare in a spiral, and most corners are reflex.
    std::vector<Vec2> spiral;
    const int turns = 200;
    for (int i = 0; i <= turns; ++i) {
        const double angle = 0.2 * i, r = 1 + 0.05 * angle;
        spiral.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    for (int i = turns; i >= 0; --i) {
        const double angle = 0.2 * i, r = 0.9 + 0.05 * angle;
        spiral.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    double doubled = 0;
    for (std::size_t i = 0; i < spiral.size(); ++i)
        doubled += turn(Vec2::Zero(), spiral[i], spiral[(i + 1) % spiral.size()]);
    if (doubled < 0) std::reverse(spiral.begin(), spiral.end());
    double covered = 0;
    for (const auto& ear : clip_ears(spiral)) {
        const auto at = [&](int i) { return spiral[static_cast<std::size_t>(i)]; };
        const double area = turn(at(ear[0]), at(ear[1]), at(ear[2]));
        EXPECT_GE(area, 0);
        covered += area;
    }
    EXPECT_NEAR(covered, std::abs(doubled), 1e-9);
}

}  // namespace
}  // namespace lightwell
