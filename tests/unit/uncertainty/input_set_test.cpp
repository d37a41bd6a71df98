#include "emulator/uncertainty/input_set.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::message_of;

constexpr double rounding = 1e-14;

/// So many normal inputs of standard uncertainty 1.
InputSet normals(int n) {
  InputSet inputs;
  for (int i = 0; i < n; ++i) {
    inputs.add({.id = fmt::format("x{}", i), .distribution = {.standard_uncertainty = 1.0}});
  }
  return inputs;
}

TEST(InputSet, TellsThePlaceOfWhatIsAdded) {
  InputSet inputs;
  EXPECT_EQ(inputs.add({.id = "a", .estimate = 1.0}), 0U);
  EXPECT_EQ(inputs.add({.id = "b", .estimate = 2.0}), 1U);
  EXPECT_EQ(inputs.size(), 2U);
  EXPECT_EQ(inputs.inputs()[1].id, "b");
  EXPECT_EQ(inputs.inputs()[1].estimate, 2.0);
}

TEST(InputSet, CorrelatesNothingByItself) {
  EXPECT_EQ(normals(3).correlation(), Eigen::MatrixXd::Identity(3, 3));
  EXPECT_EQ(normals(3).smallest_eigenvalue(), 1.0);
  EXPECT_EQ(InputSet().smallest_eigenvalue(), 1.0);
}

TEST(InputSet, CorrelatesBothWays) {
  InputSet inputs = normals(3);
  inputs.correlate(2, 0, -0.5);
  Eigen::Matrix3d expected;
  expected << 1, 0, -0.5, 0, 1, 0, -0.5, 0, 1;
  EXPECT_EQ(inputs.correlation(), Eigen::MatrixXd(expected));
}

TEST(InputSet, OfAPairHasTheEigenvalueOneMinusTheCoefficient) {
  for (const double r : {-0.9, 0.3, 1.0}) {
    InputSet inputs = normals(4);
    inputs.correlate(1, 3, r);
    EXPECT_TRUE(is_close(inputs.smallest_eigenvalue(), 1.0 - std::abs(r), rounding));
  }
}

TEST(InputSet, ThatContradictsItselfHasANegativeEigenvalue) {
  // Each goes against both others: 1 - 2 * 0.9.
  InputSet inputs = normals(3);
  inputs.correlate(0, 1, -0.9);
  inputs.correlate(0, 2, -0.9);
  inputs.correlate(1, 2, -0.9);
  EXPECT_TRUE(is_close(inputs.smallest_eigenvalue(), -0.8, rounding));
  EXPECT_THROW(inputs.expect_positive_definite(), std::domain_error);
  EXPECT_EQ(message_of([&] { inputs.expect_positive_definite(); }),
            "expected a positive definite correlation matrix, found the eigenvalue -0.8");
  EXPECT_NO_THROW(normals(3).expect_positive_definite());
}

TEST(InputSet, RefusesACorrelationThatIsNone) {
  InputSet inputs = normals(2);
  EXPECT_THROW(inputs.correlate(0, 0, 0.5), std::invalid_argument);
  EXPECT_THROW(inputs.correlate(0, 1, std::nan("")), std::invalid_argument);
  EXPECT_EQ(message_of([&] { inputs.correlate(0, 1, 1.01); }),
            "InputSet::correlate: expected two inputs and a coefficient in [-1, 1], found 0, 1, "
            "1.01");
  EXPECT_THROW(inputs.correlate(0, 2, 0.5), std::out_of_range);
}

TEST(InputSet, RefusesACorrelationOfWhatIsNotNormal) {
  InputSet inputs = normals(1);
  inputs.add(
      {.id = "box", .distribution = Distribution::bounded(Distribution::Shape::rectangular, 1.0)});
  inputs.add({.id = "few", .distribution = {.degrees_of_freedom = 5.0}});
  EXPECT_EQ(message_of([&] { inputs.correlate(0, 1, 0.5); }),
            "InputSet::correlate: expected a normal distribution of box");
  EXPECT_EQ(message_of([&] { inputs.correlate(2, 0, 0.5); }),
            "InputSet::correlate: expected a normal distribution of few");
}

}  // namespace
}  // namespace gonio
