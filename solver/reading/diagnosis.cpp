#include "solver/reading/diagnosis.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "radiance4d/scene/scene_quads.h"
#include "solver/reading/box_tree.h"
#include "solver/reading/quad_contact.h"
#include "solver/reading/reading_report.h"
#include "solver/reading/surface_mesh.h"
#include "solver/reading/welded_quads.h"

namespace lightwell {

namespace {

constexpr std::size_t examples_named = 3;
constexpr std::size_t kinds = 8;

/// Corners off the mean plane by more than this share of the diagonal make a quad bent.
constexpr double planarity = 1e-6;

struct Kind {
    const char* name;
    const char* meaning;
};

constexpr std::array<Kind, kinds> kind_of = {{
    {"degenerate quads", "they have hardly any area, so they neither send nor receive light"},
    {"bent quads", "transport takes them as planar, so light leaks or is lost along their sides"},
    {"duplicate quads", "surfaces in one place each count the same light; remove the copies"},
    {"coplanar overlapping pairs", "where both face the same way, both count the same light"},
    {"interpenetrating pairs",
     "along the line where they cross, cells are part lit and part buried, "
     "and light leaks by up to a cell's width; cut them there"},
    {"flipped quads",
     "both sides reflect, so it matters only for a material with sides = \"front\" "
     "or one that emits"},
    {"T-vertices", "elements are not joined by their vertices; only shading may change there"},
    {"open edges", "light leaves there; it matters if the scene is meant to be closed"},
}};

class Examiner {
  public:
    Examiner(const Scene& scene, const DiagnosisRule& rule)
        : scene_(scene),
          tests_left_(rule.most_tests),
          quads_(quads_of(scene)),
          welded_(weld(quads_)),
          left_out_(quads_.size(), false),
          tree_(boxes()) {
        for (std::size_t i = 0; i < kinds; ++i)
            found_.findings.push_back(
                {static_cast<Defect>(i), 0, 0, {}, false, kind_of[i].meaning});
    }

    Diagnosis examine() {
        find_degenerate_and_bent();
        find_duplicates();
        find_contacts();
        const SurfaceMesh mesh = surface_mesh(welded_, left_out_);
        found_.surfaces = mesh.surfaces;
        found_.closed_surfaces = mesh.closed_surfaces;
        find_flipped(mesh);
        find_t_vertices();
        find_open_edges(mesh);
        for (const Defect always :
             {Defect::bent, Defect::duplicate, Defect::interpenetrating, Defect::open_edge})
            finding(always).matters = finding(always).count > 0;
        return std::move(found_);
    }

  private:
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }

    std::vector<Box> boxes() const {
        const Vec3 margin = Vec3::Constant(welded_.tolerance);
        std::vector<Box> boxes;
        for (const Quad& quad : quads_) {
            const Box box = box_around(quad);
            boxes.emplace_back(box.min() - margin, box.max() + margin);
        }
        return boxes;
    }

    int quad_count() const { return static_cast<int>(quads_.size()); }
    Finding& finding(Defect defect) { return found_.findings[static_cast<std::size_t>(defect)]; }

    void add(Defect defect, int quad) {
        Finding& into = finding(defect);
        ++into.count;
        if (into.examples.size() < examples_named &&
            (into.examples.empty() || into.examples.back() != quad))
            into.examples.push_back(quad);
    }

    /// One test more; false when the budget is spent.
    bool may_test() {
        if (tests_left_ == 0) found_.complete = false;
        return tests_left_ > 0 && tests_left_-- > 0;
    }

    void find_degenerate_and_bent() {
        for (int i = 0; i < quad_count(); ++i) {
            const Quad& quad = quads_[index(i)];
            const double size = box_around(quad).diagonal().norm();
            if (!(quad.area() > welded_.tolerance * size)) {
                add(Defect::degenerate, i);
                left_out_[index(i)] = true;
            } else if (quad.out_of_plane() > planarity * size) {
                add(Defect::bent, i);
            }
        }
    }

    void find_duplicates() {
        std::map<std::array<int, 4>, int> first;
        for (int i = 0; i < quad_count(); ++i) {
            if (left_out_[index(i)]) continue;
            std::array<int, 4> corners = welded_.corners[index(i)];
            std::sort(corners.begin(), corners.end());
            if (first.emplace(corners, i).second) continue;
            add(Defect::duplicate, i);
            left_out_[index(i)] = true;
        }
    }

    void find_contacts() {
        for (int i = 0; i < quad_count(); ++i) {
            if (left_out_[index(i)]) continue;
            tree_.visit_meeting(box_around(quads_[index(i)]), [&](int j) {
                if (j <= i || left_out_[index(j)]) return true;
                if (!may_test()) return false;
                judge_contact(i, j);
                return true;
            });
        }
    }

    void judge_contact(int i, int j) {
        const Quad &a = quads_[index(i)], &b = quads_[index(j)];
        const Contact contact = contact_of(a, b, welded_.tolerance);
        if (contact == Contact::crossing) add(Defect::interpenetrating, i);
        if (contact != Contact::overlapping) return;
        add(Defect::overlapping, i);
        if (a.normal().dot(b.normal()) > 0) finding(Defect::overlapping).matters = true;
    }

    void find_flipped(const SurfaceMesh& mesh) {
        for (int i = 0; i < quad_count(); ++i) {
            if (!mesh.flipped[index(i)]) continue;
            add(Defect::flipped, i);
            const Material& material = scene_.material_of(i);
            const bool has_a_front =
                material.reflecting == Sides::front ||
                ((material.emission > 0).any() && material.emitting == Sides::front);
            if (has_a_front) finding(Defect::flipped).matters = true;
        }
    }

