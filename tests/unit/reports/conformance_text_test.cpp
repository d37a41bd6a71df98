#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/reports/example_report.hpp"
#include "tests/unit/reports/hostile_report.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ConformanceText, ShowsOnlyCasesThatDidNotComeOutAsTheyShould) {
  const std::string text = conformance_text(test::example_report(), false);
  EXPECT_THAT(text, HasSubstr("geometry/incidence_60/as_stated: fail\n"));
  EXPECT_THAT(text, Not(HasSubstr("offset_beyond_limit")));
}

TEST(ConformanceText, HasEscapesOnlyWhereItIsStyled) {
  const ConformanceReport report = test::hostile_report(test::hostile_text("trace"));
  EXPECT_THAT(conformance_text(report, false), Not(HasSubstr("\033")));
  EXPECT_THAT(conformance_text(report, true), HasSubstr("\033[1mfail\033[0m"));
  EXPECT_THAT(conformance_text(report, true), Not(HasSubstr("\033[31m")));
}

}  // namespace
}  // namespace gonio
