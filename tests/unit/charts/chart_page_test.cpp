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

TEST(Escaped, IsTextThatHtmlAndXmlTake) {
    EXPECT_EQ(escaped("a<b>&c"), "a&lt;b&gt;&amp;c");
    EXPECT_EQ(escaped("r\u00e4ume"), "r\u00e4ume");
    EXPECT_EQ(escaped("bell\a tab\t line\n"), "bell  tab  line ");
    EXPECT_EQ(escaped("la\xe4 t"), "la\ufffd t");
}

}  // namespace
}  // namespace lightwell
