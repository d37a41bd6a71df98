#include "emulator/uncertainty/distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using Shape = Distribution::Shape;
using test::is_close;
using test::message_of;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;

// Coverage factors: JCGM 100:2008, table G.2, as it is rounded there.

struct TableRow {
  double degrees_of_freedom, k_95, k_99;
};
const std::vector<TableRow> table_g2 = {{1, 12.71, 63.66}, {2, 4.30, 9.92},        {3, 3.18, 5.84},
                                        {4, 2.78, 4.60},   {5, 2.57, 4.03},        {10, 2.23, 3.17},
                                        {16, 2.12, 2.92},  {19, 2.09, 2.86},       {20, 2.09, 2.85},
                                        {30, 2.04, 2.75},  {infinite, 1.96, 2.576}};
constexpr double table_rounding = 0.00501;

TEST(CoverageFactor, EqualsTheTableOfTheGuide) {
  for (const TableRow& row : table_g2) {
    EXPECT_TRUE(is_close(coverage_factor(row.degrees_of_freedom), row.k_95, table_rounding))
        << row.degrees_of_freedom;
    EXPECT_TRUE(is_close(coverage_factor(row.degrees_of_freedom, 0.99), row.k_99, table_rounding))
        << row.degrees_of_freedom;
  }
}

TEST(CoverageFactor, OfOneDegreeOfFreedomIsThatOfCauchy) {
  EXPECT_TRUE(is_close(coverage_factor(1.0, 0.5), 1.0, rounding));
  EXPECT_TRUE(is_close(coverage_factor(1.0, 0.95), 12.706204736174698, 1e-11));
}

TEST(CoverageFactor, FallsWithDegreesOfFreedomThatAreNotWhole) {
  double before = coverage_factor(0.5);
  for (double nu = 0.7; nu < 300.0; nu *= 1.3) {
    const double k = coverage_factor(nu);
    EXPECT_LT(k, before) << nu;
    before = k;
  }
  EXPECT_GT(before, coverage_factor(infinite));
}

TEST(CoverageFactor, RefusesWhatIsNone) {
  EXPECT_THROW((void)coverage_factor(0.0), std::domain_error);
  EXPECT_THROW((void)coverage_factor(std::nan("")), std::domain_error);
  EXPECT_THROW((void)coverage_factor(5.0, 0.0), std::domain_error);
  EXPECT_EQ(message_of([] { (void)coverage_factor(5.0, 1.0); }),
            "coverage_factor: expected a coverage in (0, 1), found 1");
  EXPECT_EQ(message_of([] { (void)coverage_factor(-1.0); }),
            "coverage_factor: expected degrees of freedom > 0, found -1");
}

// Quantiles.

TEST(Quantile, OfANormalDistributionEqualsItsTable) {
  const Distribution unit{.standard_uncertainty = 1.0};
  EXPECT_EQ(quantile(unit, 0.5), 0.0);
  EXPECT_TRUE(is_close(quantile(unit, 0.975), 1.959963984540054, rounding));
  EXPECT_TRUE(is_close(quantile(unit, 0.9), 1.2815515655446004, rounding));
  EXPECT_TRUE(is_close(quantile(unit, 0.001), -3.090232306167813, rounding));
}

TEST(Quantile, OfStudentIsScaledByTheStandardUncertainty) {
  const Distribution few{
      .shape = Shape::student, .standard_uncertainty = 0.2, .degrees_of_freedom = 3.0};
  EXPECT_TRUE(is_close(quantile(few, 0.975), 0.2 * coverage_factor(3.0), rounding));
  // However it is called.
  const Distribution normal{.standard_uncertainty = 0.2, .degrees_of_freedom = 3.0};
  EXPECT_EQ(quantile(normal, 0.9), quantile(few, 0.9));
}

