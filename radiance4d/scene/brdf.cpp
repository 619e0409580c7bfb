#include "radiance4d/scene/brdf.h"

#include <cmath>

#include "radiance4d/failure.h"
#include "radiance4d/gauss_rule.h"
#include "radiance4d/scene/ggx_lobe.h"
#include "radiance4d/scene/phong_lobe.h"

namespace lightwell {

namespace {

/// What `use` makes of the lobe of reflectance 1; `otherwise` where there is no lobe.
template <typename Value, typename Use>
Value with_unit_lobe(const Lobe& lobe, const Value& otherwise, const Use& use) {
    if (const auto* phong = std::get_if<PhongLobe>(&lobe)) return use(UnitPhong(phong->exponent));
    if (const auto* ggx = std::get_if<GgxLobe>(&lobe)) return use(UnitGgx(ggx->roughness));
    return otherwise;
}

}  // namespace

bool is_glossy(const Material& material) {
    return (lobe_reflectance(material.lobe) > 0).any();
}

bool reflects(const Material& material) {
    return (material.reflectance > 0).any() || is_glossy(material);
}

Rgb lobe_reflectance(const Lobe& lobe) {
    if (const auto* phong = std::get_if<PhongLobe>(&lobe)) return phong->reflectance;
    if (const auto* ggx = std::get_if<GgxLobe>(&lobe)) return ggx->reflectance;
    return Rgb::Zero();
}

double lobe_value(const Lobe& lobe, const Vec3& in, const Vec3& out) {
    return with_unit_lobe(lobe, 0.0, [&](const auto& unit) { return unit.value(in, out); });
}

double lobe_albedo(const Lobe& lobe, double cosine) {
    return with_unit_lobe(lobe, 0.0, [&](const auto& unit) { return unit.albedo(cosine); });
}

double lobe_square(const Lobe& lobe, double cosine) {
    return with_unit_lobe(lobe, 0.0, [&](const auto& unit) { return unit.square(cosine); });
}

Vec3 sampled_direction(const Lobe& lobe, const Vec3& given, const Vec2& square) {
    LIGHTWELL_CHECK(!std::holds_alternative<NoLobe>(lobe));
    return with_unit_lobe(lobe, Vec3(Vec3::Zero()),
                          [&](const auto& unit) { return unit.sampled(given, square); });
}

double sampling_density(const Lobe& lobe, const Vec3& given, const Vec3& sampled) {
    return with_unit_lobe(lobe, 0.0,
                          [&](const auto& unit) { return unit.density(given, sampled); });
}

Rgb brdf(const Material& material, const Vec3& in, const Vec3& out) {
    return material.reflectance / M_PI +
           lobe_reflectance(material.lobe) * lobe_value(material.lobe, in, out);
}

Rgb albedo(const Material& material, double cosine) {
    return material.reflectance +
           lobe_reflectance(material.lobe) * lobe_albedo(material.lobe, cosine);
}

Rgb mean_albedo(const Material& material) {
    if (!is_glossy(material)) return material.reflectance;
    // Int a(theta) cos dw / pi over the hemisphere is 2 Int a mu dmu over the cosine mu.
    const GaussRule rule(16);
    double mean = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
        mean += rule.weights[k] * 2 * rule.nodes[k] * lobe_albedo(material.lobe, rule.nodes[k]);
    return material.reflectance + lobe_reflectance(material.lobe) * mean;
}

std::vector<Rgb> mean_albedos(const std::vector<Material>& materials) {
    std::vector<Rgb> means;
    for (const Material& material : materials)
        means.push_back(mean_albedo(material));
    return means;
}

Material diffuse_of_equal_albedo(const Material& material) {
    Material diffuse = material;
    diffuse.reflectance = mean_albedo(material);
    diffuse.lobe = NoLobe{};
    return diffuse;
}

AlbedoPeak albedo_peak(const Material& material) {
    AlbedoPeak peak;
    constexpr int degrees = 90;
    for (int angle = 0; angle < degrees; ++angle) {
        const Rgb here = albedo(material, std::cos(angle * M_PI / 180));
        for (int channel = 0; channel < 3; ++channel)
            if (here[channel] > peak.albedo)
                peak = {static_cast<double>(angle), channel, here[channel]};
        if (!is_glossy(material)) break;
    }
    return peak;
}

Material scaled_to_albedo(const Material& material, double most) {
    const double highest = albedo_peak(material).albedo;
    if (!(highest > most)) return material;
    Material scaled = material;
    const double factor = most / highest;
    scaled.reflectance *= factor;
    if (auto* phong = std::get_if<PhongLobe>(&scaled.lobe)) phong->reflectance *= factor;
    if (auto* ggx = std::get_if<GgxLobe>(&scaled.lobe)) ggx->reflectance *= factor;
    return scaled;
}

}  // namespace lightwell
