#include "viewer/charts/chart_page.h"

#include <nlohmann/json.hpp>

namespace lightwell {

namespace {

constexpr const char* style =
    "body{font-family:sans-serif;max-width:62em;margin:2em auto;line-height:1.4;color:#222}"
    "figure{margin:2em 0}figcaption{color:#444;max-width:46em}svg{max-width:100%;height:auto}"
    "table{border-collapse:collapse;font-size:0.85em}th,td{padding:0.25em 0.7em;text-align:right;"
    "border-bottom:1px solid #ddd}th:first-child,td:first-child{text-align:left}";

std::string row_of(const std::vector<std::string>& cells, const std::string& tag) {
    std::string row = "<tr>";
    for (const std::string& cell : cells)
        row += "<" + tag + ">" + escaped(cell) + "</" + tag + ">";
    return row + "</tr>\n";
}

/// Names of files may hold any bytes: those that are no letters become U+FFFD.
std::string valid_utf8(const std::string& text) {
    using nlohmann::json;
    return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : valid_utf8(text)) {
        if (letter == '&')
            result += "&amp;";
        else if (letter == '<')
            result += "&lt;";
        else if (letter == '>')
            result += "&gt;";
        else if (letter >= 0 && letter < ' ')
            result += ' ';
        else
            result += letter;
    }
    return result;
}

std::string html_of(const ChartPage& page) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>" +
        escaped(page.title) + "</title>\n<style>" + style + "</style></head>\n<body>\n<h1>" +
        escaped(page.title) + "</h1>\n";
    for (const std::string& paragraph : page.paragraphs)
        html += "<p>" + escaped(paragraph) + "</p>\n";
    for (const auto& [svg, caption] : page.pictures)
        html += "<figure>\n" + svg + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
    for (const PageTable& table : page.tables) {
        html += "<h2>" + escaped(table.title) + "</h2>\n<table>\n" + row_of(table.head, "th");
        for (const std::vector<std::string>& row : table.rows)
            html += row_of(row, "td");
        html += "</table>\n";
    }
    return html + "</body></html>\n";
}

}  // namespace lightwell
