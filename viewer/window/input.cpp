#include "viewer/window/input.h"

#include <algorithm>
#include <array>

namespace lightwell {

namespace {

/// In the order of Key.
constexpr std::array<std::string_view, key_count> names = {
    "unknown", "a",       "b",       "c",         "d",       "e",       "f",       "g",
    "h",       "i",       "j",       "k",         "l",       "m",       "n",       "o",
    "p",       "q",       "r",       "s",         "t",       "u",       "v",       "w",
    "x",       "y",       "z",       "digit_0",   "digit_1", "digit_2", "digit_3", "digit_4",
    "digit_5", "digit_6", "digit_7", "digit_8",   "digit_9", "minus",   "period",  "space",
    "tab",     "enter",   "escape",  "backspace", "delete",  "home",    "end",     "left",
    "right",   "up",      "down",    "shift",     "control", "alt",     "f1",      "f5",
    "f12"};

}  // namespace

std::string_view name_of(Key key) {
    return names[static_cast<std::size_t>(key)];
}

Key key_named(std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? Key::unknown : static_cast<Key>(found - names.begin());
}

}  // namespace lightwell