    /// Finds the vertices inside sides and notes them there.
    void find_t_vertices() {
        inside_side_.resize(4 * quads_.size());
        const Vec3 reach = Vec3::Constant(welded_.tolerance);
        for (int v = 0; v < static_cast<int>(welded_.vertices.size()); ++v) {
            const Vec3& place = welded_.vertices[index(v)];
            int quad_with_it = -1;
            tree_.visit_meeting({place - reach, place + reach}, [&](int quad) {
                if (!may_test()) return false;
                const bool inside = !left_out_[index(quad)] && note_inside_sides(v, quad);
                if (inside && quad_with_it < 0) quad_with_it = quad;
                return true;
            });
            if (quad_with_it >= 0) add(Defect::t_vertex, quad_with_it);
        }
    }

    /// Whether a vertex is inside a side of a quad.
    bool note_inside_sides(int v, int quad) {
        const auto& corners = welded_.corners[index(quad)];
        if (std::find(corners.begin(), corners.end(), v) != corners.end()) return false;
        bool noted = false;
        for (std::size_t side = 0; side < 4; ++side) {
            const Vec3& from = welded_.vertices[index(corners[side])];
            const Vec3 along = welded_.vertices[index(corners[(side + 1) % 4])] - from;
            const Vec3 offset = welded_.vertices[index(v)] - from;
            const double length2 = along.squaredNorm();
            if (!(length2 > 0)) continue;
            const double t = offset.dot(along) / length2;
            if (t <= 0 || t >= 1 || (offset - t * along).norm() > welded_.tolerance) continue;
            inside_side_[4 * index(quad) + side].emplace_back(t, v);
            noted = true;
        }
        return noted;
    }

    /// A side's vertices from end to end.
    std::vector<int> vertices_along(int quad, int side) {
        const auto& corners = welded_.corners[index(quad)];
        auto& inside = inside_side_[index(4 * quad + side)];
        std::sort(inside.begin(), inside.end());
        std::vector<int> along = {corners[index(side)]};
        for (const auto& [t, v] : inside)
            along.push_back(v);
        along.push_back(corners[index((side + 1) % 4)]);
        return along;
    }

    /// A side is open where it neither has another quad's side beside it nor stands on a quad.
    void find_open_edges(const SurfaceMesh& mesh) {
        for (const auto& open : mesh.open_sides) {
            const auto along = vertices_along(open.quad, open.side);
            for (std::size_t i = 1; i < along.size(); ++i) {
                const Vec3 middle = 0.5 * (welded_.vertices[index(along[i - 1])] +
                                           welded_.vertices[index(along[i])]);
                if (!stands_on_another(middle, open.quad)) {
                    add(Defect::open_edge, open.quad);
                    break;
                }
            }
        }
    }

    bool stands_on_another(const Vec3& place, int quad) {
        const Vec3 reach = Vec3::Constant(welded_.tolerance);
        bool stands = false;
        tree_.visit_meeting({place - reach, place + reach}, [&](int other) {
            if (!may_test()) return false;
            stands = other != quad && !left_out_[index(other)] &&
                     lies_on(place, quads_[index(other)], 2 * welded_.tolerance);
            return !stands;
        });
        return stands;
    }

    const Scene& scene_;
    long long tests_left_;
    std::vector<Quad> quads_;
    WeldedQuads welded_;
    std::vector<bool> left_out_;  ///< degenerate quads and copies
    BoxTree tree_;
    /// For every side (4 * quad + side) the vertices inside it, with their parameter along it.
    std::vector<std::vector<std::pair<double, int>>> inside_side_;
    Diagnosis found_;
};

/// "first at quad 3 (room.obj:25), then quads 7, 12, ..."
std::string places_of(const Finding& finding, const Scene& scene) {
    std::string places = "first at " + scene.describe(finding.examples.front());
    for (std::size_t i = 1; i < finding.examples.size(); ++i)
        places += fmt::format("{} {}", i == 1 ? ", then at quad" : ",", finding.examples[i]);
    return places + (finding.count > static_cast<int>(finding.examples.size()) ? ", ..." : "");
}

}  // namespace

Diagnosis diagnose(const Scene& scene, const DiagnosisRule& rule) {
    return Examiner(scene, rule).examine();
}

Diagnosis with_left_out(Diagnosis diagnosis, const PolygonCounts& counts) {
    const auto add = [&](Defect defect, int left_out) {
        Finding& finding = diagnosis.findings[static_cast<std::size_t>(defect)];
        finding.count += left_out;
        finding.left_out = left_out;
    };
    add(Defect::degenerate, counts.degenerate);
    add(Defect::duplicate, counts.copies);
    return diagnosis;
}

std::string name_of(Defect defect) {
    return kind_of[static_cast<std::size_t>(defect)].name;
}

std::string to_string(const Diagnosis& diagnosis, const Scene& scene) {
    std::string text;
    for (const Finding& finding : diagnosis.findings) {
        text += fmt::format("{:>28}: {}", name_of(finding.defect), with_separators(finding.count));
        if (finding.left_out > 0)
            text += fmt::format(", {} left out when read", with_separators(finding.left_out));
        if (finding.count > finding.left_out)
            text += fmt::format(" ({}); {}: {}", places_of(finding, scene),
                                finding.matters ? "matters" : "harmless", finding.meaning);
        text += "\n";
    }
    text += fmt::format("{:>28}: {}, {} of them closed\n", "surfaces",
                        with_separators(diagnosis.surfaces),
                        with_separators(diagnosis.closed_surfaces));
    if (!diagnosis.complete)
        text += "The search was cut short: the quads touch each other too often to count it all.\n";
    return text;
}

}  // namespace lightwell
