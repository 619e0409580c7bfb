#include "viewer/window/gestures.h"

#include <algorithm>
#include <cmath>

namespace lightwell {

namespace {

constexpr double click_reach = 4;  // a press that moves farther is a drag [pixels]
constexpr double pick_reach = 10;  // of a light's place [pixels]
constexpr double degrees_per_pixel = 0.2;
constexpr double wheel_factor = 1.15;  // of the speed, per notch
constexpr double fast = 4, slow = 0.25;
constexpr double longest_step = 0.25;  // a walker does not leap after a slow frame [s]

std::optional<std::size_t> light_at(const Visit& visit, const CameraRays& rays,
                                    const Vec2& cursor) {
    std::optional<std::size_t> nearest;
    double least = pick_reach;
    for (std::size_t k = 0; k < visit.edits.lights().size(); ++k) {
        const auto centre = handle_places(rays, visit.edits.lights()[k].light).centre;
        const double distance = centre ? (*centre - cursor).norm() : least + 1;
        if (distance > least) continue;
        least = distance;
        nearest = k;
    }
    return nearest;
}

bool is_modifier(Key key) {
    return key == Key::control || key == Key::shift || key == Key::alt;
}

Handle selected_handle_at(const Visit& visit, const CameraRays& rays, const Vec2& cursor) {
    const EditedLight* light = visit.shows_handles ? visit.selected_light() : nullptr;
    return light ? handle_at(handle_places(rays, light->light), cursor) : Handle::none;
}

}  // namespace

const std::array<HelpLine, 24> help_lines = {{
    {"W A S D, arrows", "walk; Q down, E up"},
    {"Shift, Alt", "walk fast, slowly"},
    {"wheel", "walking speed"},
    {"drag on a surface, right drag", "look around"},
    {"F", "look around without a button; Esc ends it"},
    {"N", "walk through walls, or not"},
    {"Home", "back to the first camera"},
    {"click on a lamp", "select it; drag its handles to move it"},
    {"drag the ring", "move the lamp across the view"},
    {"drag an arrow", "move the lamp along x, y or z"},
    {"drag the yellow tip", "turn a spot"},
    {"L, Delete", "add a lamp, delete the selected one"},
    {"Space", "switch the selected lamp on or off"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo (Ctrl+Shift+Z, too)"},
    {"click on a surface", "read its light"},
    {"1 ... 7", "picture: total, direct, indirect, lux, level, coefficients, difference"},
    {"- and .", "darker, brighter"},
    {"X", "fit exposure and lux scale to the picture"},
    {"Ctrl+S, Ctrl+O", "save, load lights and view"},
    {"F12, Shift+F12", "picture to a PNG, to an EXR"},
    {"F5", "read the file again"},
    {"Tab", "show or hide the panel"},
    {"?, F1", "this help"},
    {"Ctrl+Q", "quit"},
}};

void Gestures::take(const Input& input, const PanelClaims& claims, Visit& visit,
                    const Visibility& visibility, int width, int height) {
    const CameraRays rays(visit.camera.camera(), width, height);
    if (const auto* key = std::get_if<KeyInput>(&input)) {
        const bool counts = key->down && !claims.keyboard;
        // Whoever lets go of Ctrl before the S of Ctrl+S does not mean to walk.
        const bool is_command = held(Key::control) && !is_modifier(key->key);
        held_[static_cast<std::size_t>(key->key)] = counts && !is_command;
        if (counts) press(key->key, visit, visibility);
    } else if (const auto* text = std::get_if<TextInput>(&input)) {
        if (text->character == U'?' && !claims.keyboard) visit.shows_help = !visit.shows_help;
    } else if (const auto* button = std::get_if<ButtonInput>(&input)) {
        if (button->button == MouseButton::right)
            is_looking_ = button->down && !claims.mouse;
        else if (button->button == MouseButton::left && button->down && !claims.mouse)
            press_left(visit, rays);
        else if (button->button == MouseButton::left && !button->down)
            release_left(visit, visibility, rays);
    } else if (const auto* cursor = std::get_if<CursorInput>(&input)) {
        move(cursor->position, claims.mouse, visit, rays);
    } else if (const auto* wheel = std::get_if<WheelInput>(&input)) {
        if (!claims.mouse)
            visit.camera.set_speed(visit.camera.speed() * std::pow(wheel_factor, wheel->notches));
    } else if (std::holds_alternative<FocusLost>(input)) {
        let_go(visit);
    }
}

void Gestures::advance(double seconds, Visit& visit, const Walls* walls) {
    if (!is_walking()) return;
    const auto between = [this](Key plus, Key also_plus, Key minus, Key also_minus) {
        return double(held(plus) || held(also_plus)) - double(held(minus) || held(also_minus));
    };
    WalkDirection way;
    way.forward = between(Key::w, Key::up, Key::s, Key::down);
    way.right = between(Key::d, Key::right, Key::a, Key::left);
    way.up = between(Key::e, Key::e, Key::q, Key::q);
    const double pace = held(Key::shift) ? fast : held(Key::alt) ? slow : 1;
    visit.camera.walk(way, pace * std::min(seconds, longest_step), walls);
}

bool Gestures::is_walking() const {
    constexpr Key walking[] = {Key::w, Key::a,  Key::s,    Key::d,    Key::q,
                               Key::e, Key::up, Key::down, Key::left, Key::right};
    return !held(Key::control) &&
           std::any_of(std::begin(walking), std::end(walking), [this](Key k) { return held(k); });
}

void Gestures::press(Key key, Visit& visit, const Visibility& visibility) {
    if (held(Key::control)) return press_with_control(key, visit);
    if (key >= Key::digit_1 && key <= Key::digit_7) {
        visit.view.picture =
            static_cast<Picture>(static_cast<int>(key) - static_cast<int>(Key::digit_1));
        return;
    }
    constexpr double third_of_a_stop = 1.0 / 3;
    switch (key) {
        case Key::f:
            visit.looks_freely = !visit.looks_freely;
            cursor_.reset();
            break;
        case Key::escape:
            if (visit.looks_freely) cursor_.reset();
            visit.looks_freely = visit.shows_help = false;
            break;
        case Key::n:
            visit.through_walls = !visit.through_walls;
            break;
        case Key::home:
            visit.ask(Command::first_camera);
            break;
        case Key::l:
            visit.add_light(visibility);
            break;
        case Key::remove:
            visit.remove_selected();
            break;
        case Key::space:
            if (const EditedLight* light = visit.selected_light()) {
                EditedLight switched = *light;
                switched.on = !switched.on;
                visit.edits.change(*visit.selected, switched);
                visit.edits.settle();
            }
            break;
        case Key::minus:
            visit.view.exposure -= third_of_a_stop;
            break;
        case Key::period:
            visit.view.exposure += third_of_a_stop;
            break;
        case Key::x:
            visit.ask(Command::expose);
            break;
        case Key::f1:
            visit.shows_help = !visit.shows_help;
            break;
        case Key::f5:
            visit.ask(Command::reload);
            break;
        case Key::f12:
            visit.ask(held(Key::shift) ? Command::picture_exr : Command::picture_png);
            break;
        case Key::tab:
            visit.shows_panel = !visit.shows_panel;
            break;
        default:
            break;
    }
}

void Gestures::press_with_control(Key key, Visit& visit) {
    switch (key) {
        case Key::z:
            held(Key::shift) ? visit.redo() : visit.undo();
            break;
        case Key::y:
            visit.redo();
            break;
        case Key::s:
            visit.ask(Command::save_lights);
            break;
        case Key::o:
            visit.ask(Command::load_lights);
            break;
        case Key::q:
            visit.ask(Command::quit);
            break;
        default:
            break;
    }
}

void Gestures::press_left(Visit& visit, const CameraRays& rays) {
    if (visit.looks_freely) {
        visit.looks_freely = false;
        cursor_.reset();
        return;
    }
    if (!cursor_) return;
    Handle handle = selected_handle_at(visit, rays, *cursor_);
    if (handle == Handle::none && visit.shows_handles)
        if (const auto picked = light_at(visit, rays, *cursor_)) {
            visit.selected = picked;
            handle = Handle::centre;
        }
    if (handle == Handle::none) {
        pressed_ = cursor_;
        return;
    }
    visit.edits.settle();
    drag_.emplace(rays, visit.selected_light()->light, handle, *cursor_);
}

void Gestures::release_left(Visit& visit, const Visibility& visibility, const CameraRays& rays) {
    if (pressed_)
        visit.probed = surface_along(visibility, rays.position(),
                                     rays.direction((*pressed_)[0], (*pressed_)[1]));
    if (drag_) visit.edits.settle();
    pressed_.reset();
    drag_.reset();
    is_looking_ = false;
}

void Gestures::move(const Vec2& to, bool claimed, Visit& visit, const CameraRays& rays) {
    const Vec2 by = cursor_ ? Vec2(to - *cursor_) : Vec2::Zero();
    cursor_ = to;
    if (pressed_ && (to - *pressed_).norm() > click_reach) {
        pressed_.reset();
        is_looking_ = true;
    }
    // The light may have been deleted in the hand.
    if (!visit.selected_light()) drag_.reset();
    if (drag_) {
        EditedLight light = *visit.selected_light();
        const Light& moved = drag_->moved_to(to);
        if (position_of(moved) == position_of(light.light) && drag_->handle() != Handle::aim)
            return;
        light.light = moved;
        visit.edits.change(*visit.selected, light);
        return;
    }
    hovered_ = claimed ? Handle::none : selected_handle_at(visit, rays, to);
    if (is_looking_ || visit.looks_freely)
        visit.camera.look(degrees_per_pixel * by[0], -degrees_per_pixel * by[1]);
}

void Gestures::let_go(Visit& visit) {
    held_.fill(false);
    pressed_.reset();
    drag_.reset();
    is_looking_ = visit.looks_freely = false;
    cursor_.reset();
    visit.edits.settle();
}

}  // namespace lightwell
