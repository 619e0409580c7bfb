#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "viewer/window/input.h"

namespace lightwell {

/// Input as text, one statement a line; # starts a comment.
///
/// | statement         | meaning                                                              |
/// |-------------------|----------------------------------------------------------------------|
/// | key NAME down     | a key goes down, or up (see name_of)                                 |
/// | text NUMBER       | a character is typed, by its Unicode number                          |
/// | button NAME down  | left, right or middle goes down, or up                               |
/// | cursor X Y        | the cursor moves there [pixels from the upper left corner]           |
/// | wheel NOTCHES     | the wheel turns, away from the user                                  |
/// | size WIDTH HEIGHT | the window's content gets that size [pixels]                         |
/// | drop PATH         | a file is dropped on the window                                      |
/// | focus lost        | the window is left                                                   |
/// | picture PATH      | the picture is written to a .png or .exr                             |
/// | window PATH       | the window, with the panel, is written to a .png                     |
/// | memory PATH       | the bytes in use after the frame are written to a file, as a number  |
/// | frame SECONDS     | a frame is drawn, that long after the one before; then it goes on    |
/// | frames N SECONDS  | N of these                                                           |
///
/// What stands before a frame is delivered before it is drawn. Statements after the last frame are
/// delivered before one more frame of no duration.
/// @param source  what the text came from, for messages
/// @throws InputError with line and column of what is wrong
std::vector<InputFrame> input_from_text(const std::string& text, const std::string& source);

/// The same, the other way round. Numbers are exact.
std::string text_of(const InputFrame& frame);

}  // namespace lightwell
