#include <imgui.h>

#include "viewer/window/panel.h"

namespace lightwell {

namespace {

constexpr const char* picture_names =
    "1 total\0"
    "2 direct\0"
    "3 indirect\0"
    "4 lux\0"
    "5 wavelet level\0"
    "6 coefficients\0"
    "7 difference\0";

bool slide(const char* label, double& value, double low, double high, const char* format,
           ImGuiSliderFlags flags = 0) {
    float number = static_cast<float>(value);
    if (!ImGui::SliderFloat(label, &number, static_cast<float>(low), static_cast<float>(high),
                            format, flags))
        return false;
    value = static_cast<double>(number);
    return true;
}

}  // namespace

void show_pictures(const PanelSubject& subject) {
    Visit& visit = subject.visit;
    FrameView& view = visit.view;
    int picture = static_cast<int>(view.picture);
    if (ImGui::Combo("shows", &picture, picture_names))
        view.picture = static_cast<Picture>(picture);

    switch (view.picture) {
        case Picture::total:
        case Picture::direct:
        case Picture::indirect:
            slide("exposure", view.exposure, -16, 16, "%.1f EV");
            ImGui::Checkbox("filmic curve", &view.tone_curve);
            break;
        case Picture::lux:
            slide("top of scale", view.lux_maximum, 0.1, 1e5, "%.4g lx",
                  ImGuiSliderFlags_Logarithmic);
            ImGui::SliderInt("parts of it", &view.lux_divisions, 2, 20);
            ImGui::Checkbox("contour lines", &view.contours);
            break;
        case Picture::difference:
            slide("full colour at", view.difference_range, 0.001, 1, "%.3f",
                  ImGuiSliderFlags_Logarithmic);
            break;
        default:
            break;
    }
    if (ImGui::Button("fit (X)")) visit.ask(Command::expose);
    ImGui::SameLine();
    ImGui::Checkbox("keep fitting", &visit.adapts);
    ImGui::Checkbox("smooth textures", &view.bilinear);
    ImGui::SliderInt("samples a side", &view.samples, 1, 4);

    constexpr const char* modes =
        "fresh\0"
        "incremental\0"
        "per band (PBI)\0";
    int mode = static_cast<int>(visit.update.mode);
    if (ImGui::Combo("update", &mode, modes)) visit.update.mode = static_cast<UpdateMode>(mode);
    int budget = static_cast<int>(visit.update.budget);
    if (ImGui::SliderInt("budget", &budget, 0, 2000, budget == 0 ? "exact" : "%d a frame",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        visit.update.budget = static_cast<std::uint32_t>(budget);
    double milliseconds = 1e3 * visit.update_seconds;
    if (slide("or by time", milliseconds, 0, 10, milliseconds == 0 ? "off" : "%.2f ms a frame",
              ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
        visit.update_seconds = 1e-3 * milliseconds;
    if (!subject.scene) return;
    ImGui::TextDisabled("lamps projected by %s", subject.scene->projection() == ProjectionWay::rays
                                                     ? "shadows and rays"
                                                     : "occlusion queries");
    const UpdateReport& update = subject.scene->update();
    ImGui::TextDisabled("%u coefficients multiplied, %u pending", update.coefficients,
                        update.pending);
}

}  // namespace lightwell
