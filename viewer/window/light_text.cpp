#include "viewer/window/light_text.h"

#include <fmt/format.h>

namespace lightwell {

namespace {

/// A TOML basic string.
std::string quoted(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            quoted += c;
    }
    return quoted + '"';
}

template <typename Three>
std::string triple(const Three& v) {
    return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]);
}

std::string text_of(const PointLight& light) {
    return fmt::format("[[light]]\nname = {}\ntype = \"point\"\nposition = {}\nintensity = {}\n",
                       quoted(light.name), triple(light.position), triple(light.intensity));
}

std::string text_of(const SpotLight& light) {
    return fmt::format(
        "[[light]]\nname = {}\ntype = \"spot\"\nposition = {}\nintensity = {}\ndirection = "
        "{}\ninner_angle = {}\nouter_angle = {}\n",
        quoted(light.name), triple(light.position), triple(light.intensity),
        triple(light.direction), light.inner_angle, light.outer_angle);
}

}  // namespace

std::string lights_and_camera_text(const std::vector<DimmedLight>& lights, const Camera& camera) {
    std::string text = lights.empty() ? "light = []\n\n" : "";
    for (const DimmedLight& dimmed : lights) {
        text += std::visit([](const auto& kind) { return text_of(kind); }, dimmed.light);
        if (dimmed.dimmer != 1) text += fmt::format("dimmer = {}\n", dimmed.dimmer);
        if (!dimmed.on) text += "on = false\n";
        text += "\n";
    }
    return text + fmt::format(
                      "[camera]\nposition = {}\ntarget = {}\nup = {}\nvertical_angle = "
                      "{}\n",
                      triple(camera.position), triple(camera.target), triple(camera.up),
                      camera.vertical_angle);
}

}  // namespace lightwell
