#include "viewer/charts/chart.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(Chart, FitsAPowerLaw) {
    std::vector<std::pair<double, double>> exact;
    for (const double x : {1.0, 3.0, 20.0, 1000.0})
        exact.emplace_back(x, 2.5 * std::pow(x, -1.25));
    EXPECT_NEAR(fitted_power(exact).exponent, -1.25, 1e-12);
    EXPECT_NEAR(fitted_power(exact).factor, 2.5, 1e-11);
    // Off by the same factor, up at both ends and down in the middle: the exponent stays.
    const PowerLaw law = fitted_power({{1, 2}, {10, 10.0 / 4}, {100, 200}});
    EXPECT_NEAR(law.exponent, 1, 1e-12);
    EXPECT_NEAR(law.factor, 1, 1e-12);
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
        ++found;
    return found;
}

TEST(Chart, DrawsEveryPointOfEverySeries) {
    const Chart chart{
        "a < b & c", "quads", "rays", {{"one", {{1, 10}, {10, 1e6}}}, {"two", {{5, 5}}}}};
    const std::string svg = svg_of(chart);
    EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_EQ(count(svg, "class=\"point\""), 3);
    EXPECT_EQ(count(svg, ">one</text>"), 1);
    EXPECT_EQ(count(svg, ">two</text>"), 1);
    EXPECT_NE(svg.find(">a &lt; b &amp; c<"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(csv_of(chart), "series,quads,rays\none,1,10\none,10,1000000\ntwo,5,5\n");
}

TEST(Chart, OfOnePointHasAxes) {
    const std::string svg = svg_of({"one", "x", "y", {{"only", {{2, 3}}}}});
    EXPECT_EQ(count(svg, "class=\"point\""), 1);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Chart, DrawsALimitWithoutPointsAndNoLineBetweenWhatDoesNotFollow) {
    Series limit{"limit", {{1, 10}, {10, 1}}};
    limit.is_limit = true;
    Series apart{"apart", {{1, 10}, {10, 1}}};
    apart.is_joined = false;
    const auto lines = [](const std::string& svg) { return count(svg, "stroke-dasharray"); };
    const std::string of_limit = svg_of({"", "x", "y", {limit}}),
                      of_points = svg_of({"", "x", "y", {apart}});
    EXPECT_EQ(count(of_limit, "class=\"point\""), 0);
    EXPECT_EQ(lines(of_limit), 2);  // with that of the legend
    EXPECT_EQ(count(of_points, "class=\"point\""), 2);
    EXPECT_EQ(lines(of_points), 0);
}

TEST(Chart, SaysWhatIsKnownOfEachPoint) {
    Series named{"fast, good", {{1, 2}, {3, 4}}};
    named.spans = {{1, 5}, {3, 6}};
    named.labels = {"asked 5 %", "a \"b\""};
    Chart chart{"", "x", "y", {named, {"plain", {{1, 2}}}}};
    chart.ringed = {{3, 4}};
    EXPECT_EQ(csv_of(chart),
              "series,x,y,low,high,setting,ringed\n"
              "\"fast, good\",1,2,1,5,asked 5 %,0\n"
              "\"fast, good\",3,4,3,6,\"a \"\"b\"\"\",1\n"
              "plain,1,2,,,,0\n");
}

/// Pairs of numbers where a chart's text has a form of scanf's: two %lf, and %n at its end. (No
/// std::regex: with the sanitizers, GCC 12 warns inside its own header.)
std::vector<std::pair<double, double>> pairs_of_numbers(const std::string& svg, const char* form) {
    std::vector<std::pair<double, double>> pairs;
    for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
        double first = 0, second = 0;
        int length = 0;
        if (std::sscanf(svg.c_str() + at, form, &first, &second, &length) == 2 && length > 0)
            pairs.emplace_back(first, second);
    }
    return pairs;
}

/// Places of the names in a chart.
std::vector<std::pair<double, double>> placed_names(const std::string& svg) {
    return pairs_of_numbers(svg,
                            "<text x=\"%lf\" y=\"%lf\" text-anchor=\"start\" font-size=\"11\"%n");
}

TEST(Chart, NamesPointsWithoutWritingOverAnother) {
    Series close{"close", {{1, 1}, {1.001, 1.001}, {0.999, 1}, {100, 100}}};
    close.labels = {"cells x 2", "cells x 3", "cells x 4", "far"};
    close.shows_labels = true;
    const auto places = placed_names(svg_of({"", "x", "y", {close}}));
    ASSERT_EQ(places.size(), 4U);
    constexpr double height_of_a_line = 11, width_of_a_name = 50;
    for (std::size_t a = 0; a < places.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_TRUE(std::abs(places[a].second - places[b].second) >= height_of_a_line ||
                        std::abs(places[a].first - places[b].first) >= width_of_a_name)
                << a << " on " << b;
}

TEST(Chart, EndsIntervalsThatLeaveItAtItsAxis) {
    Series wide{"wide", {{1, 10}, {2, 12}}};
    wide.spans = {{1e-9, 1e9}, {11, 13}};
    const std::string svg = svg_of({"", "x", "y", {wide}});
    const auto spans = pairs_of_numbers(svg, "<path d=\"M%*lf %lfV%lf%n");
    for (const auto& [low, high] : spans)
        for (const double y : {low, high}) {
            EXPECT_GE(y, 50);   // the frame's top
            EXPECT_LE(y, 440);  // and its bottom
        }
    EXPECT_EQ(spans.size(), 2U);
    EXPECT_EQ(count(svg, "l4 -6m-4 6l-4 -6"), 1);  // arrows of the one that does
    EXPECT_EQ(count(svg, "l4 6m-4 -6l-4 6"), 1);
}

TEST(Csv, QuotesFieldsThatNeedIt) {
    EXPECT_EQ(csv_field("plain text"), "plain text");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("say \"so\""), "\"say \"\"so\"\"\"");
    EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

}  // namespace
}  // namespace lightwell
