#include "tests/unit/projection/lit_rooms.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "radiance4d/operator/light_projection.h"
#include "tests/unit/drawing/room_with_blocks.h"

namespace lightwell::testing {

RadianceField LitRoom::truth(const std::vector<Light>& lights) const {
    return projected_lights(space, lights, quads, occluders);
}

double LitRoom::flux(std::size_t element, const RadianceField& field) const {
    const Element& e = space.element(element);
    return M_PI * std::sqrt(e.area()) * field(e.first, 0);
}

double LitRoom::total_flux(const RadianceField& field) const {
    return lightwell::total_flux(space, field)[0];
}

PackedField LitRoom::darkness() const {
    return PackedField::Zero(4, space.functions());
}

LitRoom lit_room(const std::vector<Quad>& quads, double cell) {
    std::vector<Element> elements;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const Quad& quad = quads[q];
        Element element;
        element.quad = static_cast<int>(q);
        element.geometry = quad;
        element.set_space(tree_for_extents((quad.vertex[1] - quad.vertex[0]).norm(),
                                           (quad.vertex[3] - quad.vertex[0]).norm(), cell, 8),
                          {});
        elements.push_back(element);
    }
    return {quads, RadianceSpace(elements), OccluderTree(quads)};
}

LitRoom closed_room(double cell) {
    return lit_room(room_with_blocks(), cell);
}

std::vector<Vec3> places_in_closed_room(int anywhere) {
    std::vector<Vec3> places;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0.02, 0.98);
    while (static_cast<int>(places.size()) < anywhere) {
        const Vec3 place(3 * uniform(random), 4 * uniform(random), 2.5 * uniform(random));
        const bool is_beside_blocks = (place - Vec3(0.9, 2.6, place[2])).norm() > 0.7 &&
                                      (place - Vec3(2.1, 1.9, place[2])).norm() > 0.6;
        if (is_beside_blocks) places.push_back(place);
    }
    const double near = 1e-3;
    for (const Vec3& place :
         {Vec3(near, 1.3, 1.1), Vec3(3 - near, 0.7, 1.9), Vec3(1.4, near, 0.5),
          Vec3(2.2, 4 - near, 1.2), Vec3(0.8, 0.9, near), Vec3(1.7, 2.8, 2.5 - near)})
        places.push_back(place);
    return places;
}

PointLight lamp(const Vec3& position) {
    return {"lamp", position, Rgb(100, 60, 30)};
}

SpotLight spot(const Vec3& position, const Vec3& direction, double inner, double outer) {
    return {"spot", position, Rgb(100, 60, 30), direction.normalized(), inner, outer};
}

void expect_same_flux(const LitRoom& room, const RadianceField& field, const RadianceField& truth,
                      double relative, double of_total, const std::string& name, double least) {
    const double total = room.total_flux(truth);
    EXPECT_NEAR(room.total_flux(field), total, of_total * total) << name;
    for (std::size_t e = 0; e < room.space.elements().size(); ++e) {
        const double expected = room.flux(e, truth);
        if (expected > least * total)
            EXPECT_NEAR(room.flux(e, field), expected, relative * expected)
                << name << ", element " << e;
        else
            EXPECT_NEAR(room.flux(e, field), expected, std::max(1e-5, 2 * relative * least) * total)
                << name << ", element " << e;
    }
}

Flicker flicker_of(const LitRoom& room, LightProjection& projection, int frames) {
    PackedField direct = room.darkness();
    const std::size_t elements = room.space.elements().size();
    std::vector<std::vector<double>> error(elements);
    for (int frame = 0; frame < frames; ++frame) {
        const std::vector<Light> light = {
            lamp(Vec3(0.4 + 0.008 * frame, 0.5 + 0.006 * frame, 2.1 - 0.001 * frame))};
        projection.project(light, direct);
        const RadianceField field = unpacked(direct), truth = room.truth(light);
        for (std::size_t e = 0; e < elements; ++e) {
            const double wanted = room.flux(e, truth);
            const bool counts = wanted > 1e-3 * room.total_flux(truth);
            error[e].push_back(counts ? room.flux(e, field) / wanted - 1 : 0);
        }
    }
    Flicker flicker;
    for (const std::vector<double>& of : error) {
        double squares = 0;
        for (std::size_t f = 1; f < of.size(); ++f) {
            flicker.largest_step = std::max(flicker.largest_step, std::abs(of[f] - of[f - 1]));
            if (f > 1) squares += std::pow(of[f] - 2 * of[f - 1] + of[f - 2], 2);
        }
        flicker.second_difference =
            std::max(flicker.second_difference, std::sqrt(squares / frames));
    }
    return flicker;
}

}  // namespace lightwell::testing
