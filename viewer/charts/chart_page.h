#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lightwell {

/// A table of text.
struct PageTable {
    std::string title;
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

/// What goes on a page of charts.
struct ChartPage {
    std::string title;
    std::vector<std::string> paragraphs;                        ///< before the charts
    std::vector<std::pair<std::string, std::string>> pictures;  ///< SVG, and what it shows
    std::vector<PageTable> tables;                              ///< after them
};

/// One HTML file that needs nothing else.
std::string html_of(const ChartPage& page);

/// Text as it must stand in HTML or SVG. Control characters, which must not, become blanks, and
/// bytes that are no UTF-8 become U+FFFD.
std::string escaped(const std::string& text);

}  // namespace lightwell
