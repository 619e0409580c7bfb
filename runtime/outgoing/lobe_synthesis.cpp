#include "runtime/outgoing/lobe_synthesis.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>

#include <tbb/parallel_for.h>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// Buried cells that carry on the light beside them, as many as filtering reads; further in it is
/// dark.
constexpr int rings = 2;

/// The nearest open cell of every cell, itself where it is open or none is near; what is buried is
/// seen by nobody, but filtering reads it.
std::vector<std::uint32_t> nearest_open(const std::vector<std::pair<int, int>>& texel,
                                        const std::vector<char>& is_open) {
    std::vector<std::uint32_t> nearest(texel.size());
    for (std::uint32_t m = 0; m < texel.size(); ++m) {
        nearest[m] = m;
        if (is_open[m] != 0) continue;
        int least = -1;
        for (std::uint32_t n = 0; n < texel.size(); ++n) {
            if (is_open[n] == 0) continue;
            const int x = texel[n].first - texel[m].first, y = texel[n].second - texel[m].second;
            if (std::max(std::abs(x), std::abs(y)) > rings) continue;
            if (least >= 0 && x * x + y * y >= least) continue;
            least = x * x + y * y;
            nearest[m] = n;
        }
    }
    return nearest;
}

}  // namespace

std::vector<TextureSize> LobeSynthesis::sizes(const RadianceSpace& space) {
    std::vector<TextureSize> result(space.elements().size());
    for (std::size_t e = 0; e < result.size(); ++e) {
        const CellTree& tree = space.element(e).space.tree();
        if (space.element(e).angle.levels() > 0)
            result[e] = {static_cast<int>(tree.columns()), static_cast<int>(tree.rows())};
    }
    return result;
}

LobeSynthesis::LobedElement LobeSynthesis::lobed(const Scene& scene, const RadianceSpace& space,
                                                 std::size_t e, std::size_t table) {
    const Element& element = space.element(e);
    const CellTree& tree = element.space.tree();
    LobedElement result{e,
                        table,
                        lobe_reflectance(scene.material_of(element.quad).lobe),
                        PackedHaar(element.space),
                        element.first,
                        element.angle.functions(),
                        element.geometry.normal(),
                        element.geometry.vertex[0],
                        local_frame(element.geometry),
                        {},
                        {},
                        {},
                        {},
                        {},
                        {},
                        {}};
    for (std::uint32_t m = 0; m < tree.functions(); ++m) {
        const Cell cell{tree.levels(), m};
        const ParameterRect r = tree.rect(cell);
        const double u = 0.5 * (r.u0 + r.u1), v = 0.5 * (r.v0 + r.v1);
        result.centre.push_back(element.geometry.point(u, v));
        result.to_radiance.push_back(static_cast<float>(1 / std::sqrt(element.space.area(cell))));
        result.texel.emplace_back(static_cast<int>(u * tree.columns()),
                                  static_cast<int>(v * tree.rows()));
        result.is_open.push_back(element.open.empty() || element.open[m] != 0 ? 1 : 0);
    }
    result.stand_in = nearest_open(result.texel, result.is_open);
    result.incident = AngularLight::Zero(Eigen::Index{tree.functions()} * result.angles, 3);
    result.scaling = PackedField::Zero(4, tree.functions());
    return result;
}

LobeSynthesis::LobeSynthesis(const GlobalTransport& transport)
    : atlas_(sizes(transport.space)),
      borders_(transport.space, atlas_,
               [&](std::size_t a, std::size_t b) {
                   const Element &one = transport.space.element(a),
                                 &other = transport.space.element(b);
                   return one.angle.levels() > 0 && other.angle.levels() > 0 &&
                          transport.scene.material_number(one.quad) ==
                              transport.scene.material_number(other.quad);
               }),
      changed_(transport.space.elements().size()) {
    const RadianceSpace& space = transport.space;
    std::map<std::pair<std::size_t, int>, std::size_t> known;  // material and level -> table
    for (std::size_t e = 0; e < space.elements().size(); ++e) {
        const int level = space.element(e).angle.levels();
        if (level == 0) continue;
        const std::size_t material = transport.scene.material_number(space.element(e).quad);
        const auto [entry, is_new] = known.try_emplace({material, level}, tables_.size());
        if (is_new) tables_.emplace_back(transport.scene.materials[material].lobe, level);
        lobed_.push_back(lobed(transport.scene, space, e, entry->second));
    }
    if (is_needed()) taken_ = PackedField::Zero(4, space.functions());
}

