#include "emulator/procedure/polynomial_surrogate.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "emulator/core/parallel_for.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/responses.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::VectorXd;
using test::is_close;

constexpr double rounding = 1e-12;

/// Uniform in a box, by rows.
ArrayXXd points_in_box(Index n, const VectorXd& middle, const VectorXd& half) {
  constexpr std::uint64_t seed = 2813;
  std::mt19937_64 bits(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return ArrayXXd::NullaryExpr(n, middle.size(), [&](Index, Index column) {
    return middle(column) + half(column) * uniform(bits);
  });
}

/// The largest deviation at those points, by output.
VectorXd largest_error(const PolynomialSurrogate& surrogate,
                       const PolynomialSurrogate::Function& function, const ArrayXXd& x) {
  ArrayXXd y;
  surrogate.evaluate(x, y);
  VectorXd largest = VectorXd::Zero(y.cols());
  for (Index i = 0; i < x.rows(); ++i) {
    const VectorXd expected = function(x.row(i).transpose().matrix());
    largest = largest.cwiseMax((y.row(i).transpose().matrix() - expected).cwiseAbs());
  }
  return largest;
}

const VectorXd centre{{1.0, -2.0, 0.5}};
const VectorXd half_width{{0.5, 1.0, 0.25}};

VectorXd cubic(const VectorXd& x) {
  return VectorXd{{x(0) * x(1) * x(2), x(1) * x(1) - 3.0 * x(2), 7.0}};
}
VectorXd exponential(const VectorXd& x) { return VectorXd{{std::exp(x(0) + 0.5 * x(1) * x(2))}}; }
/// Its derivatives grow without bound towards a face of the box.
VectorXd root(const VectorXd& x) { return VectorXd{{std::sqrt(x(0) - 0.5), x(1)}}; }

TEST(PolynomialSurrogate, IsAPolynomialIfItIsOne) {
  const auto surrogate =
      PolynomialSurrogate::fit(cubic, centre, half_width, {.target_error = 1e-9});
  EXPECT_EQ(surrogate.degree(), 3);
  EXPECT_LT(surrogate.error().maxCoeff(), rounding);
  EXPECT_LT(largest_error(surrogate, cubic, points_in_box(1000, centre, half_width)).maxCoeff(),
            rounding);
}

TEST(PolynomialSurrogate, RaisesItsDegreeUntilTheErrorIsSmallEnough) {
  int before = 0;
  for (const double target : {1.0, 1e-2, 3e-4, 0.0}) {
    const auto surrogate = PolynomialSurrogate::fit(exponential, centre, half_width,
                                                    {.target_error = target, .highest_degree = 4});
    EXPECT_GE(surrogate.degree(), before);
    EXPECT_TRUE(surrogate.error()(0) <= target || surrogate.degree() == 4);
    before = surrogate.degree();
  }
  EXPECT_EQ(before, 4);
  EXPECT_EQ(PolynomialSurrogate::fit(exponential, centre, half_width,
                                     {.target_error = 0.0, .highest_degree = 1})
                .degree(),
            1);
}

// Of three parameters, a polynomial of degree 3 has 20 terms, and of degree 4 it has 35.
TEST(PolynomialSurrogate, TriesNoDegreeOfTooManyTerms) {
  for (const auto& [most_terms, degree] :
       {std::pair{34u, 3}, std::pair{35u, 4}, std::pair{1u, 2}}) {
    const auto surrogate = PolynomialSurrogate::fit(
        exponential, centre, half_width, {.target_error = 0.0, .most_terms = most_terms});
    EXPECT_EQ(surrogate.degree(), degree) << most_terms;
  }
}

// What it says of its error holds elsewhere in the box, but for a corner that its points miss.
TEST(PolynomialSurrogate, TellsItsErrorHonestly) {
  constexpr double of_other_points = 1.5;
  const ArrayXXd elsewhere = points_in_box(10'000, centre, half_width);
  for (const auto function : {&exponential, &root}) {
    for (const int degree : {2, 3, 4}) {
      const auto surrogate = PolynomialSurrogate::fit(
          function, centre, half_width, {.target_error = 0.0, .highest_degree = degree});
      const VectorXd found = largest_error(surrogate, function, elsewhere);
      EXPECT_GT(surrogate.error()(0), 1e-6);
      EXPECT_LT(found(0), of_other_points * surrogate.error()(0)) << degree;
      EXPECT_GT(found(0), 0.3 * surrogate.error()(0)) << degree;
    }
  }
}

TEST(PolynomialSurrogate, HasAnErrorForEachOutput) {
  const auto surrogate = PolynomialSurrogate::fit(root, centre, half_width, {});
  EXPECT_GT(surrogate.error()(0), 1e-3);
  EXPECT_LT(surrogate.error()(1), rounding);
}

TEST(PolynomialSurrogate, KeepsThePointsOfLowerDegrees) {
  std::atomic<std::size_t> calls = 0;
  const auto surrogate = PolynomialSurrogate::fit(
      [&](const VectorXd& x) {
        ++calls;
        return exponential(x);
      },
      centre, half_width, {.target_error = 0.0, .highest_degree = 4});
  EXPECT_EQ(surrogate.evaluations(), calls);
  // Degrees 2, 3 and 4 have 10, 20 and 35 coefficients, and the points to compare are not fewer
  // than those to fit.
  EXPECT_GE(calls, 2u * (2u * 35u));
  EXPECT_LT(calls, 2u * (2u * 35u) + 2u * (10u + 20u + 35u));
}

TEST(PolynomialSurrogate, HoldsItsValueAtTheEdgeOfTheBox) {
  const auto surrogate = PolynomialSurrogate::fit(cubic, centre, half_width, {});
  const VectorXd edge{{1.5, -3.0, 0.6}};
  const VectorXd beyond{{1.6, -30.0, 0.6}};
  ArrayXXd x(2, 3), y;
  x << edge.transpose().array(), beyond.transpose().array();
  surrogate.evaluate(x, y);
  EXPECT_TRUE((y.row(0) == y.row(1)).all());
  EXPECT_TRUE(is_close(y(0, 0), cubic(edge)(0), rounding));
}

TEST(PolynomialSurrogate, LeavesOutFixedParameters) {
  const VectorXd narrow{{0.5, 0.0, 0.25}};
  const auto surrogate = PolynomialSurrogate::fit(
      [](const VectorXd& x) {
        EXPECT_EQ(x(1), centre(1));
        return cubic(x);
      },
      centre, narrow, {.target_error = 1e-9});
  EXPECT_EQ(surrogate.degree(), 2);
  ArrayXXd x(1, 3), y;
  x << 1.2, 100.0, 0.3;
  surrogate.evaluate(x, y);
  EXPECT_TRUE(is_close(y(0, 0), 1.2 * centre(1) * 0.3, rounding));
}

TEST(PolynomialSurrogate, WithoutFreeParametersIsAConstant) {
  const auto surrogate = PolynomialSurrogate::fit(cubic, centre, VectorXd::Zero(3), {});
  EXPECT_EQ(surrogate.degree(), 0);
  EXPECT_EQ(surrogate.evaluations(), 1u);
  EXPECT_EQ(surrogate.error(), VectorXd::Zero(3));
  ArrayXXd y;
  surrogate.evaluate(points_in_box(100, centre, half_width), y);
  ASSERT_EQ(y.rows(), 100);
  for (Index i = 0; i < y.rows(); ++i) {
    EXPECT_TRUE((y.row(i).matrix().transpose() == cubic(centre)));
  }
}

TEST(PolynomialSurrogate, IsTheSameFromSeveralThreads) {
  const auto surrogate = PolynomialSurrogate::fit(exponential, centre, half_width, {});
  const ArrayXXd x = points_in_box(1000, centre, half_width);
  ArrayXXd alone;
  surrogate.evaluate(x, alone);
  std::vector<ArrayXXd> y(8);
  parallel_for(y.size(), [&](std::size_t i) { surrogate.evaluate(x, y[i]); });
  for (const ArrayXXd& one : y) {
    EXPECT_TRUE((one == alone).all());
  }
}

TEST(PolynomialSurrogate, IsTheSameForTheSameSeed) {
  const ArrayXXd x = points_in_box(100, centre, half_width);
  const auto values = [&](std::uint64_t seed) {
    ArrayXXd y;
    PolynomialSurrogate::fit(exponential, centre, half_width, {.seed = seed}).evaluate(x, y);
    return y;
  };
  EXPECT_TRUE((values(7) == values(7)).all());
  EXPECT_TRUE((values(7) != values(8)).any());
}

TEST(PolynomialSurrogate, RefusesWhatItCannotFit) {
  EXPECT_THROW((void)PolynomialSurrogate::fit(cubic, centre, -half_width, {}),
               std::invalid_argument);
  EXPECT_THROW((void)PolynomialSurrogate::fit(cubic, centre, VectorXd::Ones(2), {}),
               std::invalid_argument);
  EXPECT_THROW((void)PolynomialSurrogate::fit(cubic, centre, half_width, {.highest_degree = 0}),
               std::invalid_argument);
  const auto undefined = [](const VectorXd& x) { return VectorXd{{std::log(x(0) - 0.6)}}; };
  EXPECT_THROW((void)PolynomialSurrogate::fit(undefined, centre, half_width, {}),
               std::domain_error);
  const auto surrogate = PolynomialSurrogate::fit(cubic, centre, half_width, {});
  ArrayXXd y;
  EXPECT_THROW(surrogate.evaluate(ArrayXXd::Zero(1, 2), y), std::invalid_argument);
}

// Three geometries, and samples of each kind, in a box of five standard uncertainties and more.
TEST(PolynomialSurrogate, OfTheOpticsIsAsGoodAsItsTarget) {
  constexpr double target_gu = 5e-4;
  const std::vector<Sample> ladder =
      test::rungs({"paint_m150", "glass_m050", "copper_m065", "aluminium_smooth", "ideal_mirror"});
  for (const std::string& geometry : test::three_angles) {
    const OpticalResponse response(test::shipped_instrument("triangle_gloss"), geometry, ladder,
                                   test::tolerance_gu);
    const VectorXd box = VectorXd::Constant(response.size(), 0.03);
    const auto surrogate = PolynomialSurrogate::fit(response, response.as_built(), box, {});
    EXPECT_LE(surrogate.error().maxCoeff(), target_gu) << geometry;
    EXPECT_LE(surrogate.degree(), 3) << geometry;
    const ArrayXXd x = points_in_box(50, response.as_built(), box);
    EXPECT_LE(largest_error(surrogate, response, x).maxCoeff(), 1.5 * target_gu) << geometry;
  }
}

}  // namespace
}  // namespace gonio
