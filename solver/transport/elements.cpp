#include "solver/transport/elements.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
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

/// Walks from a side as light would come to it, which tell whether it is in the dark.
struct DarkWalks {
    bool dark = true;            ///< none came to a place that a light can reach
    std::vector<int> met_backs;  ///< quads whose backs they met, if it is
    std::uint64_t rays = 0;
};

/// @param reflections  at most on a walk
DarkWalks dark_walks(const Element& element, int reflections, const std::vector<Quad>& quads,
                     const std::vector<Vec3>& positions, const Visibility& visibility) {
    constexpr int walks = 256;
    constexpr std::size_t nearest = 8;
    std::vector<Vec3> places = positions;
    const std::size_t tried = std::min(nearest, places.size());
    DarkWalks result;
    for (int k = 0; k < walks; ++k) {
        SurveyRay ray(element, k);
        int from = element.quad;
        for (int r = 0; r < reflections; ++r) {
            const Hit hit = visibility.nearest(ray.origin, from, ray.direction);
            ++result.rays;
            if (!hit) break;
            if (!hit.front) result.met_backs.push_back(hit.quad);
            const Vec3 met = ray.origin + hit.distance * ray.direction;
            const Quad& front = quads[static_cast<std::size_t>(hit.quad)];
            const Quad side = hit.front ? front : front.reversed();
            const Vec3 normal = side.normal();
            std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(tried),
                              places.end(), [&](const Vec3& a, const Vec3& b) {
                                  return (a - met).squaredNorm() < (b - met).squaredNorm();
                              });
            result.rays += tried;
            for (std::size_t p = 0; p < tried; ++p) {
                if (normal.dot(places[p] - met) > 0 &&
                    !visibility.occluded(met, hit.quad, places[p], free_point)) {
                    result.dark = false;
                    return result;
                }
            }
            ray = SurveyRay(met, side, k + (r + 1) * walks);
            from = hit.quad;
        }
    }
    return result;
}

/// Takes back the verdict on sides in cavities of which another back is not inside of a solid:
/// where some light comes in, all of the cavity counts.
///
/// @param met_backs  by element; empty where the verdict stands
/// @param inside     by element
void keep_whole_cavities(const std::vector<Element>& elements,
                         const std::vector<std::vector<int>>& met_backs,
                         std::vector<char>& inside) {
    std::map<int, std::size_t> back_of;
    for (std::size_t e = 0; e < elements.size(); ++e)
        if (!elements[e].front) back_of[elements[e].quad] = e;
    const auto is_kept = [&](int quad) {
        const auto found = back_of.find(quad);
        return found != back_of.end() && inside[found->second] == 0;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t e = 0; e < elements.size(); ++e) {
            if (inside[e] == 0 || std::none_of(met_backs[e].begin(), met_backs[e].end(), is_kept))
                continue;
            inside[e] = 0;
            changed = true;
        }
    }
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
    // Where most of what is met are backs, one reflection tells. The lid of a box without a bottom
    // mostly meets the floor it stands on, as the underside of a table does: longer walks tell.
    constexpr double mostly = 0.6;
    constexpr int long_walk = 8;
    if (positions.empty()) return 0;
    const std::vector<char> is_lit = lit_backs(positions, visibility, cost);
    std::vector<char> inside(elements.size());
    std::vector<std::vector<int>> met_backs(elements.size());
    std::atomic<std::uint64_t> rays{0};
    tbb::parallel_for(std::size_t{0}, elements.size(), [&](std::size_t e) {
        if (elements[e].front || survey[e].escaped > 0 || survey[e].backs == 0 ||
            is_lit[static_cast<std::size_t>(elements[e].quad)] != 0)
            return;
        const bool is_clear = survey[e].backs >= mostly;
        DarkWalks walks =
            dark_walks(elements[e], is_clear ? 1 : long_walk, quads, positions, visibility);
        inside[e] = walks.dark ? 1 : 0;
        if (!is_clear) met_backs[e] = std::move(walks.met_backs);
        rays += walks.rays;
    });
    cost.rays += rays;
    keep_whole_cavities(elements, met_backs, inside);
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

void set_cells(Element& element, double cell_size, int most_levels) {
    const std::array<Vec3, 4>& p = element.geometry.vertex;
    const double along_u = std::max((p[1] - p[0]).norm(), (p[2] - p[3]).norm());
    const double along_v = std::max((p[3] - p[0]).norm(), (p[2] - p[1]).norm());
    element.space =
        HaarBasis(element.geometry, tree_for_extents(along_u, along_v, cell_size, most_levels));
}

void set_cells(std::vector<Element>& elements, double cell_size, int most_levels) {
    for (Element& element : elements)
        set_cells(element, cell_size, most_levels);
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
