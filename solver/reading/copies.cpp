#include "solver/reading/copies.h"

#include <algorithm>
#include <array>
#include <map>

#include "radiance4d/scene/scene_quads.h"
#include "solver/reading/welded_quads.h"

namespace lightwell {

namespace {

/// Whether two quads of the same corners run round them in the same sense.
bool runs_alike(const std::array<int, 4>& a, const std::array<int, 4>& b) {
    const auto start = std::find(b.begin(), b.end(), a[0]) - b.begin();
    return b[static_cast<std::size_t>(start + 1) % 4] == a[1];
}

/// Numbers of materials whose both sides reflect, and emit if asked, but which are alike otherwise.
class Twins {
  public:
    explicit Twins(std::vector<Material>& materials) : materials_(materials) {}

    int of(int material, bool emits_both) {
        const Material& given = materials_[static_cast<std::size_t>(material)];
        Material twin = given;
        twin.reflecting = Sides::both;
        if (emits_both) twin.emitting = Sides::both;
        if (twin.reflecting == given.reflecting && twin.emitting == given.emitting) return material;
        const auto [entry, is_new] =
            known_.try_emplace({material, emits_both}, static_cast<int>(materials_.size()));
        if (is_new) {
            twin.name += emits_both ? " (both sides shine)" : " (both sides)";
            materials_.push_back(twin);
        }
        return entry->second;
    }

  private:
    std::vector<Material>& materials_;
    std::map<std::pair<int, bool>, int> known_;
};

}  // namespace

int leave_out_copies(std::vector<SceneQuad>& quads, std::vector<Material>& materials,
                     const std::string& file, std::vector<Warning>& warnings) {
    const std::vector<Quad> places = quads_of(quads);
    const WeldedQuads welded = weld(places);

    std::map<std::array<int, 4>, std::size_t> first;  // of sorted corners
    std::vector<SceneQuad> kept;
    std::vector<std::size_t> kept_from;
    Occurrences copies, different;
    Twins twins(materials);
    for (std::size_t i = 0; i < quads.size(); ++i) {
        std::array<int, 4> corners = welded.corners[i];
        std::sort(corners.begin(), corners.end());
        const auto [entry, is_new] = first.try_emplace(corners, kept.size());
        if (is_new) {
            kept.push_back(quads[i]);
            kept_from.push_back(i);
            continue;
        }
        SceneQuad& original = kept[entry->second];
        (original.material == quads[i].material ? copies : different).add(quads[i].line);
        if (runs_alike(welded.corners[kept_from[entry->second]], welded.corners[i])) continue;
        const auto emits = [&](int material) {
            return (materials[static_cast<std::size_t>(material)].emission > 0).any();
        };
        original.material =
            twins.of(original.material, emits(original.material) && emits(quads[i].material));
    }
    copies.report(file, "a copy of an earlier face: left out", warnings);
    different.report(file,
                     "a copy of an earlier face, of another material: left out, both sides are of "
                     "the earlier one's",
                     warnings);
    const auto left_out = static_cast<int>(quads.size() - kept.size());
    quads = std::move(kept);
    return left_out;
}

}  // namespace lightwell
