#include "viewer/window/light_edits.h"

#include <algorithm>
#include <string>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

constexpr std::size_t most_steps = 500;

std::vector<EditedLight> switched_on(const std::vector<Light>& lights) {
    std::vector<EditedLight> edited;
    edited.reserve(lights.size());
    for (const Light& light : lights)
        edited.push_back({light, true, 1});
    return edited;
}

}  // namespace

void set_position(Light& light, const Vec3& position) {
    std::visit([&](auto& kind) { kind.position = position; }, light);
}

void set_intensity(Light& light, const Rgb& intensity) {
    std::visit([&](auto& kind) { kind.intensity = intensity; }, light);
}

void set_name(Light& light, const std::string& name) {
    std::visit([&](auto& kind) { kind.name = name; }, light);
}

void set_hue(Light& light, const Rgb& wanted) {
    const double most = wanted.maxCoeff();
    if (most > 0) set_intensity(light, full_intensity_of(light).maxCoeff() / most * wanted);
}

const Rgb& full_intensity_of(const Light& light) {
    return std::visit([](const auto& kind) -> const Rgb& { return kind.intensity; }, light);
}

Light other_kind(const Light& light, const Vec3& direction) {
    if (const auto* spot = std::get_if<SpotLight>(&light))
        return PointLight{spot->name, spot->position, spot->intensity};
    const auto& point = std::get<PointLight>(light);
    SpotLight spot;
    spot.name = point.name;
    spot.position = point.position;
    spot.intensity = point.intensity;
    spot.direction = direction;
    return spot;
}

LightEdits::LightEdits(const std::vector<Light>& lights) : lights_(switched_on(lights)) {}

std::vector<Light> LightEdits::shining() const {
    std::vector<Light> shining;
    for (const EditedLight& edited : lights_) {
        if (!edited.on || !(edited.dimmer > 0)) continue;
        Light light = edited.light;
        set_intensity(light, edited.dimmer * full_intensity_of(light));
        shining.push_back(std::move(light));
    }
    return shining;
}

std::size_t LightEdits::add(const EditedLight& light) {
    remember();
    EditedLight added = light;
    const std::string wanted = name_of(light.light);
    const auto is_taken = [&](const std::string& name) {
        return std::any_of(lights_.begin(), lights_.end(),
                           [&](const EditedLight& other) { return name_of(other.light) == name; });
    };
    for (int k = 2; is_taken(name_of(added.light)); ++k)
        set_name(added.light, wanted + " " + std::to_string(k));
    lights_.push_back(std::move(added));
    return lights_.size() - 1;
}

void LightEdits::replace(const std::vector<EditedLight>& lights) {
    remember();
    lights_ = lights;
}

void LightEdits::remove(std::size_t index) {
    LIGHTWELL_CHECK_OP(index, <, lights_.size());
    remember();
    lights_.erase(lights_.begin() + static_cast<std::ptrdiff_t>(index));
}

void LightEdits::change(std::size_t index, const EditedLight& light) {
    LIGHTWELL_CHECK_OP(index, <, lights_.size());
    if (!is_changing_) remember();
    is_changing_ = true;
    lights_[index] = light;
}

void LightEdits::undo() {
    if (past_.empty()) return;
    settle();
    future_.push_back(std::move(lights_));
    lights_ = std::move(past_.back());
    past_.pop_back();
}

void LightEdits::redo() {
    if (future_.empty()) return;
    settle();
    past_.push_back(std::move(lights_));
    lights_ = std::move(future_.back());
    future_.pop_back();
}

void LightEdits::remember() {
    settle();
    future_.clear();
    past_.push_back(lights_);
    if (past_.size() > most_steps) past_.erase(past_.begin());
}

}  // namespace lightwell
