#include "viewer/window/panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace lightwell {

namespace {

/// Widths and places scale with the letters, and these with the display.
float letters(double count) {
    return static_cast<float>(count) * ImGui::GetFontSize();
}

bool section(const char* name, bool open) {
    return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

}  // namespace

int panel_width() {
    return static_cast<int>(letters(24));
}

void show_panel(const PanelSubject& subject) {
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(all.x, 0), ImGuiCond_Always, ImVec2(1, 0));
    ImGui::SetNextWindowSize(ImVec2(static_cast<float>(panel_width()), all.y));
    ImGui::SetNextWindowBgAlpha(0.85F);
    if (ImGui::Begin(
            "Lightwell", nullptr,
            ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse)) {
        ImGui::PushItemWidth(-letters(9));
        ImGui::TextDisabled("? help   Tab hides this");
        if (section("Picture", true)) show_pictures(subject);
        if (section("Lights", true)) show_lights(subject);
        if (section("Probe", true)) show_probe(subject);
        if (section("Frame times", true)) show_times(subject);
        if (section("Walk", false)) show_walk(subject.visit);
        if (section("Files", false)) show_files(subject);
        if (!subject.visit.messages.empty()) {
            ImGui::Separator();
            ImGui::TextWrapped("%s", subject.visit.messages.back().c_str());
        }
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

void show_walk(Visit& visit) {
    float speed = static_cast<float>(visit.camera.speed());
    if (ImGui::SliderFloat("speed", &speed, 0.05F, 50, "%.2f m/s", ImGuiSliderFlags_Logarithmic))
        visit.camera.set_speed(static_cast<double>(speed));
    float angle = static_cast<float>(visit.camera.vertical_angle());
    if (ImGui::SliderFloat("view angle", &angle, 10, 110, "%.0f deg"))
        visit.camera.set_vertical_angle(static_cast<double>(angle));
    ImGui::Checkbox("through walls (N)", &visit.through_walls);
    if (ImGui::Button("first camera (Home)")) visit.ask(Command::first_camera);
    const Vec3& at = visit.camera.position();
    ImGui::TextDisabled("eye %.2f %.2f %.2f m", at[0], at[1], at[2]);
}

void show_files(const PanelSubject& subject) {
    Visit& visit = subject.visit;
    ImGui::InputText("lights, view", &visit.lights_file);
    if (ImGui::Button("save (Ctrl+S)")) visit.ask(Command::save_lights);
    ImGui::SameLine();
    if (ImGui::Button("load (Ctrl+O)")) visit.ask(Command::load_lights);
    ImGui::InputText("pictures", &visit.picture_stem);
    if (ImGui::Button("PNG (F12)")) visit.ask(Command::picture_png);
    ImGui::SameLine();
    if (ImGui::Button("EXR (Shift+F12)")) visit.ask(Command::picture_exr);
    ImGui::InputText("operator", &visit.operator_file);
    if (ImGui::Button("save operator") && subject.scene) visit.ask(Command::save_operator);
    ImGui::SameLine();
    if (ImGui::Button("reload (F5)")) visit.ask(Command::reload);
    if (subject.scene) {
        const Provenance& p = subject.scene->opened()->transport.provenance;
        ImGui::TextDisabled("error asked %.3g %%, estimated %.2g %%", 100 * p.error_asked,
                            100 * p.error_estimated);
    }
}

void show_loading(const PanelSubject& subject) {
    if (!subject.loading || subject.loading->is_over) return;
    const float width = letters(26);
    const ImVec2 middle(0.5F * static_cast<float>(subject.width),
                        (subject.scene ? 0.05F : 0.5F) * static_cast<float>(subject.height));
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, ImVec2(0.5F, 0.5F));
    ImGui::SetNextWindowSize(ImVec2(width, 0));
    ImGui::SetNextWindowBgAlpha(0.85F);
    ImGui::Begin("loading", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextWrapped("%s", subject.loading->doing.c_str());
    ImGui::ProgressBar(static_cast<float>(subject.loading->share), ImVec2(-1, 0));
    ImGui::End();
}

void show_help(const PanelSubject& subject) {
    Visit& visit = subject.visit;
    if (!visit.shows_help) return;
    ImGui::SetNextWindowFocus();
    ImGui::SetNextWindowPos(
        ImVec2(0.5F * static_cast<float>(subject.width), 0.5F * static_cast<float>(subject.height)),
        ImGuiCond_Always, ImVec2(0.5F, 0.5F));
    ImGui::SetNextWindowBgAlpha(1);
    if (ImGui::Begin("Keys and mouse", &visit.shows_help,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoMove) &&
        ImGui::BeginTable("help", 2)) {
        for (const HelpLine& line : help_lines) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.gesture);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", line.effect);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace lightwell
