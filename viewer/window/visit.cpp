#include "viewer/window/visit.h"

#include <algorithm>
#include <utility>

#include "viewer/window/lit_scene.h"

namespace lightwell {

namespace {

constexpr std::size_t most_messages = 50;

bool is_same(const EditedLight& a, const EditedLight& b) {
    return a.on == b.on && a.dimmer == b.dimmer && name_of(a.light) == name_of(b.light) &&
           shine_alike({a.light}, {b.light});
}

/// Selects the first light that is another one than before, or has come back; where lights are
/// gone, none that has moved up to their place.
void select_changed(Visit& visit, const std::vector<EditedLight>& before) {
    const std::vector<EditedLight>& now = visit.edits.lights();
    const auto [mine, its] =
        std::mismatch(now.begin(), now.end(), before.begin(), before.end(), is_same);
    const auto changed = static_cast<std::size_t>(mine - now.begin());
    if (now.size() >= before.size()) {
        if (changed < now.size()) visit.selected = changed;
    } else if (visit.selected && *visit.selected >= changed) {
        visit.selected.reset();
    }
}

}  // namespace

void Visit::say(std::string message) {
    messages.push_back(std::move(message));
    if (messages.size() > most_messages) messages.erase(messages.begin());
    has_news = true;
}

void Visit::heed(const Input& input) {
    const auto* key = std::get_if<KeyInput>(&input);
    const auto* button = std::get_if<ButtonInput>(&input);
    if ((key && key->down) || (button && button->down)) has_news = false;
}

const EditedLight* Visit::selected_light() const {
    return selected && *selected < edits.lights().size() ? &edits.lights()[*selected] : nullptr;
}

void Visit::add_light(const Visibility& visibility, double arm) {
    constexpr double share = 0.5;       // of the way to what is looked at
    constexpr double brightness = 100;  // [cd], about a 100 W bulb
    const Vec3 ahead = camera.forward();
    const Hit hit = visibility.nearest(camera.position(), free_point, ahead);
    const double distance = hit ? std::min(arm, share * hit.distance) : std::min(arm, 1.0);
    PointLight light;
    light.name = "lamp";
    light.position = camera.position() + distance * ahead;
    light.intensity = Rgb::Constant(brightness);
    selected = edits.add({light, true, 1});
}

void Visit::remove_selected() {
    if (!selected_light()) return;
    edits.remove(*selected);
    selected.reset();
}

void Visit::undo() {
    const std::vector<EditedLight> before = edits.lights();
    edits.undo();
    select_changed(*this, before);
}

void Visit::redo() {
    const std::vector<EditedLight> before = edits.lights();
    edits.redo();
    select_changed(*this, before);
}

std::optional<ProbedPoint> surface_along(const Visibility& visibility, const Vec3& eye,
                                         const Vec3& direction) {
    const Hit hit = visibility.nearest(eye, free_point, direction);
    if (!hit) return std::nullopt;
    return ProbedPoint{eye + hit.distance * direction, hit.quad, hit.front};
}

}  // namespace lightwell