TEST(Quantile, OfABoundedDistributionReachesItsBounds) {
  for (const Shape shape : {Shape::rectangular, Shape::triangular, Shape::arcsine}) {
    const Distribution bounded = Distribution::bounded(shape, 3.0);
    constexpr double almost = 1e-14;  // what is left of 3 at its square root is 4e-7
    constexpr double at_almost = 1e-6;
    EXPECT_TRUE(is_close(quantile(bounded, almost), -3.0, at_almost));
    EXPECT_TRUE(is_close(quantile(bounded, 1.0 - almost), 3.0, at_almost));
    EXPECT_TRUE(is_close(quantile(bounded, 0.5), 0.0, rounding));
  }
}

TEST(Quantile, OfBoundedDistributionsEqualsTheClosedForm) {
  const auto at_90 = [](Shape shape) { return quantile(Distribution::bounded(shape, 1.0), 0.9); };
  EXPECT_TRUE(is_close(at_90(Shape::rectangular), 0.8, rounding));
  EXPECT_TRUE(is_close(at_90(Shape::triangular), 1.0 - std::sqrt(0.2), rounding));
  EXPECT_TRUE(is_close(at_90(Shape::arcsine), std::cos(0.1 * std::acos(-1.0)), rounding));
}

TEST(Quantile, IsOddAboutTheMiddle) {
  for (const Shape shape :
       {Shape::normal, Shape::student, Shape::rectangular, Shape::triangular, Shape::arcsine}) {
    const Distribution any{.shape = shape, .standard_uncertainty = 0.7, .degrees_of_freedom = 4.5};
    for (const double p : {0.01, 0.2, 0.4375}) {
      EXPECT_TRUE(is_close(quantile(any, p), -quantile(any, 1.0 - p), rounding));
    }
  }
}

TEST(Quantile, OfWhatIsKnownForSureIsZero) {
  for (const Shape shape :
       {Shape::normal, Shape::student, Shape::rectangular, Shape::triangular, Shape::arcsine}) {
    EXPECT_EQ(quantile({.shape = shape}, 0.9), 0.0);
  }
}

TEST(Quantile, RefusesWhatIsNone) {
  EXPECT_EQ(message_of([] { (void)quantile({}, 1.0); }), "quantile: expected p in (0, 1), found 1");
  EXPECT_EQ(message_of([] { (void)quantile({.standard_uncertainty = -1.0}, 0.5); }),
            "quantile: expected a standard uncertainty >= 0, found -1");
  EXPECT_EQ(message_of([] { (void)quantile({.degrees_of_freedom = 0.0}, 0.5); }),
            "quantile: expected degrees of freedom > 0, found 0");
}

// Half widths.

TEST(BoundedDistribution, HasTheStandardUncertaintyOfItsShape) {
  const auto u_of = [](Shape shape) {
    return Distribution::bounded(shape, 6.0).standard_uncertainty;
  };
  EXPECT_TRUE(is_close(u_of(Shape::rectangular), 6.0 / std::sqrt(3.0), rounding));
  EXPECT_TRUE(is_close(u_of(Shape::triangular), 6.0 / std::sqrt(6.0), rounding));
  EXPECT_TRUE(is_close(u_of(Shape::arcsine), 6.0 / std::sqrt(2.0), rounding));
}

TEST(BoundedDistribution, TellsItsHalfWidth) {
  for (const Shape shape : {Shape::rectangular, Shape::triangular, Shape::arcsine}) {
    EXPECT_TRUE(is_close(Distribution::bounded(shape, 0.05).half_width(), 0.05, rounding));
    EXPECT_EQ(Distribution::bounded(shape, 0.0).half_width(), 0.0);
  }
  EXPECT_EQ(Distribution{}.half_width(), infinite);
  EXPECT_EQ(Distribution{.shape = Shape::student}.half_width(), infinite);
}

TEST(BoundedDistribution, RefusesWhatIsNone) {
  EXPECT_THROW((void)Distribution::bounded(Shape::normal, 1.0), std::domain_error);
  EXPECT_THROW((void)Distribution::bounded(Shape::student, 1.0), std::domain_error);
  EXPECT_EQ(message_of([] { (void)Distribution::bounded(Shape::rectangular, -1.0); }),
            "Distribution::bounded: expected a half width >= 0, found -1");
}

}  // namespace
}  // namespace gonio
