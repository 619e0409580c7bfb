#include "radiance4d/operator/file_flaws.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// Farthest that a corner may lie off the plane, in lengths of the quad. Scenes are read to 1e-4.
constexpr double planarity = 1e-3;

bool is_share(const Rgb& reflectance) {
    return (reflectance >= 0).all() && (reflectance <= 1).all();
}

std::string flaw_of_lobe(const Lobe& lobe) {
    if (!is_share(lobe_reflectance(lobe))) return "the reflectance of its lobe is not in [0,1]";
    if (const auto* phong = std::get_if<PhongLobe>(&lobe))
        if (!(phong->exponent >= 0 && phong->exponent <= 10000))
            return "its exponent is not in [0,10000]";
    if (const auto* ggx = std::get_if<GgxLobe>(&lobe))
        if (!(ggx->roughness >= 0.01 && ggx->roughness <= 1))
            return "its roughness is not in [0.01,1]";
    return {};
}

std::string flaw_of_material(const Material& material) {
    if (!is_share(material.reflectance)) return "its reflectance is not in [0,1]";
    if (std::string flaw = flaw_of_lobe(material.lobe); !flaw.empty()) return flaw;
    constexpr double rounding = 1e-5;
    if (is_glossy(material) && !(albedo_peak(material).albedo <= 1 + rounding))
        return "it reflects more than it receives";
    if (!(material.emission >= 0).all() || !material.emission.isFinite().all())
        return "its emission is not finite and >= 0";
    return {};
}

bool is_finite(const Quad& quad) {
    return std::all_of(quad.vertex.begin(), quad.vertex.end(),
                       [](const Vec3& vertex) { return vertex.allFinite(); });
}

std::string flaw_of_element_quad(const Quad& quad) {
    const Vec3 normal = quad.normal();
    if (!(quad.area() > 0) || !std::isfinite(quad.area())) return "has no area";
    const double size = std::max((quad.vertex[2] - quad.vertex[0]).norm(),
                                 (quad.vertex[3] - quad.vertex[1]).norm());
    if (!(quad.out_of_plane() <= planarity * size)) return "is not planar";
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 before = quad.vertex[k] - quad.vertex[(k + 3) % 4];
        const Vec3 after = quad.vertex[(k + 1) % 4] - quad.vertex[k];
        if (!(before.cross(after).dot(normal) > 0)) return "is not convex";
    }
    return {};
}

/// Whether splits are those of angular_basis.
bool is_angular_square(const std::vector<Split>& splits) {
    constexpr std::size_t most_angular_levels = 5;
    return splits.size() <= most_angular_levels &&
           std::all_of(splits.begin(), splits.end(),
                       [](Split split) { return split == Split::both; });
}

const Rgb& intensity_of(const Light& light) {
    return std::visit([](const auto& any) -> const Rgb& { return any.intensity; }, light);
}

std::string flaw_of_light(const Light& light) {
    if (!position_of(light).allFinite()) return "its position is not finite";
    const auto* spot = std::get_if<SpotLight>(&light);
    const Rgb& intensity = intensity_of(light);
    if (!(intensity >= 0).all() || !intensity.isFinite().all())
        return "its intensity is not finite and >= 0";
    if (!spot) return {};
    if (!(std::abs(spot->direction.norm() - 1) <= 1e-6)) return "its direction is no unit vector";
    if (!(0 <= spot->inner_angle && spot->inner_angle <= spot->outer_angle &&
          spot->outer_angle <= 180))
        return "its angles do not obey 0 <= inner <= outer <= 180";
    return {};
}

std::string flaw_of_camera(const Camera& camera) {
    if (!camera.position.allFinite() || !camera.target.allFinite() || !camera.up.allFinite())
        return "the camera is not finite";
    if (!(camera.vertical_angle > 0 && camera.vertical_angle < 180))
        return "the angle of the camera is not between 0 and 180 degrees";
    return {};
}

bool is_sane(const SensorGrid& grid) {
    return grid.origin.allFinite() && grid.along.allFinite() && grid.across.allFinite() &&
           grid.normal.allFinite() && grid.columns >= 1 && grid.rows >= 1;
}

std::string flaw_of_structure(const TransportOperator& operator_, std::uint64_t functions) {
    if (operator_.size != functions)
        return fmt::format("{} columns over {} basis functions", operator_.size, functions);
    if (operator_.column_start.size() != std::size_t{operator_.size} + 1 ||
        operator_.column_start.front() != 0 ||
        operator_.column_start.back() != operator_.value.size() ||
        operator_.row.size() != operator_.value.size() ||
        !std::is_sorted(operator_.column_start.begin(), operator_.column_start.end()))
        return "the columns do not add up to the coefficients";
    return {};
}

/// Whether the rows of every column ascend: whether nothing descends but from one column to the
/// next. Two plain counts, which compilers turn into wide instructions.
bool rows_ascend(const TransportOperator& operator_) {
    const std::vector<std::uint32_t>& row = operator_.row;
    std::uint64_t descents = 0, between_columns = 0;
    constexpr std::size_t block = 1 << 16;
    for (std::size_t begin = 1; begin < row.size(); begin += block) {
        std::uint32_t count = 0;
        for (std::size_t k = begin; k < std::min(begin + block, row.size()); ++k)
            count += row[k - 1] >= row[k] ? 1U : 0U;
        descents += count;
    }
    std::uint64_t start = 0;
    for (const std::uint64_t next : operator_.column_start) {
        if (next != start && next != row.size() && row[next - 1] >= row[next]) ++between_columns;
        start = next;
    }
    return descents == between_columns;
}