void LobeSynthesis::take(const PackedField& incident) {
    tbb::parallel_for(std::size_t{0}, lobed_.size(), [&](std::size_t k) {
        LobedElement& lobed = lobed_[k];
        const Eigen::Index count = lobed.incident.rows();
        auto taken = taken_.middleCols(lobed.first, count);
        const auto wanted = incident.middleCols(lobed.first, count);
        if (!(taken != wanted).any()) return;
        taken = wanted;
        take_element(lobed, incident);
        lobed.is_dark = (wanted == 0).all();
        lobed.has_changed = true;
    });
}

void LobeSynthesis::take_element(LobedElement& lobed, const PackedField& incident) const {
    const auto cells = static_cast<Eigen::Index>(lobed.centre.size());
    for (std::uint32_t a = 0; a < lobed.angles; ++a) {
        lobed.haar.synthesise(incident, lobed.first + a, lobed.haar.tree().levels(), lobed.scaling,
                              lobed.angles);
        for (Eigen::Index m = 0; m < cells; ++m)
            lobed.incident.row(m * lobed.angles + a) =
                (lobed.to_radiance[static_cast<std::size_t>(m)] * lobed.scaling.col(m).head<3>())
                    .transpose();
    }
}

std::size_t LobeSynthesis::synthesise(const Vec3& eye) {
    const bool has_moved = !eye_ || *eye_ != eye;
    eye_ = eye;
    std::size_t count = 0;
    std::fill(changed_.begin(), changed_.end(), char{0});
    for (LobedElement& lobed : lobed_) {
        if (!(lobed.has_changed || (has_moved && !lobed.is_dark))) continue;
        // It stays in need of work, for an eye that it faces.
        if (!(lobed.normal.dot(eye - lobed.corner) > 0)) continue;
        fill_texture(lobed, eye);
        lobed.has_changed = false;
        changed_[lobed.element] = 1;
        ++count;
    }
    for (const LobedElement& lobed : lobed_) {
        const std::vector<std::size_t>& neighbours = borders_.neighbours(lobed.element);
        if (changed_[lobed.element] != 0 ||
            std::any_of(neighbours.begin(), neighbours.end(),
                        [&](std::size_t n) { return changed_[n] != 0; }))
            borders_.fill(lobed.element, atlas_);
    }
    return count;
}

void LobeSynthesis::fill_texture(const LobedElement& lobed, const Vec3& eye) {
    const auto texel = [&](int column, int row) {
        return atlas_.texel(lobed.element, column, row);
    };
    const auto cells = static_cast<std::uint32_t>(lobed.centre.size());
    const LobeTable& table = tables_[lobed.table];
    constexpr std::uint32_t together = 64;
    tbb::parallel_for(std::uint32_t{0}, (cells + together - 1) / together, [&](std::uint32_t part) {
        for (std::uint32_t m = part * together; m < std::min(cells, (part + 1) * together); ++m) {
            if (lobed.is_open[m] == 0) continue;
            const Vec3 towards = lobed.frame.transpose() * (eye - lobed.centre[m]).normalized();
            const Rgb radiance =
                lobed.reflectance *
                table.reflected(towards, lobed.incident.middleRows(Eigen::Index{m} * lobed.angles,
                                                                   lobed.angles));
            texel(lobed.texel[m].first, lobed.texel[m].second).head<3>() = radiance.cast<float>();
        }
    });
    for (std::uint32_t m = 0; m < cells; ++m)
        if (lobed.is_open[m] == 0) {
            const auto [column, row] = lobed.texel[lobed.stand_in[m]];
            texel(lobed.texel[m].first, lobed.texel[m].second) = texel(column, row);
        }
}

}  // namespace lightwell
