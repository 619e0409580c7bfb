#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/window/panel.h"

namespace lightwell {

namespace {

void number(double value) {
    ImGui::TableNextColumn();
    ImGui::Text("%.4g", value);
}

/// What was clicked on, short enough for the panel.
std::string surface_text(const Scene& scene, const ProbedPoint& point) {
    const SceneQuad& quad = scene.quads[static_cast<std::size_t>(point.quad)];
    const Material& material = scene.materials[static_cast<std::size_t>(quad.material)];
    return fmt::format("{}, reflectance {:.2g}, {} of quad {}, {}:{}", material.name,
                       luminance(material.reflectance), point.front ? "front" : "back", point.quad,
                       std::filesystem::path(scene.geometry_file).filename().string(), quad.line);
}

void show_shares(const ProbeReading& reading) {
    if (!ImGui::BeginTable("shares", 4, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("lx", ImGuiTableColumnFlags_WidthStretch, 1.6F);
    for (const char* heading : {"direct", "indirect", "both"})
        ImGui::TableSetupColumn(heading);
    ImGui::TableHeadersRow();
    const auto row = [](const std::string& name, double direct, double indirect) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(name.c_str());
        number(direct);
        number(indirect);
        number(direct + indirect);
    };
    for (const LightShare& share : reading.shares)
        row(share.name, share.direct, share.indirect());
    row("all", reading.direct(), reading.indirect());
    ImGui::EndTable();
}

void show_bounces(const ProbeReading& reading) {
    const std::vector<double> bounces = reading.bounces();
    const double most =
        std::max(1e-30, bounces.empty() ? 0 : *std::max_element(bounces.begin(), bounces.end()));
    constexpr std::size_t shown = 8;
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, IM_COL32(60, 110, 60, 255));
    double rest = 0;
    for (std::size_t k = 0; k < bounces.size(); ++k) {
        if (k >= shown) {
            rest += bounces[k];
            continue;
        }
        const std::string text = fmt::format("bounce {}: {:.4g} lx", k + 1, bounces[k]);
        ImGui::ProgressBar(static_cast<float>(bounces[k] / most), ImVec2(-1, 0), text.c_str());
    }
    ImGui::PopStyleColor();
    if (rest > 0) ImGui::Text("later: %.4g lx", rest);
}

}  // namespace

void show_probe(const PanelSubject& subject) {
    const std::optional<ProbedPoint>& point = subject.visit.probed;
    if (!point || !subject.scene) {
        ImGui::TextDisabled("click a surface to read its light");
        return;
    }
    // Rounded before it is written: -0.00 looks odd.
    const Vec3 place = (100 * point->position).array().round().matrix() / 100 + Vec3::Zero();
    ImGui::Text("%.2f %.2f %.2f m", place[0], place[1], place[2]);
    ImGui::SameLine();
    if (ImGui::SmallButton("forget")) subject.visit.probed.reset();
    if (!point) return;
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s",
                       surface_text(subject.scene->opened()->transport.scene, *point).c_str());
    ImGui::PopStyleColor();
    ImGui::Text("indirect as drawn: %.4g lx",
                luminance(subject.scene->indirect_at(point->quad, point->front, point->position)));
    if (!subject.probe.reading()) {
        ImGui::TextDisabled("reading ...");
        return;
    }
    const ProbeReading& reading = *subject.probe.reading();
    show_shares(reading);
    show_bounces(reading);
}

}  // namespace lightwell
