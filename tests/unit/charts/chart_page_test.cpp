#include "viewer/charts/chart_page.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

TEST(ChartPage, HoldsEverythingAndNeedsNothing) {
    ChartPage page;
    page.title = "a < b";
    page.paragraphs = {"one & two"};
    page.pictures = {{"<svg>drawn</svg>\n", "what > is drawn"}};
    page.tables = {{"costs", {"method", "s"}, {{"slow", "3"}, {"fast", "<1"}}}};
    const std::string html = html_of(page);
    for (const char* part :
         {"<title>a &lt; b</title>", "<p>one &amp; two</p>", "<svg>drawn</svg>",
          "what &gt; is drawn", "<h2>costs</h2>", "<th>method</th>", "<td>&lt;1</td>", "</html>"})
        EXPECT_NE(html.find(part), std::string::npos) << part;
    for (const char* outside : {"src=", "href=", "http"})
        EXPECT_EQ(html.find(outside), std::string::npos) << outside;
}

}  // namespace
}  // namespace lightwell
