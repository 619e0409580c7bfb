#include "viewer/charts/chart.h"

#include <cmath>

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
    EXPECT_EQ(count(svg, "<circle "), 3);
    EXPECT_EQ(count(svg, "<polyline "), 2);
    EXPECT_NE(svg.find(">a &lt; b &amp; c<"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(csv_of(chart), "series,quads,rays\none,1,10\none,10,1000000\ntwo,5,5\n");
}

TEST(Chart, OfOnePointHasAxes) {
    const std::string svg = svg_of({"one", "x", "y", {{"only", {{2, 3}}}}});
    EXPECT_EQ(count(svg, "<circle "), 1);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace lightwell
