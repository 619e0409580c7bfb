#include "viewer/images/lettering.h"

#include <algorithm>
#include <array>

namespace lightwell {

namespace {

/// Seven rows of five dots.
struct Glyph {
    char character;
    std::array<const char*, glyph_height> rows;
};

constexpr Glyph glyphs[] = {
    {' ', {"     ", "     ", "     ", "     ", "     ", "     ", "     "}},
    {'0', {" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "# #  ", "  #  ", "  #  ", "  #  ", "#####"}},
    {'2', {" ### ", "#   #", "    #", "  ## ", " #   ", "#    ", "#####"}},
    {'3', {"#### ", "    #", "    #", " ### ", "    #", "    #", "#### "}},
    {'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {"  ## ", " #   ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "   # ", "  #  ", "  #  ", "  #  "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "   # ", " ##  "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}},
    {'-', {"     ", "     ", "     ", "#####", "     ", "     ", "     "}},
    {'/', {"    #", "    #", "   # ", "  #  ", " #   ", "#    ", "#    "}},
    {'>', {"#    ", " #   ", "  #  ", "   # ", "  #  ", " #   ", "#    "}},
    {'c', {"     ", "     ", " ### ", "#    ", "#    ", "#    ", " ### "}},
    {'d', {"    #", "    #", " ####", "#   #", "#   #", "#   #", " ####"}},
    {'k', {"#    ", "#    ", "#  # ", "# #  ", "##   ", "# #  ", "#  # "}},
    {'l', {" ##  ", "  #  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    {'m', {"     ", "     ", "## # ", "# # #", "# # #", "# # #", "# # #"}},
    {'x', {"     ", "     ", "#   #", " # # ", "  #  ", " # # ", "#   #"}},
};
constexpr std::array<const char*, glyph_height> unknown = {"#####", "#####", "#####", "#####",
                                                           "#####", "#####", "#####"};

const std::array<const char*, glyph_height>& rows_of(char character) {
    const auto* found = std::find_if(std::begin(glyphs), std::end(glyphs), [=](const Glyph& glyph) {
        return glyph.character == character;
    });
    return found == std::end(glyphs) ? unknown : found->rows;
}

}  // namespace

void draw_text(Image& image, int x, int y, const std::string& text, const Image::Pixel& colour,
               int scale) {
    for (const char character : text) {
        const auto& rows = rows_of(character);
        for (int row = 0; row < glyph_height; ++row)
            for (int column = 0; column < glyph_width - 1; ++column)
                if (rows[static_cast<std::size_t>(row)][column] == '#')
                    fill_rectangle(image, x + column * scale, y + row * scale, scale, scale,
                                   colour);
        x += glyph_width * scale;
    }
}

void fill_rectangle(Image& image, int x, int y, int width, int height, const Image::Pixel& colour) {
    for (int row = std::max(0, y); row < std::min(image.height(), y + height); ++row)
        for (int column = std::max(0, x); column < std::min(image.width(), x + width); ++column)
            image.at(column, row) = colour;
}

}  // namespace lightwell
