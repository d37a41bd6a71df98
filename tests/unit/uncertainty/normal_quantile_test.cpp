#include "emulator/uncertainty/normal_quantile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "emulator/uncertainty/distribution.hpp"
#include "tests/unit/expect_close.hpp"

namespace gonio {
namespace {

// AS 241 promises about 1e-16; what rounding adds is of the polynomials of degree 7.
constexpr double relative_tolerance = 2e-15;

/// From the far tail to the middle, and to the other tail as far as 1 - p has digits.
std::vector<double> probabilities() {
  std::vector<double> p;
  for (double tail = 1e-300; tail < 0.5; tail *= 1.37) {
    p.push_back(tail);
  }
  for (double tail = 1e-12; tail < 0.5; tail *= 1.019) {
    p.push_back(1.0 - tail);
  }
  p.insert(p.end(), {0.075, 0.925, std::nextafter(0.075, 0.0), std::nextafter(0.925, 1.0)});
  return p;
}

TEST(NormalQuantile, EqualsTheInverseErrorFunction) {
  const std::vector<double> p = probabilities();
  std::vector<double> z = p;
  to_normal_quantile(z);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_TRUE(test::is_close_relative(z[i], quantile({.standard_uncertainty = 1.0}, p[i]),
                                        relative_tolerance))
        << p[i];
  }
}

TEST(NormalQuantile, OfTheMiddleIsZero) {
  std::vector<double> z{0.5};
  to_normal_quantile(z);
  EXPECT_EQ(z.front(), 0.0);
}

TEST(NormalQuantile, DoesNotDependOnItsNeighbours) {
  const std::vector<double> p = probabilities();
  std::vector<double> all = p;
  to_normal_quantile(all);
  for (std::size_t i = 0; i < p.size(); i += 37) {
    std::vector<double> one{p[i]};
    to_normal_quantile(one);
    EXPECT_TRUE(test::is_close_relative(all[i], one.front(), relative_tolerance));
  }
}

}  // namespace
}  // namespace gonio
