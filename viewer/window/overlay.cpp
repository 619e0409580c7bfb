#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/images/false_colour.h"
#include "viewer/images/tone.h"
#include "viewer/window/panel.h"

namespace lightwell {

namespace {

constexpr ImU32 ink = IM_COL32(255, 255, 255, 255), shade = IM_COL32(0, 0, 0, 200);
constexpr ImU32 in_hand = IM_COL32(255, 230, 80, 255);
constexpr ImU32 axis_colours[] = {IM_COL32(235, 80, 70, 255), IM_COL32(100, 200, 80, 255),
                                  IM_COL32(80, 140, 250, 255)};

ImVec2 at(const Vec2& place) {
    return {static_cast<float>(place[0]), static_cast<float>(place[1])};
}

/// The screen's colour of linear light.
ImU32 screen_colour(const Eigen::Array3d& linear) {
    int byte[3];
    for (int c = 0; c < 3; ++c)
        byte[c] = static_cast<int>(std::lround(255 * srgb_encoded(linear[c])));
    return IM_COL32(byte[0], byte[1], byte[2], 255);
}

/// Lamps that are written beside; of more, only the selected one.
constexpr std::size_t most_names = 24;

void draw_lamp(ImDrawList& list, const EditedLight& edited, const CameraRays& rays, bool selected,
               bool is_named) {
    const auto centre = handle_places(rays, edited.light).centre;
    const bool is_in_picture = centre && (centre->array() >= 0).all() &&
                               (*centre)[0] < rays.width() && (*centre)[1] < rays.height();
    if (!is_in_picture) return;
    const Rgb& intensity = full_intensity_of(edited.light);
    const double most = intensity.maxCoeff();
    const ImU32 colour = edited.on && most > 0 ? screen_colour(intensity / most) : shade;
    list.AddCircleFilled(at(*centre), 6, colour);
    list.AddCircle(at(*centre), 7, selected ? in_hand : shade, 0, 2);
    if (!is_named) return;
    const std::string& name = name_of(edited.light);
    const ImVec2 beside = at(*centre + Vec2(11, 6));
    list.AddText(ImVec2(beside.x + 1, beside.y + 1), shade, name.c_str());
    list.AddText(beside, ink, name.c_str());
}

void draw_handles(ImDrawList& list, const HandlePlaces& places, Handle held) {
    if (!places.centre) return;
    const ImVec2 centre = at(*places.centre);
    constexpr Handle axes[] = {Handle::x, Handle::y, Handle::z};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!places.axis[k]) continue;
        const bool is_held = held == axes[k];
        const ImU32 colour = is_held ? in_hand : axis_colours[k];
        list.AddLine(centre, at(*places.axis[k]), shade, is_held ? 6.0F : 5.0F);
        list.AddLine(centre, at(*places.axis[k]), colour, is_held ? 4.0F : 3.0F);
        list.AddCircleFilled(at(*places.axis[k]), 5, colour);
    }
    list.AddCircle(centre, 9, held == Handle::centre ? in_hand : ink, 0, 3);
    if (places.aim) {
        list.AddLine(centre, at(*places.aim), in_hand, 2);
        list.AddCircleFilled(at(*places.aim), held == Handle::aim ? 8.0F : 6.0F, in_hand);
    }
}

void draw_probe(ImDrawList& list, const PanelSubject& subject, const CameraRays& rays) {
    const std::optional<ProbedPoint>& point = subject.visit.probed;
    if (!point || !(rays.in_camera(point->position)[2] > 0)) return;
    const Vec2 place = rays.project(point->position);
    for (const auto& [colour, width] : {std::pair(shade, 4.0F), std::pair(ink, 2.0F)}) {
        list.AddLine(at(place - Vec2(8, 0)), at(place + Vec2(8, 0)), colour, width);
        list.AddLine(at(place - Vec2(0, 8)), at(place + Vec2(0, 8)), colour, width);
    }
    if (!subject.probe.reading()) return;
    const ProbeReading& reading = *subject.probe.reading();
    const std::string text = fmt::format("{:.4g} lx", reading.direct() + reading.indirect());
    const ImVec2 beside = at(place + Vec2(10, -18)), size = ImGui::CalcTextSize(text.c_str());
    list.AddRectFilled(ImVec2(beside.x - 3, beside.y - 2),
                       ImVec2(beside.x + size.x + 3, beside.y + size.y + 2), shade);
    list.AddText(beside, ink, text.c_str());
}

