#include "solver/reading/wall_cutting.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "solver/reading/quad_contact.h"
#include "tests/unit/reference/rooms.h"

namespace lightwell {
namespace {

const Vec3 size(8, 4, 3);

/// A box of one quad a wall, 8 x 4 x 3 m.
Scene hall() {
    std::array<Rgb, 6> reflectance;
    reflectance.fill(Rgb::Constant(0.5));
    Scene scene = box_scene(size, reflectance);
    for (int wall = 0; wall < 6; ++wall)
        scene.quads[static_cast<std::size_t>(wall)].line = 10 + wall;
    return scene;
}

/// An upright wall without thickness from floor to ceiling.
Quad upright(const Vec2& from, const Vec2& to, double height = size[2]) {
    return {{Vec3(from[0], from[1], 0), Vec3(to[0], to[1], 0), Vec3(to[0], to[1], height),
             Vec3(from[0], from[1], height)}};
}

void add_wall(Scene& scene, const Vec2& from, const Vec2& to, double height = size[2]) {
    add_quad(scene, upright(from, to, height), Rgb::Constant(0.5));
}

/// The pieces of the quad with this line of the file.
std::vector<Quad> pieces_of(const CutAlongWalls& cut, int line) {
    std::vector<Quad> pieces;
    for (const SceneQuad& quad : cut.quads)
        if (quad.line == line) pieces.push_back(quad.quad);
    return pieces;
}

std::vector<Quad> floor_pieces(const Scene& scene, const WallCutRule& rule = {}) {
    return pieces_of(cut_along_walls(scene.quads, rule), 10 + Wall::floor_z0);
}

double area_of(const std::vector<Quad>& quads) {
    double area = 0;
    for (const Quad& quad : quads)
        area += quad.area();
    return area;
}

/// Pieces must make up the whole without overlap, be convex and planar, and face as it does.
void expect_to_tile(const std::vector<Quad>& pieces, const Quad& whole) {
    EXPECT_NEAR(area_of(pieces), whole.area(), 1e-12 * whole.area());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto& v = pieces[i].vertex;
        EXPECT_LT(pieces[i].out_of_plane(), 1e-12);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_TRUE(lies_on(v[k], whole, 1e-12));
            const Vec3 turning = (v[(k + 1) % 4] - v[k]).cross(v[(k + 2) % 4] - v[(k + 1) % 4]);
            EXPECT_GT(turning.dot(whole.normal()), 0);
        }
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_EQ(contact_of(pieces[i], pieces[j], 1e-9), Contact::none);
    }
}

/// Corners that lie in one place must be the same to the last bit.
void expect_no_cracks(const std::vector<Quad>& pieces) {
    for (const Quad& a : pieces)
        for (const Quad& b : pieces)
            for (const Vec3& p : a.vertex)
                for (const Vec3& q : b.vertex)
                    EXPECT_TRUE(p == q || (p - q).norm() > 1e-3) << (p - q).transpose();
}

/// Whether some side of a piece runs along x = `x`, as all that is needed of it.
bool has_border_at_x(const std::vector<Quad>& pieces, double x) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const Quad& piece) {
        int corners = 0;
        for (const Vec3& corner : piece.vertex)
            if (std::abs(corner[0] - x) < 1e-12) ++corners;
        return corners == 2;
    });
}

TEST(WallCutting, CutsWhatAWallWithoutThicknessStandsOn) {
    Scene scene = hall();
    add_wall(scene, {3.3, 0}, {3.3, 4});
    const CutAlongWalls cut = cut_along_walls(scene.quads);
    // Floor, ceiling and both long walls in two; the short walls and the new one stay.
    EXPECT_EQ(cut.cut, 4);
    EXPECT_EQ(cut.pieces, 8);
    EXPECT_EQ(cut.quads.size(), 11u);
    EXPECT_EQ(cut.unfinished.count(), 0);
    for (int wall = 0; wall < 6; ++wall) {
        const SceneQuad& whole = scene.quads[static_cast<std::size_t>(wall)];
        const std::vector<Quad> pieces = pieces_of(cut, whole.line);
        EXPECT_EQ(pieces.size(), wall == Wall::x0 || wall == Wall::x1 ? 1u : 2u);
        expect_to_tile(pieces, whole.quad);
        if (pieces.size() == 2) {
            EXPECT_TRUE(has_border_at_x(pieces, 3.3));
        }
    }
    for (const SceneQuad& quad : cut.quads)
        if (quad.line > 0) {
            EXPECT_EQ(quad.material, quad.line - 10);
        }
}

TEST(WallCutting, CutsBelowBothFacesOfAThickWall) {
    Scene scene = hall();
    add_block(scene, {3.3, 0, 0}, {3.4, 4, 3}, Rgb::Constant(0.5));
    const std::vector<Quad> pieces = floor_pieces(scene);
    ASSERT_EQ(pieces.size(), 3u);
    expect_to_tile(pieces, scene.quads[Wall::floor_z0].quad);
    EXPECT_TRUE(has_border_at_x(pieces, 3.3));
    EXPECT_TRUE(has_border_at_x(pieces, 3.4));
}

