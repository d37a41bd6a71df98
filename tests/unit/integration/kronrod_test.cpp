#include "emulator/integration/kronrod.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/integration/gauss_rule.hpp"

namespace gonio {
namespace {

using test::is_close;

constexpr int most_gauss_points = 21;
constexpr double rounding = 1e-14;  // of nodes that an eigenvalue solver found

/// int x^degree over [-1, 1]
double moment(int degree) { return degree % 2 == 0 ? 2.0 / (degree + 1.0) : 0.0; }

TEST(KronrodRule, IsExactUpToDegree3nPlus1) {
  for (int n = 1; n <= most_gauss_points; ++n) {
    const KronrodRule& rule = kronrod_rule(n);
    for (int degree = 0; degree <= 3 * n + 1; ++degree) {
      EXPECT_TRUE(is_close((rule.kronrod * rule.node.pow(degree)).sum(), moment(degree), rounding))
          << "n = " << n << ", degree " << degree;
    }
  }
}

TEST(KronrodRule, HoldsGaussRuleExactUpToDegree2nMinus1) {
  for (int n = 1; n <= most_gauss_points; ++n) {
    const KronrodRule& rule = kronrod_rule(n);
    for (int degree = 0; degree <= 2 * n - 1; ++degree) {
      EXPECT_TRUE(is_close((rule.gauss * rule.node.pow(degree)).sum(), moment(degree), rounding))
          << "n = " << n << ", degree " << degree;
    }
  }
}

TEST(KronrodRule, IsNotExactAboveItsDegree) {
  // The next even degrees, where the error is above rounding.
  for (const int n : {1, 2, 3, 4, 5}) {
    const KronrodRule& rule = kronrod_rule(n);
    const int degree = 3 * n + 2 + n % 2;
    EXPECT_GT(std::abs((rule.kronrod * rule.node.pow(degree)).sum() - moment(degree)), 1e-9) << n;
    EXPECT_GT(std::abs((rule.gauss * rule.node.pow(2 * n)).sum() - moment(2 * n)), 1e-4) << n;
  }
}

TEST(KronrodRule, HasPositiveWeightsAndSymmetricAscendingNodes) {
  for (int n = 1; n <= most_gauss_points; ++n) {
    const KronrodRule& rule = kronrod_rule(n);
    ASSERT_EQ(rule.node.size(), 2 * n + 1);
    ASSERT_EQ(rule.kronrod.size(), 2 * n + 1);
    ASSERT_EQ(rule.gauss.size(), 2 * n + 1);
    EXPECT_GT(rule.kronrod.minCoeff(), 0.0) << n;
    EXPECT_LT(rule.node.abs().maxCoeff(), 1.0) << n;
    for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
      EXPECT_EQ(rule.node(i), -rule.node(2 * n - i)) << n;
      EXPECT_EQ(rule.gauss(i) > 0.0, i % 2 == 1) << "n = " << n << ", node " << i;
      if (i > 0) {
        EXPECT_LT(rule.node(i - 1), rule.node(i)) << n;
      }
    }
  }
}

TEST(KronrodRule, EqualsTheTableOfQuadpackFor7And15Points) {
  // Piessens et al., QUADPACK (1983), routine QK15; the first is the outermost node.
  constexpr double digits = 2e-15;  // rounding of the eigenvalue solver
  const double node[] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                         0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                         0.586087235467691130294144691693801, 0.405845151377397166906606412076961,
                         0.207784955007898467600689403773245, 0.0};
  const double kronrod[] = {
      0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
      0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
      0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  const double gauss[] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                          0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  const KronrodRule& rule = kronrod_rule(7);
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(is_close(rule.node(i), -node[i], digits)) << i;
    EXPECT_TRUE(is_close(rule.kronrod(i), kronrod[i], digits)) << i;
    EXPECT_TRUE(is_close(rule.gauss(i), i % 2 == 1 ? gauss[i / 2] : 0.0, digits)) << i;
  }
}

TEST(KronrodRule, HasTheNodesOfGaussBetweenItsOwn) {
  for (int n = 2; n <= most_gauss_points; ++n) {
    const KronrodRule& rule = kronrod_rule(n);
    const test::GaussRule gauss(n);
    for (int i = 0; i < n; ++i) {
      EXPECT_TRUE(is_close(rule.node(2 * i + 1), gauss.node(i), rounding)) << "n = " << n;
      EXPECT_TRUE(is_close(rule.gauss(2 * i + 1), gauss.weight(i), rounding)) << "n = " << n;
    }
  }
}

TEST(KronrodRule, RefusesLessThanOnePoint) {
  EXPECT_THROW((void)kronrod_rule(0), std::domain_error);
  EXPECT_THROW((void)kronrod_rule(-3), std::domain_error);
}

}  // namespace
}  // namespace gonio