/// A ramp with its numbers, bottom up, in the lower right corner.
void draw_legend(ImDrawList& list, const PanelSubject& subject, const std::string& unit,
                 const std::vector<std::string>& numbers) {
    const float letter = ImGui::GetFontSize(), bar = letter, height = 15 * letter;
    const float width = 7 * letter;
    const float left = static_cast<float>(subject.width) - width - letter;
    const float top = static_cast<float>(subject.height) - height - 2.5F * letter;
    list.AddRectFilled(ImVec2(left - letter, top - 1.8F * letter),
                       ImVec2(left + width, top + height + letter), shade, 4);
    list.AddText(ImVec2(left, top - 1.5F * letter), ink, unit.c_str());
    constexpr int steps = 64;
    for (int k = 0; k < steps; ++k) {
        const float y = top + height * static_cast<float>(steps - 1 - k) / steps;
        list.AddRectFilled(ImVec2(left, y), ImVec2(left + bar, y + height / steps + 1),
                           screen_colour(ramp_colour((k + 0.5) / steps).cast<double>()));
    }
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const float y =
            top + height * (1 - static_cast<float>(k) / static_cast<float>(numbers.size() - 1));
        list.AddLine(ImVec2(left + bar, y), ImVec2(left + bar + 4, y), ink);
        list.AddText(ImVec2(left + bar + 8, y - 0.5F * letter), ink, numbers[k].c_str());
    }
}

void draw_lux_legend(ImDrawList& list, const PanelSubject& subject) {
    const FrameView& view = subject.visit.view;
    std::vector<std::string> numbers;
    // Contours run where the numbers stand; of many, every second one is written.
    const int step = view.lux_divisions > 12 && view.lux_divisions % 2 == 0 ? 2 : 1;
    for (int k = 0; k <= view.lux_divisions; k += step)
        numbers.push_back(fmt::format("{:.4g}", view.lux_maximum * k / view.lux_divisions));
    numbers.back() += "+";  // and all above
    draw_legend(list, subject, "lx", numbers);
}

void draw_level_legend(ImDrawList& list, const PanelSubject& subject) {
    std::vector<std::string> numbers;
    for (int k = 0; k <= subject.scene->renderer().deepest_level(); ++k)
        numbers.push_back(fmt::format("{}", k));
    if (numbers.size() > 1) draw_legend(list, subject, "level", numbers);
}

void draw_coefficient_legend(ImDrawList& list, const PanelSubject& subject) {
    constexpr int parts = 4;
    const double most =
        std::log1p(static_cast<double>(subject.scene->renderer().most_coefficients()));
    if (!(most > 0)) return;
    std::vector<std::string> numbers;
    for (int k = 0; k <= parts; ++k)
        numbers.push_back(fmt::format("{:.0f}", std::expm1(most * k / parts)));
    draw_legend(list, subject, "coefficients", numbers);
}

void draw_difference_legend(ImDrawList& list, const PanelSubject& subject) {
    const float letter = ImGui::GetFontSize();
    const double range = 100 * subject.visit.view.difference_range;
    const std::string text =
        fmt::format("blue: {0:.3g} % too dark, grey: exact, red: {0:.3g} % too bright", range);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(static_cast<float>(subject.width) - size.x - letter,
                        static_cast<float>(subject.height) - 2 * letter);
    list.AddRectFilled(ImVec2(corner.x - 4, corner.y - 3),
                       ImVec2(corner.x + size.x + 4, corner.y + size.y + 3), shade);
    list.AddText(corner, ink, text.c_str());
}

/// The newest message, in the lower left corner.
void draw_news(ImDrawList& list, const PanelSubject& subject) {
    const float letter = ImGui::GetFontSize();
    const float wrap = static_cast<float>(subject.width) - 3 * letter;
    const std::string& text = subject.visit.messages.back();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 at(letter, static_cast<float>(subject.height) - size.y - letter);
    list.AddRectFilled(ImVec2(at.x - 6, at.y - 4), ImVec2(at.x + size.x + 6, at.y + size.y + 4),
                       shade, 4);
    list.AddText(nullptr, 0, at, ink, text.c_str(), nullptr, wrap);
}

}  // namespace

void show_overlay(const PanelSubject& subject) {
    if (!subject.scene) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    // Handles would shine through the panel.
    list.PushClipRect(ImVec2(0, 0), ImVec2(static_cast<float>(subject.width),
                                           static_cast<float>(subject.height)));
    const Visit& visit = subject.visit;
    const CameraRays rays(visit.camera.camera(), subject.width, subject.height);
    if (visit.shows_handles) {
        const std::vector<EditedLight>& lights = visit.edits.lights();
        for (std::size_t k = 0; k < lights.size(); ++k) {
            const bool is_selected = visit.selected == k;
            draw_lamp(list, lights[k], rays, is_selected,
                      is_selected || lights.size() <= most_names);
        }
        if (const EditedLight* light = visit.selected_light())
            draw_handles(list, handle_places(rays, light->light), subject.handle);
    }
    draw_probe(list, subject, rays);
    if (visit.has_news && !visit.messages.empty()) draw_news(list, subject);
    switch (visit.view.picture) {
        case Picture::lux:
            draw_lux_legend(list, subject);
            break;
        case Picture::level:
            draw_level_legend(list, subject);
            break;
        case Picture::coefficients:
            draw_coefficient_legend(list, subject);
            break;
        case Picture::difference:
            draw_difference_legend(list, subject);
            break;
        default:
            break;
    }
    list.PopClipRect();
}

}  // namespace lightwell
