#pragma once

#include <string>

#include "viewer/images/image.h"

namespace lightwell {

/// Size of a glyph's box before scaling [pixels]; the box includes one column of space.
constexpr int glyph_width = 6;
constexpr int glyph_height = 7;

/// Writes a line of text with its upper left corner at (x,y), every dot `scale` pixels wide, in
/// plain `colour`. The built-in glyphs are 0-9, '.', '-', '/', '>', 'c', 'd', 'k', 'l', 'm', 'x'
/// and the space; any other character is drawn as a filled box. What falls outside the picture is
/// left out.
void draw_text(Image& image, int x, int y, const std::string& text, const Image::Pixel& colour,
               int scale);

/// Fills the rectangle [x, x+width) x [y, y+height), as far as it lies in the picture.
void fill_rectangle(Image& image, int x, int y, int width, int height, const Image::Pixel& colour);

}  // namespace lightwell
