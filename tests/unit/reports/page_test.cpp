#include "reports/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "reports/templates.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;

TEST(Anchor, IsOneWordThatNoOtherTextHas) {
  EXPECT_EQ(anchor("clause", "geometry/incidence_60"), "clause-geometry/incidence_60");
  EXPECT_EQ(anchor("clause", "a b\"<"), "clause-a.20b.22.3C");
  EXPECT_NE(anchor("clause", "a b"), anchor("clause", "a.20b"));
}

TEST(Typeset, WritesPlusAndMinusAsOneSign) {
  EXPECT_EQ(typeset("60 +- 0.1 deg"), "60 \u00B1 0.1 deg");
  EXPECT_EQ(typeset("+-+-"), "\u00B1\u00B1");
  EXPECT_EQ(typeset("-1"), "-1");
}

TEST(SetText, LeavesOutTheSectionOfAnEmptyText) {
  PageData data;
  set_text(data, "text", "");
  EXPECT_TRUE(data.get("text")->is_false());
  set_text(data, "text", "a");
  EXPECT_EQ(data.get("text")->string_value(), "a");
}

TEST(RenderPage, EscapesItsTitle) {
  EXPECT_THAT(render_page("measurement", "<a> & b", PageData()),
              HasSubstr("<title>&lt;a&gt; &amp; b</title>"));
}

TEST(RenderPage, SaysWhatLanguageItIsAndForbidsTheNetwork) {
  const std::string page = render_page("measurement", "", PageData());
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

TEST(TemplateText, IsRefusedForANameThatThereIsNot) {
  EXPECT_THROW((void)template_text("nothing.mustache"), std::out_of_range);
}

}  // namespace
}  // namespace gonio
