#include "reports/limit_words.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/reports/example_report.hpp"

namespace gonio {
namespace {

using enum ConformanceVerdict;

TEST(NumberText, HasSixDigitsAndNoSignedZero) {
  EXPECT_EQ(number_text(60.04), "60.04");
  EXPECT_EQ(number_text(1.0 / 3.0), "0.333333");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(1.5, "GU"), "1.5 GU");
}

TEST(NumberText, SaysWhatIsNoNumber) {
  EXPECT_EQ(number_text(std::nan(""), "GU"), "not a number");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity(), "GU"), "minus infinite");
}

TEST(ObservationText, PutsValueUncertaintyAndLimitIntoWords) {
  EXPECT_EQ(observation_text(test::angle_found(60.04, 60.0, 0.1, pass)),
            "theta_i at 60: 60.04 +- 0.02 deg, limit 60 +- 0.1 deg (nominal of the standard)");
}

TEST(ObservationText, SaysHowLimitsLie) {
  Observation found{.quantity = "q", .unit = "GU", .value = 1.0};
  EXPECT_EQ(observation_text(found), "q: 1 GU, no limit");
  found.expected = 2.0;
  EXPECT_EQ(observation_text(found), "q: 1 GU, expected 2 GU");
  found.low = 0.5;
  EXPECT_EQ(observation_text(found), "q: 1 GU, limit at least 0.5 GU");
  found.high = 4.0;
  EXPECT_EQ(observation_text(found), "q: 1 GU, limit 0.5 to 4 GU");
  found.low.reset();
  EXPECT_EQ(observation_text(found), "q: 1 GU, limit at most 4 GU");
}

TEST(ObservationText, ShowsTextsWhereThereAreNoNumbers) {
  const Observation found{.quantity = "refusal",
                          .geometry = "60",
                          .subject = "tile",
                          .found = "none",
                          .expected_text = "warming_up",
                          .note = "at once"};
  EXPECT_EQ(observation_text(found), "refusal at 60, tile: none, expected warming_up; at once");
  EXPECT_EQ(observation_text({.quantity = "q"}), "q: nothing, no limit");
}

TEST(ObservationText, ShowsOnWhichSideOfTheLimitAValueLies) {
  Observation found{.quantity = "q", .value = 0.5 + 1e-9, .high = 0.5};
  EXPECT_EQ(observation_text(found), "q: 0.500000001, limit at most 0.5");
  found.value = 0.5;
  EXPECT_EQ(observation_text(found), "q: 0.5, limit at most 0.5");
}

TEST(LimitText, SaysWhatIsNotKnown) {
  EXPECT_EQ(limit_text(LimitRow{}), "not known");
  EXPECT_EQ(limit_text(LimitRow{.unit = "deg", .nominal = 60.0}), "60 deg, tolerance not known");
  EXPECT_EQ(limit_text(LimitRow{.unit = "deg", .nominal = 60.0, .tolerance = 0.1}),
            "60 +- 0.1 deg");
}

}  // namespace
}  // namespace gonio
