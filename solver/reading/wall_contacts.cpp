#include "solver/reading/wall_contacts.h"

#include <array>
#include <cmath>

namespace lightwell {

namespace {

std::vector<Box> boxes_around(const std::vector<Quad>& quads) {
    std::vector<Box> boxes;
    boxes.reserve(quads.size());
    for (const Quad& quad : quads)
        boxes.push_back(box_around(quad));
    return boxes;
}

}  // namespace

std::optional<Segment> contact_segment(const Quad& quad, const Plane& plane, double tolerance) {
    std::array<double, 4> height{};
    for (std::size_t i = 0; i < 4; ++i) {
        height[i] = plane.height(quad.vertex[i]);
        if (std::abs(height[i]) <= tolerance) height[i] = 0;
    }
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 &p = quad.vertex[i], &q = quad.vertex[(i + 1) % 4];
        const double hp = height[i], hq = height[(i + 1) % 4];
        if (hp == 0) ends.push_back(p);
        if (hp * hq < 0) ends.push_back(p + hp / (hp - hq) * (q - p));
    }
    if (ends.size() != 2 || (ends[1] - ends[0]).norm() <= tolerance) return std::nullopt;
    return Segment{ends[0], ends[1]};
}

WallContacts::WallContacts(const std::vector<Quad>& quads, double tolerance)
    : quads_(quads), tolerance_(tolerance), tree_(boxes_around(quads)) {}

std::vector<Segment> WallContacts::on(int quad) const {
    const Quad& ground = quads_[static_cast<std::size_t>(quad)];
    const Vec3 normal = ground.normal();
    const Plane plane{normal, normal.dot(ground.centre())};
    const Vec3 margin = Vec3::Constant(tolerance_);
    const Box box = box_around(ground);
    std::vector<Segment> contacts;
    tree_.visit_meeting({box.min() - margin, box.max() + margin}, [&](int other) {
        if (other == quad) return true;
        const auto contact =
            contact_segment(quads_[static_cast<std::size_t>(other)], plane, tolerance_);
        if (contact) contacts.push_back(*contact);
        return true;
    });
    return contacts;
}

}  // namespace lightwell
