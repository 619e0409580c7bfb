#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "radiance4d/scene/quad.h"

namespace lightwell {

/// A key by its place on the keyboard, as far as anything here or in the panel listens to it.
enum class Key {
    unknown,
    a,
    b,
    c,
    d,
    e,
    f,
    g,
    h,
    i,
    j,
    k,
    l,
    m,
    n,
    o,
    p,
    q,
    r,
    s,
    t,
    u,
    v,
    w,
    x,
    y,
    z,
    digit_0,
    digit_1,
    digit_2,
    digit_3,
    digit_4,
    digit_5,
    digit_6,
    digit_7,
    digit_8,
    digit_9,
    minus,
    period,
    space,
    tab,
    enter,
    escape,
    backspace,
    remove,
    home,
    end,
    left,
    right,
    up,
    down,
    shift,
    control,
    alt,
    f1,
    f5,
    f12
};
/// Number of keys, Key::unknown included.
constexpr std::size_t key_count = static_cast<std::size_t>(Key::f12) + 1;
/// "w", "digit_1", "shift"; Key::unknown for a name that there is not.
std::string_view name_of(Key key);
Key key_named(std::string_view name);

enum class MouseButton { left, right, middle };

// What a person does to a window. Places are pixels from the upper left corner of its content.
struct KeyInput {
    Key key = Key::unknown;
    bool down = true;
};
/// A character typed, whatever keys that took.
struct TextInput {
    char32_t character = U' ';
};
struct ButtonInput {
    MouseButton button = MouseButton::left;
    bool down = true;
};
struct CursorInput {
    Vec2 position = Vec2::Zero();
};
/// Notches of the wheel, away from the user.
struct WheelInput {
    double notches = 0;
};
struct SizeInput {
    int width = 1, height = 1;
};
/// A file dropped on the window.
struct DropInput {
    std::string path;
};
/// The cursor has left the window's program: nothing is held any more.
struct FocusLost {};
/// Writes what is shown into a file; only recorded input asks for it. `whole_window`: the panel
/// too, as a PNG; otherwise the picture alone, as for the key F12.
struct PictureInput {
    std::string path;
    bool whole_window = false;
};

/// Writes how many bytes are in use after the frame into a file; only recorded input asks for it.
struct MemoryInput {
    std::string path;
};

using Input = std::variant<KeyInput, TextInput, ButtonInput, CursorInput, WheelInput, SizeInput,
                           DropInput, FocusLost, PictureInput, MemoryInput>;

/// What happened before a frame, and how long the frame before it took.
struct InputFrame {
    double seconds = 0;
    std::vector<Input> inputs;
};

}  // namespace lightwell
