#include "runtime/drawing/surface_records.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "radiance4d/failure.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

Record record(const Eigen::Array3d& three, double fourth = 0) {
    return {static_cast<float>(three[0]), static_cast<float>(three[1]),
            static_cast<float>(three[2]), static_cast<float>(fourth)};
}

/// Reflectance of a lobe and its shape, see records_per_quad.
Record lobe_record(const Lobe& lobe) {
    double shape = 0;
    if (const auto* phong = std::get_if<PhongLobe>(&lobe)) shape = phong->exponent;
    if (const auto* ggx = std::get_if<GgxLobe>(&lobe)) shape = -ggx->roughness;
    return record(lobe_reflectance(lobe), shape);
}

/// Coefficients of the global transport operator by the element that they give light to.
std::vector<std::uint64_t> coefficients_of(const GlobalTransport& transport) {
    std::vector<std::uint64_t> counts(transport.space.elements().size(), 0);
    for (const TransportOperator& channel : transport.indirect)
        for (const std::uint32_t row : channel.row)
            ++counts[transport.space.element_of(row)];
    return counts;
}

}  // namespace

SceneScale::SceneScale(const Scene& scene) {
    Eigen::AlignedBox3d box;
    for (const SceneQuad& quad : scene.quads)
        for (const Vec3& vertex : quad.quad.vertex)
            box.extend(vertex);
    if (box.isEmpty()) return;
    centre = box.center();
    extent = box.diagonal().norm();
}

SurfaceRecords::SurfaceRecords(const GlobalTransport& transport, const SceneScale& scale) {
    const Scene& scene = transport.scene;
    const RadianceSpace& space = transport.space;
    const std::vector<Rgb> albedo = mean_albedos(scene.materials);
    for (int q = 0; q < static_cast<int>(scene.quads.size()); ++q) {
        const Quad& quad = scene.quads[static_cast<std::size_t>(q)].quad;
        const Material& material = scene.material_of(q);
        const std::array<double, 4> fourth = {1.0 * space.element_on(q, true),
                                              1.0 * space.element_on(q, false), 0, 0};
        for (std::size_t k = 0; k < 4; ++k)
            records.push_back(record(scale.scaled(quad.vertex[k]), fourth[k]));
        records.push_back(record(quad.normal()));
        const bool has_lobe = std::any_of(fourth.begin(), fourth.begin() + 2, [&](double e) {
            return e >= 0 && space.element(static_cast<std::size_t>(e)).angle.levels() > 0;
        });
        const Rgb& diffuse = has_lobe ? material.reflectance : albedo[scene.material_number(q)];
        for (const bool front : {true, false}) {
            const bool reflects = front || material.reflecting == Sides::both;
            const bool emits = front || material.emitting == Sides::both;
            records.push_back(record(reflects ? Rgb(diffuse / M_PI) : Rgb(Rgb::Zero())));
            records.push_back(record(emits ? material.emission : Rgb(Rgb::Zero())));
        }
        records.push_back(has_lobe ? lobe_record(material.lobe) : Record{});
    }
    first_element = static_cast<int>(records.size());
    LIGHTWELL_CHECK_OP(records.size(), ==, scene.quads.size() * records_per_quad);

    const std::vector<std::uint64_t> counts = coefficients_of(transport);
    for (std::size_t e = 0; e < counts.size(); ++e) {
        most_coefficients = std::max(most_coefficients, counts[e]);
        deepest_level = std::max(deepest_level, space.element(e).space.tree().levels());
    }
    for (std::size_t e = 0; e < counts.size(); ++e) {
        const CellTree& tree = space.element(e).space.tree();
        const double share =
            std::log1p(static_cast<double>(counts[e])) /
            std::log1p(static_cast<double>(std::max<std::uint64_t>(1, most_coefficients)));
        records.push_back({1, 1, 1, 1});
        records.push_back(record({1.0 * tree.columns(), 1.0 * tree.rows(),
                                  1.0 * tree.levels() / std::max(1, deepest_level)},
                                 share));
        records.push_back({});
        has_lobe_.push_back(space.element(e).angle.levels() > 0 ? 1 : 0);
    }
}

bool SurfaceRecords::place(const TextureAtlas& atlas) {
    bool is_news = false;
    for (std::size_t e = 0; e < atlas.textures(); ++e)
        is_news = enter(atlas, e, 0) || is_news;
    return is_news;
}

bool SurfaceRecords::place_lobes(const TextureAtlas& atlas) {
    bool is_news = false;
    for (std::size_t e = 0; e < atlas.textures(); ++e)
        if (has_lobe_[e] != 0) is_news = enter(atlas, e, 2) || is_news;
    return is_news;
}

bool SurfaceRecords::has_lobes() const {
    return std::any_of(has_lobe_.begin(), has_lobe_.end(), [](char has) { return has != 0; });
}

bool SurfaceRecords::enter(const TextureAtlas& atlas, std::size_t e, int which) {
    const AtlasPlace& place = atlas.place(e);
    const Record entry = {static_cast<float>(place.left), static_cast<float>(place.top),
                          static_cast<float>(place.size.columns),
                          static_cast<float>(place.size.rows)};
    Record& known =
        records[static_cast<std::size_t>(first_element + which) + e * records_per_element];
    return std::exchange(known, entry) != entry;
}

}  // namespace lightwell
