#include "reports/uncertain_words.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gonio {
namespace {

TEST(UncertaintyText, HasTwoDigits) {
  EXPECT_EQ(uncertainty_text(0.4142), "0.41");
  EXPECT_EQ(uncertainty_text(0.0187), "0.019");
  EXPECT_EQ(uncertainty_text(1.234), "1.2");
  EXPECT_EQ(uncertainty_text(12.34), "12");
  EXPECT_EQ(uncertainty_text(123.4), "123");
  EXPECT_EQ(uncertainty_text(1.23e-7), "1.2e-07");
}

TEST(UncertaintyText, OfWhatIsNoNumberIsADash) {
  EXPECT_EQ(uncertainty_text(std::nan("")), "-");
  EXPECT_EQ(uncertainty_text(INFINITY), "-");
  EXPECT_EQ(uncertainty_text(0.0), "0.000");
}

TEST(MeasuredText, HasTheDecimalsOfItsUncertainty) {
  EXPECT_EQ(measured_text(92.4682, 0.31), "92.47");
  EXPECT_EQ(measured_text(92.4682, 3.1), "92.5");
  EXPECT_EQ(measured_text(92.4682, 31.0), "92");
  EXPECT_EQ(measured_text(-0.0001, 0.31), "0.00");
}

TEST(SignedText, HasASignButForZero) {
  EXPECT_EQ(signed_text(0.123, 2), "+0.12");
  EXPECT_EQ(signed_text(-0.123, 2), "-0.12");
  EXPECT_EQ(signed_text(0.001, 2), "0.00");
  EXPECT_EQ(signed_text(-0.001, 2), "0.00");
}

TEST(ProbabilityText, ClaimsNoCertainty) {
  EXPECT_EQ(probability_text(1.0), "> 99.9 %");
  EXPECT_EQ(probability_text(0.0), "< 0.1 %");
  EXPECT_EQ(probability_text(0.6914), "69.1 %");
  EXPECT_EQ(probability_text({}), "-");
}

TEST(DistributionText, IsStudentsForANormalOneThatHasFewDegreesOfFreedom) {
  EXPECT_EQ(distribution_text({}), "normal");
  EXPECT_EQ(distribution_text({.degrees_of_freedom = 12.0}), "Student, 12 degrees of freedom");
  EXPECT_EQ(distribution_text({.shape = Distribution::Shape::arcsine}), "arcsine");
}

}  // namespace
}  // namespace gonio
