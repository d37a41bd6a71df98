#include "reports/chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Chart two_curves() {
  Chart chart("curves");
  chart.set("kind", 0.0).set("count", 2.0).set("y_low", 0.0).set("y_high", 1.0);
  chart.set("x_low", 400.0).set("x_high", 500.0);
  chart.block("curves", {{{400.0, 0.1}, {500.0, 0.25}}, {{400.0, 0.5}, {500.0, not_a_number}}});
  return chart;
}

TEST(Chart, GivesGnuplotNumbersThenTheTemplate) {
  const std::string script = two_curves().script();
  EXPECT_TRUE(
      script.starts_with("kind = 0 \ncount = 2 \ny_low = 0 \ny_high = 1 \nx_low = 400 "
                         "\nx_high = 500 \n$curves << END_OF_NUMBERS\n400 0.1 \n"
                         "500 0.25 \n\n\n400 0.5 \n500 NaN \n\n\nEND_OF_NUMBERS\n"))
      << script;
  EXPECT_THAT(script, HasSubstr("$curves index"));
}

// The names of a chart are compiled in: no text that came from anywhere can become one.
static_assert(!std::is_constructible_v<FixedName, std::string>);

TEST(Chart, IsOneSvgElementWithIdsOfItsOwn) {
  const std::string svg = two_curves().svg(7);
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_THAT(svg, HasSubstr("viewBox"));
  EXPECT_THAT(svg, testing::ContainsRegex("id=.chart7_gp"));
  EXPECT_THAT(svg, Not(testing::ContainsRegex("id=.gp")));
  EXPECT_THAT(svg, Not(testing::ContainsRegex("href=.#gp")));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_THAT(svg.substr(0, svg.find('>')), Not(HasSubstr("width=")));
}

TEST(Chart, IsDrawnOfOnePointToo) {
  Chart chart("curves");
  chart.set("kind", 1.0).set("count", 1.0).set("y_low", 0.0).set("y_high", 1.0);
  chart.set("x_low", 500.0).set("x_high", 600.0);
  chart.block("curves", {{{550.0, 1.0}}});
  EXPECT_THAT(chart.svg(1), HasSubstr("</svg>"));
}

}  // namespace
}  // namespace gonio
