#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/images/tone.h"
#include "viewer/window/panel.h"

namespace lightwell {

namespace {

/// Of the list of lamps; it scrolls where there are more.
constexpr std::size_t most_lines = 8;

/// A light's colour as displays take it, sRGB, the largest channel 1.
struct DisplayColour {
    float rgb[3];

    explicit DisplayColour(const Rgb& intensity) {
        const double most = intensity.maxCoeff();
        for (int c = 0; c < 3; ++c)
            rgb[c] = most > 0 ? static_cast<float>(srgb_encoded(intensity[c] / most)) : 1;
    }
    Rgb linear() const {
        Rgb linear;
        for (int c = 0; c < 3; ++c)
            linear[c] = srgb_decoded(static_cast<double>(rgb[c]));
        return linear;
    }
};

bool edit_number(const char* label, double& value, double low, double high, const char* format,
                 ImGuiSliderFlags flags = 0) {
    float number = static_cast<float>(value);
    if (!ImGui::SliderFloat(label, &number, static_cast<float>(low), static_cast<float>(high),
                            format, flags | ImGuiSliderFlags_AlwaysClamp))
        return false;
    value = static_cast<double>(number);
    return true;
}

bool edit_spot(SpotLight& spot) {
    bool changed = edit_number("outer angle", spot.outer_angle, 1, 180, "%.0f deg");
    changed |= edit_number("inner angle", spot.inner_angle, 0, 180, "%.0f deg");
    spot.inner_angle = std::min(spot.inner_angle, spot.outer_angle);
    float direction[3];
    for (int k = 0; k < 3; ++k)
        direction[k] = static_cast<float>(spot.direction[k]);
    if (ImGui::DragFloat3("direction", direction, 0.01F, -1, 1, "%.2f")) {
        const Vec3 wanted = Eigen::Map<Eigen::Vector3f>(direction).cast<double>();
        if (wanted.norm() > 1e-3) {
            spot.direction = wanted.normalized();
            changed = true;
        }
    }
    return changed;
}

/// @return whether the light is another one now
bool edit_light(EditedLight& edited) {
    bool changed = false;
    std::string name = name_of(edited.light);
    if (ImGui::InputText("name", &name)) {
        set_name(edited.light, name);
        changed = true;
    }
    changed |= ImGui::Checkbox("on (Space)", &edited.on);
    int kind = static_cast<int>(edited.light.index());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(6 * ImGui::GetFontSize());
    if (ImGui::Combo("kind", &kind, "point\0spot\0") &&
        kind != static_cast<int>(edited.light.index())) {
        edited.light = other_kind(edited.light, Vec3(0, 0, -1));
        changed = true;
    }
    changed |= edit_number("dimmer", edited.dimmer, 0, 1, "%.2f");
    DisplayColour colour(full_intensity_of(edited.light));
    if (ImGui::ColorEdit3("colour", colour.rgb,
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs)) {
        set_hue(edited.light, colour.linear());
        changed = true;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(9 * ImGui::GetFontSize());
    // Not down to 0, where the colour would be forgotten.
    const Rgb intensity = full_intensity_of(edited.light);
    const double most = intensity.maxCoeff();
    auto candela = static_cast<float>(most);
    if (ImGui::DragFloat("cd", &candela, 0.01F * (1 + candela), 0.01F, 1e7F, "%.4g",
                         ImGuiSliderFlags_AlwaysClamp)) {
        const Rgb hue = most > 0 ? Rgb(intensity / most) : Rgb::Ones();
        set_intensity(edited.light, static_cast<double>(candela) * hue);
        changed = true;
    }

    float position[3];
    for (int k = 0; k < 3; ++k)
        position[k] = static_cast<float>(position_of(edited.light)[k]);
    if (ImGui::DragFloat3("position", position, 0.01F, 0, 0, "%.2f m")) {
        set_position(edited.light, Eigen::Map<Eigen::Vector3f>(position).cast<double>());
        changed = true;
    }
    if (auto* spot = std::get_if<SpotLight>(&edited.light)) changed |= edit_spot(*spot);
    return changed;
}

}  // namespace

void show_lights(const PanelSubject& subject) {
    Visit& visit = subject.visit;
    ImGui::BeginDisabled(!subject.scene);
    if (ImGui::Button("add (L)")) visit.add_light(subject.scene->opened()->visibility);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!visit.selected_light());
    if (ImGui::Button("delete")) visit.remove_selected();
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!visit.edits.can_undo());
    if (ImGui::Button("undo")) visit.undo();
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!visit.edits.can_redo());
    if (ImGui::Button("redo")) visit.redo();
    ImGui::EndDisabled();

    const std::size_t count = visit.edits.lights().size();
    const float height =
        static_cast<float>(std::min(count, most_lines)) * ImGui::GetTextLineHeightWithSpacing() +
        2 * ImGui::GetStyle().FramePadding.y;
    const bool is_list = count > 0 && ImGui::BeginListBox("##lamps", ImVec2(-1, height));
    for (std::size_t k = 0; is_list && k < count; ++k) {
        const EditedLight& edited = visit.edits.lights()[k];
        ImGui::PushID(static_cast<int>(k));
        const std::string label = name_of(edited.light) + (edited.on ? "" : "  (off)");
        // Names may be empty, or alike.
        if (ImGui::Selectable((label + "##light").c_str(), visit.selected == k)) visit.selected = k;
        ImGui::PopID();
    }
    if (is_list) ImGui::EndListBox();
    if (count == 0) ImGui::TextDisabled("no lamps");
    if (!visit.selected_light()) return;
    ImGui::Separator();
    EditedLight edited = *visit.selected_light();
    ImGui::PushID("selected");
    if (edit_light(edited)) visit.edits.change(*visit.selected, edited);
    ImGui::PopID();
    // Sliders and text change with every frame until they are let go.
    if (!ImGui::IsAnyItemActive() && subject.handle == Handle::none) visit.edits.settle();
}

}  // namespace lightwell
