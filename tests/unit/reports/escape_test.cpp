#include "reports/escape.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gonio {
namespace {

TEST(CleanText, KeepsTextAndItsLineBreaks) {
  EXPECT_EQ(clean_text("a\tb\r\n\u00DF \u5149 \U0001F4A1"), "a\tb\r\n\u00DF \u5149 \U0001F4A1");
}

TEST(CleanText, LosesControlCharacters) {
  EXPECT_EQ(clean_text(std::string("a\0b\x1B[1m\x7F\xC2\x9B", 11) + "c"), "ab[1mc");
}

TEST(CleanText, ReplacesBytesThatAreNoText) { EXPECT_EQ(clean_text("a\xFF\xC3"), "a\uFFFD\uFFFD"); }

TEST(CleanText, LosesWhatXmlForbids) { EXPECT_EQ(clean_text("a\xEF\xBF\xBE\xEF\xBF\xBF"), "a"); }

TEST(OneLine, HasSingleSpacesBetweenWords) {
  EXPECT_EQ(one_line(" a \n\t b\r\n"), "a b");
  EXPECT_EQ(one_line("\n"), "");
}

TEST(XmlText, HasNoMarkupAndKeepsLineBreaksOfAttributes) {
  EXPECT_EQ(xml_text("<a b='\"'>&amp;]]>\n\t\r"),
            "&lt;a b=&#39;&quot;&#39;&gt;&amp;amp;]]&gt;&#10;&#9;&#13;");
}

TEST(MarkdownText, HasNoMarkupAndOneLine) {
  EXPECT_EQ(markdown_text("a|b `c` *d* [e](f) <g> & ~h~ $i$ !\\\n# j"),
            R"(a\|b \`c\` \*d\* \[e\](f) &lt;g&gt; &amp; \~h\~ \$i\$ \!\\ # j)");
}

TEST(MarkdownText, LeavesIdsAsTheyAre) {
  EXPECT_EQ(markdown_text("geometry/incidence_60"), "geometry/incidence_60");
  EXPECT_EQ(markdown_text("_a_"), R"(\_a\_)");
}

TEST(CssText, LeavesNothingThatCouldEndAString) {
  EXPECT_EQ(css_text("No. 7"), "No\\00002E  7");
  EXPECT_EQ(css_text("\"\\;}</style>"),
            "\\000022 \\00005C \\00003B \\00007D \\00003C \\00002F style\\00003E ");
  EXPECT_EQ(css_text("a\nb\x1B \xFFStra\u00DFe"), "a b \uFFFDStra\u00DFe");
}

}  // namespace
}  // namespace gonio
