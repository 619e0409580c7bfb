#include "solver/reading/copies.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

class Copies : public ::testing::Test {
  protected:
    void SetUp() override {
        // A ladder of squares, one over the other.
        for (int k = 0; k < 6; ++k)
            quads.push_back(
                {Quad{{Vec3(0, 0, k), Vec3(1, 0, k), Vec3(1, 1, k), Vec3(0, 1, k)}}, 0, k, 0});
        materials.resize(2);
        materials[0].name = "plaster";
        materials[1].name = "paint";
    }

    SceneQuad& add(std::size_t original, int turned, bool reversed) {
        SceneQuad copy = quads[original];
        std::rotate(copy.quad.vertex.begin(), copy.quad.vertex.begin() + turned,
                    copy.quad.vertex.end());
        if (reversed) copy.quad = copy.quad.reversed();
        copy.line = 77;
        quads.push_back(copy);
        return quads.back();
    }

    int leave_out() { return leave_out_copies(quads, materials, "room.obj", warnings); }
    const Material& material_of(std::size_t quad) {
        return materials[static_cast<std::size_t>(quads[quad].material)];
    }

    std::vector<SceneQuad> quads;
    std::vector<Material> materials;
    std::vector<Warning> warnings;
};

TEST_F(Copies, AreLeftOutFromWhicheverCornerTheyBegin) {
    for (int turned = 0; turned < 4; ++turned)
        add(2, turned, false);
    EXPECT_EQ(leave_out(), 4);
    EXPECT_EQ(quads.size(), 6u);
    EXPECT_EQ(materials.size(), 2u);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].to_string().rfind("room.obj:77: a copy", 0), 0u) << warnings[0].message;
}

TEST_F(Copies, OfTheOtherWayRoundMakeBothSidesReflect) {
    materials[0].reflecting = Sides::front;
    materials[0].emission = Rgb(1, 1, 1);
    for (int turned = 0; turned < 4; ++turned)
        add(static_cast<std::size_t>(turned), turned, true);
    EXPECT_EQ(leave_out(), 4);
    EXPECT_EQ(quads.size(), 6u);
    for (std::size_t quad = 0; quad < 4; ++quad) {
        EXPECT_EQ(material_of(quad).reflecting, Sides::both);
        EXPECT_EQ(material_of(quad).emitting, Sides::both);
    }
    EXPECT_EQ(material_of(4).reflecting, Sides::front);
    EXPECT_EQ(material_of(4).emitting, Sides::front);
    EXPECT_EQ(materials.size(), 3u) << "one twin is enough";
}

TEST_F(Copies, OfAnotherMaterialAreToldApart) {
    add(1, 1, true).material = 1;
    EXPECT_EQ(leave_out(), 1);
    EXPECT_EQ(material_of(1).name, "plaster");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].message.find("another material"), std::string::npos);
}

TEST_F(Copies, QuadsThatShareThreeCornersAreNone) {
    add(0, 0, false).quad.vertex[2] *= 0.9;
    EXPECT_EQ(leave_out(), 0);
    EXPECT_EQ(quads.size(), 7u);
    EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace lightwell