TEST(WallCutting, CutsAlongWallsThatGoThrough) {
    Scene scene = hall();
    add_quad(scene, {{Vec3(3, -1, -1), Vec3(3, 5, -1), Vec3(3, 5, 4), Vec3(3, -1, 4)}},
             Rgb::Constant(0.5));
    const CutAlongWalls cut = cut_along_walls(scene.quads);
    EXPECT_EQ(pieces_of(cut, 10 + Wall::floor_z0).size(), 2u);
    EXPECT_EQ(pieces_of(cut, 10 + Wall::y1).size(), 2u);
    // Floor, ceiling and long walls go through the wall, too: it is cut into what is in the hall,
    // below it and above it, and two strips beside it.
    EXPECT_EQ(cut.quads.size(), 2u + 4 * 2 + 5);
}

TEST(WallCutting, LeavesTheFloorBelowFurniture) {
    Scene scene = hall();
    add_block(scene, {3, 1.1, 0}, {4, 2.9, 1}, Rgb::Constant(0.5));  // 1.8 m of 4 m
    const CutAlongWalls cut = cut_along_walls(scene.quads);
    EXPECT_EQ(cut.cut, 0);
    ASSERT_EQ(cut.quads.size(), scene.quads.size());
    for (std::size_t i = 0; i < scene.quads.size(); ++i)
        EXPECT_EQ(cut.quads[i].quad.vertex, scene.quads[i].quad.vertex);
}

TEST(WallCutting, LeavesWhatIsSmallAgainstTheScene) {
    Scene scene = hall();
    // A board of 1 % of all area on a panel as wide as it is.
    add_quad(scene, {{Vec3(1, 1, 1), Vec3(2, 1, 1), Vec3(2, 2, 1), Vec3(1, 2, 1)}},
             Rgb::Constant(0.5));
    scene.quads.back().line = 50;
    add_wall(scene, {1.5, 1}, {1.5, 2}, 1);
    EXPECT_EQ(cut_along_walls(scene.quads).cut, 0);
    WallCutRule small;
    small.least_area = 0.001;
    EXPECT_EQ(pieces_of(cut_along_walls(scene.quads, small), 50).size(), 2u);
}

TEST(WallCutting, CutsAcrossADoor) {
    for (const double half : {1.4, 0.9}) {  // of 4 m: a door of 1.2 m, and an opening of 2.2 m
        Scene scene = hall();
        add_wall(scene, {3, 0}, {3, half});
        add_wall(scene, {3, 4 - half}, {3, 4});
        EXPECT_EQ(floor_pieces(scene).size(), half > 1 ? 2u : 1u) << half;
    }
}

TEST(WallCutting, CutsPiecesWithCornersInTheSamePlaces) {
    Scene scene = hall();
    add_wall(scene, {3.1, 0}, {3.1, 4});
    // A wall that goes through the first, in line but for the last digit of a file, and one that
    // ends there.
    add_wall(scene, {0, 1.3}, {3.1, 1.3});
    add_wall(scene, {3.1, 1.300001}, {8, 1.300001});
    add_wall(scene, {3.1, 2.7}, {8, 2.7});
    const std::vector<Quad> pieces = floor_pieces(scene);
    EXPECT_EQ(pieces.size(), 5u);
    expect_to_tile(pieces, scene.quads[Wall::floor_z0].quad);
    expect_no_cracks(pieces);
}

TEST(WallCutting, TakesTheLineWithTheLargestShareOfWallFirst) {
    // The second wall ends at the first, which goes from side to side: three pieces. If the second
    // came first, it would cut what lies beyond the first, too.
    for (const bool along_first_side : {false, true}) {
        Scene scene = hall();
        add_wall(scene, along_first_side ? Vec2(5, 0) : Vec2(0, 2.1),
                 along_first_side ? Vec2(5, 4) : Vec2(8, 2.1));
        add_wall(scene, along_first_side ? Vec2(0, 2) : Vec2(3, 0),
                 along_first_side ? Vec2(5, 2) : Vec2(3, 2.1));
        const std::vector<Quad> pieces = floor_pieces(scene);
        EXPECT_EQ(pieces.size(), 3u);
        expect_to_tile(pieces, scene.quads[Wall::floor_z0].quad);
    }
}

TEST(WallCutting, CountsWallsThatStandInOnePlaceOnce) {
    Scene scene = hall();
    add_wall(scene, {3, 0}, {3, 1.5});
    add_wall(scene, {3, 0.5}, {3, 1.7});
    add_wall(scene, {3, 0}, {3, 1.5});
    EXPECT_EQ(floor_pieces(scene).size(), 1u);
    add_wall(scene, {3, 1.7}, {3, 2.1});
    EXPECT_EQ(floor_pieces(scene).size(), 2u);
}

TEST(WallCutting, FindsPlasterThatIsNotQuiteInLine) {
    // The wall on one side of the crossing stands 2 mm beside the one on the other.
    Scene scene = hall();
    add_wall(scene, {3.1, 0}, {3.1, 1.5});
    add_wall(scene, {3.102, 1.5}, {3.102, 4});
    const std::vector<Quad> pieces = floor_pieces(scene);
    EXPECT_EQ(pieces.size(), 2u);
    EXPECT_TRUE(has_border_at_x(pieces, 3.102));
    expect_to_tile(pieces, scene.quads[Wall::floor_z0].quad);
}