bool column_ascends(const TransportOperator& operator_, std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t k = begin + 1; k < end; ++k)
        if (operator_.row[k - 1] >= operator_.row[k]) return false;
    return true;
}

std::string flaw_of_rows(const TransportOperator& operator_, bool upper_half) {
    const bool all_ascend = rows_ascend(operator_);
    for (std::uint32_t column = 0; column < operator_.size; ++column) {
        const std::uint64_t begin = operator_.column_start[column];
        const std::uint64_t end = operator_.column_start[column + 1];
        const std::uint32_t rows = upper_half ? column + 1 : operator_.size;
        if ((begin < end && operator_.row[end - 1] >= rows) ||
            !(all_ascend || column_ascends(operator_, begin, end)))
            return fmt::format("the rows of column {} do not ascend below {}", column, rows);
    }
    return {};
}

bool all_finite(const std::vector<float>& values) {
    std::uint32_t finite = 0;
    for (const float value : values)
        finite += std::abs(value) <= std::numeric_limits<float>::max() ? 1U : 0U;
    return finite == static_cast<std::uint32_t>(values.size());
}

}  // namespace

std::string flaw_of_surfaces(const Scene& scene) {
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
        if (const std::string flaw = flaw_of_material(scene.materials[m]); !flaw.empty())
            return fmt::format("material {}: {}", m, flaw);
    for (std::size_t q = 0; q < scene.quads.size(); ++q) {
        const SceneQuad& quad = scene.quads[q];
        if (!is_finite(quad.quad)) return fmt::format("quad {}: a vertex is not finite", q);
        if (quad.material < 0 || static_cast<std::size_t>(quad.material) >= scene.materials.size())
            return fmt::format("quad {}: material {} of {}", q, quad.material,
                               scene.materials.size());
        if (quad.face < 0 || quad.line < 0)
            return fmt::format("quad {}: face {}, line {}", q, quad.face, quad.line);
    }
    return {};
}

std::string flaw_of_surroundings(const Scene& scene) {
    if (!scene.up.allFinite() || !(scene.up.norm() > 0)) return "up is no direction";
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
        if (const std::string flaw = flaw_of_light(scene.lights[l]); !flaw.empty())
            return fmt::format("light {}: {}", l, flaw);
    for (std::size_t g = 0; g < scene.sensor_grids.size(); ++g)
        if (!is_sane(scene.sensor_grids[g]))
            return fmt::format("sensor grid {} is not finite or has no sensors", g);
    return scene.camera ? flaw_of_camera(*scene.camera) : std::string();
}

std::string flaw_of_dimmers(const std::vector<DimmedLight>& lights, const Scene& scene) {
    if (lights.size() != scene.lights.size())
        return fmt::format("dimmers of {} lights, where the scene has {}", lights.size(),
                           scene.lights.size());
    const std::vector<Light> shine = shining(lights);
    for (std::size_t l = 0; l < lights.size(); ++l) {
        if (const std::string flaw = flaw_of_light(lights[l].light); !flaw.empty())
            return fmt::format("light {}: {}", l, flaw);
        if (!(lights[l].dimmer >= 0 && lights[l].dimmer <= 1))
            return fmt::format("light {}: its dimmer is not within 0 and 1", l);
        if (!(intensity_of(shine[l]) == intensity_of(scene.lights[l])).all())
            return fmt::format("light {} does not shine as its dimmer says", l);
    }
    return {};
}

std::string flaw_of_space(const std::vector<ElementShape>& shapes, const Scene& scene) {
    std::vector<bool> taken(2 * scene.quads.size(), false);
    for (std::size_t e = 0; e < shapes.size(); ++e) {
        const ElementShape& shape = shapes[e];
        const auto quad = static_cast<std::size_t>(shape.quad);
        if (shape.quad < 0 || quad >= scene.quads.size())
            return fmt::format("element {}: quad {} of {}", e, shape.quad, scene.quads.size());
        const std::size_t side = 2 * quad + (shape.front ? 0 : 1);
        if (taken[side]) return fmt::format("element {}: quad {} has this side already", e, quad);
        taken[side] = true;
        if (functions_of({shape}) > (std::uint64_t{1} << most_levels))
            return fmt::format("element {}: more than 2^{} functions", e, most_levels);
        if (!is_angular_square(shape.angle))
            return fmt::format("element {}: its directions are not cut as a lobe needs them", e);
        if (!shape.open.empty() && shape.open.size() != functions_of(shape.space))
            return fmt::format("element {}: {} masks of cells", e, shape.open.size());
        if (const std::string flaw = flaw_of_element_quad(scene.quads[quad].quad); !flaw.empty())
            return fmt::format("element {}: quad {} {}", e, quad, flaw);
    }
    if (functions_of(shapes) > std::numeric_limits<std::uint32_t>::max())
        return "more than 4294967295 basis functions";
    return {};
}

std::string flaw_of_operator(const TransportOperator& operator_, std::uint64_t functions,
                             bool upper_half) {
    if (std::string flaw = flaw_of_structure(operator_, functions); !flaw.empty()) return flaw;
    if (std::string flaw = flaw_of_rows(operator_, upper_half); !flaw.empty()) return flaw;
    return all_finite(operator_.value) ? "" : "a coefficient is not finite";
}

}  // namespace lightwell
