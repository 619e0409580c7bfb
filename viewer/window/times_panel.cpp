#include <algorithm>
#include <array>

#include <imgui.h>

#include "viewer/window/panel.h"

namespace lightwell {

namespace {

constexpr std::array<ImU32, StageTimes::stages> stage_colours = {
    IM_COL32(230, 170, 60, 255), IM_COL32(90, 160, 230, 255), IM_COL32(190, 110, 220, 255),
    IM_COL32(110, 200, 120, 255), IM_COL32(200, 200, 200, 255)};

/// A pile for every frame, the newest on the right.
void draw_piles(const std::vector<StageTimes>& frames, double most) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 5 * ImGui::GetFontSize());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, ImVec2(corner.x + size.x, corner.y + size.y),
                       IM_COL32(0, 0, 0, 120));
    const float width = size.x / static_cast<float>(StageHistory::length);
    float x = corner.x + size.x - width * static_cast<float>(frames.size());
    for (const StageTimes& times : frames) {
        float y = corner.y + size.y;
        const auto seconds = times.in_order();
        for (std::size_t stage = 0; stage < seconds.size(); ++stage) {
            const float height =
                std::min(y - corner.y, size.y * static_cast<float>(seconds[stage] / most));
            list.AddRectFilled(ImVec2(x, y - height), ImVec2(x + width, y), stage_colours[stage]);
            y -= height;
        }
        x += width;
    }
    ImGui::Dummy(size);
}

double sum(const StageTimes& times) {
    double all = 0;
    for (const double seconds : times.in_order())
        all += seconds;
    return all;
}

}  // namespace

void show_times(const PanelSubject& subject) {
    std::vector<StageTimes> frames = subject.history.frames();
    if (!subject.visit.charts_drawing)
        for (StageTimes& times : frames)
            times.drawing = times.upload = 0;
    double most = 1e-4;
    for (const StageTimes& times : frames)
        most = std::max(most, sum(times));
    draw_piles(frames, most);
    ImGui::TextDisabled(most < 1 ? "top: %.3g ms" : "top: %.0f ms", 1e3 * most);
    ImGui::SameLine();
    ImGui::Checkbox("with upload and drawing", &subject.visit.charts_drawing);
    ImGui::TextDisabled("medians of the last frames:");
    for (std::size_t stage = 0; stage < StageTimes::stages; ++stage) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float side = ImGui::GetFontSize();
        ImGui::GetWindowDrawList()->AddRectFilled(at, ImVec2(at.x + side, at.y + side),
                                                  stage_colours[stage]);
        ImGui::Dummy(ImVec2(side, side));
        ImGui::SameLine();
        ImGui::Text("%-16s %8.3f ms", stage_names[stage], 1e3 * subject.history.median(stage));
    }
}

}  // namespace lightwell
