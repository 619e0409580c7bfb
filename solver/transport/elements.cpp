#include "solver/transport/elements.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "radiance4d/basis/direction_map.h"

namespace lightwell {

namespace {

/// Whether any quad reaches in front of the plane of `side`.
bool has_company(const Quad& side, const std::vector<SceneQuad>& quads) {
    const Vec3 n = side.normal();
    const double height = n.dot(side.vertex[0]);
    const double tolerance = 1e-9 * (side.vertex[2] - side.vertex[0]).norm();
    for (const SceneQuad& other : quads)
        for (const Vec3& corner : other.quad.vertex)
            if (n.dot(corner) - height > tolerance) return true;
    return false;
}

/// Every back that some light would reach.
std::vector<char> lit_backs(const std::vector<Vec3>& positions, const Visibility& visibility,
                            OracleCost& cost) {
    constexpr int looks = 256;
    std::vector<char> seen(static_cast<std::size_t>(visibility.quad_count()), 0);
    for (const Vec3& position : positions) {
        for (int k = 0; k < looks; ++k) {
            const Hit hit = visibility.nearest(position, free_point, spiral_direction(k, looks));
            if (hit && !hit.front) seen[static_cast<std::size_t>(hit.quad)] = 1;
        }
    }
    cost.rays += positions.size() * looks;
    return seen;
}

/// Whether light that has been reflected up to `reflections` times falls on a side: walks from it
/// as light would come, and looks from where the walks are to the nearest places where a light can
/// be.
bool sees_light(const Element& element, int reflections, const std::vector<Quad>& quads,
                const std::vector<Vec3>& positions, const Visibility& visibility,
                std::uint64_t& rays) {
    constexpr int walks = 256;
    constexpr std::size_t nearest = 8;
    std::vector<Vec3> places = positions;
    const std::size_t tried = std::min(nearest, places.size());
    for (int k = 0; k < walks; ++k) {
        SurveyRay ray(element, k);
        int from = element.quad;
        for (int r = 0; r < reflections; ++r) {
            const Hit hit = visibility.nearest(ray.origin, from, ray.direction);
            ++rays;
            if (!hit) break;
            const Vec3 met = ray.origin + hit.distance * ray.direction;
            const Quad& front = quads[static_cast<std::size_t>(hit.quad)];
            const Quad side = hit.front ? front : front.reversed();
            const Vec3 normal = side.normal();
            std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(tried),
                              places.end(), [&](const Vec3& a, const Vec3& b) {
                                  return (a - met).squaredNorm() < (b - met).squaredNorm();
                              });
            rays += tried;
            for (std::size_t p = 0; p < tried; ++p)
                if (normal.dot(places[p] - met) > 0 &&
                    !visibility.occluded(met, hit.quad, places[p], free_point))
                    return true;
            ray = SurveyRay(met, side, k + (r + 1) * walks);
            from = hit.quad;
        }
    }
    return false;
}

}  // namespace

std::vector<Element> seeing_elements(const Scene& scene, std::uint64_t& blind) {
    std::vector<Element> elements;
    blind = 0;
    for (std::size_t q = 0; q < scene.quads.size(); ++q) {
        const Material& material = scene.material_of(static_cast<int>(q));
        for (const bool front : {true, false}) {
            if (!front && material.reflecting == Sides::front && material.emitting == Sides::front)
                continue;
            Element element;
            element.quad = static_cast<int>(q);
            element.front = front;
            element.geometry = front ? scene.quads[q].quad : scene.quads[q].quad.reversed();
            if (!has_company(element.geometry, scene.quads)) {
                ++blind;
                continue;
            }
            element.space = HaarBasis(element.geometry, CellTree());
            elements.push_back(std::move(element));
        }
    }
    return elements;
}

std::uint64_t drop_inside_of_solids(const std::vector<Quad>& quads,
                                    const std::vector<Vec3>& positions,
                                    const Visibility& visibility, OracleCost& cost,
                                    std::vector<Element>& elements,
                                    std::vector<SideSurvey>& survey) {
    // Many walls of one room seen from outside are backs: a second look is enough. What sees the
    // floor that a box without a bottom stands on is found out by longer walks.
    constexpr double mostly = 0.6;
    constexpr int long_walk = 8;
    if (positions.empty()) return 0;
    const std::vector<char> is_lit = lit_backs(positions, visibility, cost);
    std::vector<char> inside(elements.size());
    std::atomic<std::uint64_t> rays{0};
    tbb::parallel_for(std::size_t{0}, elements.size(), [&](std::size_t e) {
        std::uint64_t own_rays = 0;
        inside[e] = !elements[e].front && survey[e].escaped == 0 && survey[e].backs > 0 &&
                    is_lit[static_cast<std::size_t>(elements[e].quad)] == 0 &&
                    !sees_light(elements[e], survey[e].backs >= mostly ? 1 : long_walk, quads,
                                positions, visibility, own_rays);
        rays += own_rays;
    });
    cost.rays += rays;
    std::vector<Element> kept;
    std::vector<SideSurvey> kept_survey;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        if (inside[e]) continue;
        kept.push_back(std::move(elements[e]));
        kept_survey.push_back(survey[e]);
    }
    const std::uint64_t dropped = elements.size() - kept.size();
    elements = std::move(kept);
    survey = std::move(kept_survey);
    return dropped;
}

void set_cells(std::vector<Element>& elements, double cell_size, int most_levels) {
    for (Element& element : elements) {
        const std::array<Vec3, 4>& p = element.geometry.vertex;
        const double along_u = std::max((p[1] - p[0]).norm(), (p[2] - p[3]).norm());
        const double along_v = std::max((p[3] - p[0]).norm(), (p[2] - p[1]).norm());
        element.space =
            HaarBasis(element.geometry, tree_for_extents(along_u, along_v, cell_size, most_levels));
    }
}

double typical_distance(const std::vector<Element>& elements,
                        const std::vector<SideSurvey>& survey) {
    std::vector<std::pair<double, double>> by_distance;
    double area = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
        if (!(survey[e].distance > 0)) continue;
        by_distance.emplace_back(survey[e].distance, elements[e].area());
        area += elements[e].area();
    }
    std::sort(by_distance.begin(), by_distance.end());
    double up_to = 0;
    for (const auto& [distance, a] : by_distance) {
        up_to += a;
        if (up_to >= 0.5 * area) return distance;
    }
    return 0;
}

}  // namespace lightwell