TEST(WallCutting, CutsRoomsInACornerOfAHall) {
    // A long wall and, in the larger part, a room whose walls are less than half as long.
    Scene scene = hall();
    add_wall(scene, {2, 0}, {2, 4});
    add_wall(scene, {2, 1.5}, {4, 1.5});
    add_wall(scene, {4, 0}, {4, 1.5});
    const std::vector<Quad> pieces = floor_pieces(scene);
    EXPECT_EQ(pieces.size(), 4u);
    expect_to_tile(pieces, scene.quads[Wall::floor_z0].quad);
    EXPECT_TRUE(has_border_at_x(pieces, 4));
    // The hall as a whole is not cut along the room alone.
    scene.quads.erase(scene.quads.begin() + 6);
    EXPECT_EQ(floor_pieces(scene).size(), 1u);
}

TEST(WallCutting, DoesNotDependOnHowTheSceneIsTurned) {
    const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
    Scene straight = hall(), turned = hall();
    for (Scene* scene : {&straight, &turned}) {
        add_wall(*scene, {3.3, 0}, {3.3, 4});
        add_block(*scene, {3.3, 1.9, 0}, {8, 2, 3}, Rgb::Constant(0.5));
    }
    for (SceneQuad& quad : turned.quads)
        for (Vec3& corner : quad.quad.vertex)
            corner = turn * corner + Vec3(10, -20, 5);
    const auto areas = [](const std::vector<Quad>& pieces) {
        std::vector<double> sorted;
        for (const Quad& piece : pieces)
            sorted.push_back(piece.area());
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    };
    const std::vector<Quad> found = floor_pieces(turned);
    expect_to_tile(found, turned.quads[Wall::floor_z0].quad);
    const std::vector<double> expected = areas(floor_pieces(straight)), reached = areas(found);
    ASSERT_EQ(expected.size(), 4u);
    ASSERT_EQ(reached.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(reached[i], expected[i], 1e-9);
}

TEST(WallCutting, CutsATrapezoid) {
    const Quad trapezoid{{Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(8, 6, 0), Vec3(0, 6, 0)}};
    Scene scene;
    add_quad(scene, trapezoid, Rgb::Constant(0.5)).name = "floor";
    scene.quads[0].line = 10 + Wall::floor_z0;
    add_wall(scene, {4, 0}, {4, 6});
    add_wall(scene, {0, 3}, {9, 3});
    const std::vector<Quad> pieces = floor_pieces(scene);
    EXPECT_EQ(pieces.size(), 4u);
    expect_to_tile(pieces, trapezoid);
    expect_no_cracks(pieces);
}

TEST(WallCutting, MakesNothingLikeATriangle) {
    struct Slant {
        double from, to;  ///< x of the wall's ends at y = 0 and y = 4
        std::size_t pieces;
    };
    for (const Slant& slant : {Slant{0.1, 7.9, 1}, Slant{0.8, 0.05, 1}, Slant{7.2, 7.95, 1},
                               Slant{2, 6, 2}, Slant{6, 2, 2}}) {
        Scene scene = hall();
        add_wall(scene, {slant.from, 0}, {slant.to, 4});
        const std::vector<Quad> pieces = floor_pieces(scene);
        EXPECT_EQ(pieces.size(), slant.pieces) << slant.from;
        expect_to_tile(pieces, scene.quads[Wall::floor_z0].quad);
    }
}

TEST(WallCutting, MakesNoPieceThinnerThanItSays) {
    Scene scene = hall();
    add_wall(scene, {0.004, 0}, {0.004, 4});  // the diagonal of the floor is 8.9 m
    EXPECT_EQ(floor_pieces(scene).size(), 1u);
    add_wall(scene, {0.006, 0}, {0.006, 4});
    EXPECT_EQ(floor_pieces(scene).size(), 2u);
}

TEST(WallCutting, StopsAtTheBoundAndSaysSo) {
    Scene scene = hall();
    for (int i = 1; i < 20; ++i)
        add_wall(scene, {0.4 * i, 0}, {0.4 * i, 4});
    WallCutRule rule;
    rule.most_pieces = 20;
    const CutAlongWalls all = cut_along_walls(scene.quads, rule);
    EXPECT_EQ(pieces_of(all, 10 + Wall::floor_z0).size(), 20u);
    EXPECT_EQ(all.unfinished.count(), 0);
    rule.most_pieces = 19;
    const CutAlongWalls some = cut_along_walls(scene.quads, rule);
    const std::vector<Quad> pieces = pieces_of(some, 10 + Wall::floor_z0);
    EXPECT_EQ(pieces.size(), 19u);
    expect_to_tile(pieces, scene.quads[Wall::floor_z0].quad);
    EXPECT_EQ(some.unfinished.count(), 4);  // floor, ceiling and the two long walls
}

}  // namespace
}  // namespace lightwell
