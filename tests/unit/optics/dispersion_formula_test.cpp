#include "emulator/optics/dispersion_formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace gonio {
namespace {

constexpr double rounding = 1e-14;  // some units in the last place of an index about 1 to 4

double index_at_half_um(int number, const std::vector<double>& coefficients) {
  return DispersionFormula(number, coefficients).at(micrometres(0.5));
}

// The expected values are worked out by hand for l = 1/2, l^2 = 1/4.

TEST(DispersionFormula, SellmeierSquaresItsResonances) {
  // 1 + 0.09 + 0.25/(0.25 - 0.05) + 0.5*0.25/(0.25 - 0.5): 1.09 + 1.25 - 0.5
  EXPECT_NEAR(index_at_half_um(1, {0.09, 1.0, std::sqrt(0.05), 0.5, std::sqrt(0.5)}),
              std::sqrt(1.84), rounding);
}

TEST(DispersionFormula, Sellmeier2DoesNot) {
  EXPECT_NEAR(index_at_half_um(2, {0.09, 1.0, 0.05, 0.5, 0.5}), std::sqrt(1.84), rounding);
}

TEST(DispersionFormula, PolynomialSumsPowersInTheSquare) {
  // 2 + 0.5/4 + 0.01*4 - 0.001*16
  EXPECT_NEAR(index_at_half_um(3, {2.0, 0.5, 2, 0.01, -2, -0.001, -4}), std::sqrt(2.149), rounding);
}

TEST(DispersionFormula, GeneralHasTwoResonancesAndFourPowers) {
  // 2 + 1*0.25/(0.25 - 0.3^2) + 0.1*0.5/(0.25 - 0.2^1) + 0.5*0.25 + 0.01*4 + 0.25*0.5 + 0.03
  EXPECT_NEAR(index_at_half_um(
                  4, {2.0, 1.0, 2, 0.3, 2, 0.1, 1, 0.2, 1, 0.5, 2, 0.01, -2, 0.25, 1, 0.03, 0}),
              std::sqrt(2.0 + 1.5625 + 1.0 + 0.125 + 0.04 + 0.125 + 0.03), rounding);
}

TEST(DispersionFormula, CauchySumsPowersInTheIndexItself) {
  // 1.5 + 0.005*4 + 0.0001*16 - 0.002*0.25
  EXPECT_NEAR(index_at_half_um(5, {1.5, 0.005, -2, 0.0001, -4, -0.002, 2}), 1.5211, rounding);
}

TEST(DispersionFormula, GasesUseTheWaveNumber) {
  // 1 + 1e-5 + 0.05/(104 - 4) + 0.002/(54 - 4)
  EXPECT_NEAR(index_at_half_um(6, {1e-5, 0.05, 104, 0.002, 54}), 1.00055, rounding);
}

TEST(DispersionFormula, HerzbergerHasAFixedPole) {
  // 1/(0.25 - 0.028) = 1/0.222
  EXPECT_NEAR(index_at_half_um(7, {3.4, 0.222, 0.222 * 0.222, 0.4, 0.16, 0.64}),
              3.4 + 1.0 + 1.0 + 0.1 + 0.01 + 0.01, rounding);
}

TEST(DispersionFormula, RetroIsInTheLorentzLorenzTerm) {
  // 0.2 + 0.05*0.25/(0.25 - 0.2) + 0.2*0.25 = 1/2, so n^2 = (1 + 1)/(1 - 1/2)
  EXPECT_NEAR(index_at_half_um(8, {0.2, 0.05, 0.2, 0.2}), 2.0, rounding);
}

TEST(DispersionFormula, ExoticHasAResonanceInTheWavelength) {
  // 2 + 0.1/(0.25 - 0.05) + 0.03*(0.5 - 0.2)/((0.5 - 0.2)^2 + 0.01)
  EXPECT_NEAR(index_at_half_um(9, {2.0, 0.1, 0.05, 0.03, 0.2, 0.01}), std::sqrt(2.59), rounding);
}

TEST(DispersionFormula, TakesMissingCoefficientsForZero) {
  EXPECT_NEAR(index_at_half_um(1, {1.25}), 1.5, rounding);
  EXPECT_NEAR(index_at_half_um(4, {2.25}), 1.5, rounding);
  EXPECT_NEAR(index_at_half_um(6, {0.0003}), 1.0003, rounding);
  EXPECT_NEAR(index_at_half_um(7, {3.4}), 3.4, rounding);
  EXPECT_NEAR(index_at_half_um(8, {0.25}), std::sqrt(2.0), rounding);
  EXPECT_NEAR(index_at_half_um(9, {2.25}), 1.5, rounding);
}

TEST(DispersionFormula, LeavesOutTermsWithoutAmplitudeEvenAtTheirPole) {
  EXPECT_NEAR(index_at_half_um(1, {1.25, 0.0, 0.5}), 1.5, rounding);
  EXPECT_NEAR(index_at_half_um(2, {1.25, 0.0, 0.25}), 1.5, rounding);
  EXPECT_NEAR(index_at_half_um(4, {2.25, 0.0, 0, 0.5, 2, 0.0, 0, 0.25, 1}), 1.5, rounding);
  EXPECT_NEAR(index_at_half_um(6, {0.5, 0.0, 4}), 1.5, rounding);
  EXPECT_NEAR(index_at_half_um(8, {0.25, 0.0, 0.25}), std::sqrt(2.0), rounding);
  EXPECT_NEAR(index_at_half_um(9, {2.25, 0.0, 0.25, 0.0, 0.5, 0}), 1.5, rounding);
}

TEST(DispersionFormula, HasNoValueWhereTheSquareIsNegative) {
  EXPECT_TRUE(std::isnan(index_at_half_um(3, {-1.0})));
}

TEST(DispersionFormula, RefusesUnknownNumbersAndWrongCounts) {
  EXPECT_THROW(DispersionFormula(0, std::vector<double>{1.0}), std::invalid_argument);
  EXPECT_THROW(DispersionFormula(10, std::vector<double>{1.0}), std::invalid_argument);
  for (int number = 1; number <= 9; ++number) {
    const std::size_t most = DispersionFormula::most_coefficients(number);
    EXPECT_NO_THROW(DispersionFormula(number, std::vector<double>(most, 0.5))) << number;
    EXPECT_THROW(DispersionFormula(number, std::vector<double>(most + 1, 0.5)),
                 std::invalid_argument)
        << number;
    EXPECT_THROW(DispersionFormula(number, std::vector<double>()), std::invalid_argument) << number;
  }
}

}  // namespace
}  // namespace gonio
