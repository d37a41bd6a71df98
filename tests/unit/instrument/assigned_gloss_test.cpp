#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "emulator/instrument/glossmeter.hpp"
#include "tests/unit/csv_rows.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

// The value of a polished glass by its index: 100 rho(n) / rho(1.567).

namespace gonio {
namespace {

using test::is_close;
using test::shipped_standard;

constexpr double two_decimals = 0.0051;
constexpr double one_decimal = 0.051;

struct Assigned {
  double n, at_20, at_45, at_60, at_75, at_85;
};

/// Exact ratio of Fresnel reflectances, computed by another program and rounded to two decimals.
constexpr std::array<Assigned, 44> assigned{{{1.400, 57.05, 61.26, 71.94, 87.42, 96.64},
                                             {1.410, 59.43, 63.50, 73.71, 88.36, 96.93},
                                             {1.420, 61.84, 65.74, 75.48, 89.27, 97.20},
                                             {1.430, 64.28, 68.00, 77.23, 90.15, 97.46},
                                             {1.440, 66.75, 70.27, 78.97, 91.01, 97.71},
                                             {1.450, 69.24, 72.56, 80.70, 91.84, 97.95},
                                             {1.458, 71.25, 74.40, 82.07, 92.48, 98.13},
                                             {1.460, 71.75, 74.86, 82.41, 92.64, 98.18},
                                             {1.470, 74.29, 77.16, 84.11, 93.43, 98.39},
                                             {1.480, 76.86, 79.48, 85.80, 94.19, 98.60},
                                             {1.490, 79.44, 81.81, 87.47, 94.93, 98.79},
                                             {1.500, 82.05, 84.14, 89.14, 95.65, 98.97},
                                             {1.510, 84.67, 86.49, 90.79, 96.35, 99.15},
                                             {1.520, 87.32, 88.84, 92.43, 97.03, 99.32},
                                             {1.527, 89.18, 90.49, 93.57, 97.50, 99.43},
                                             {1.530, 89.98, 91.20, 94.06, 97.69, 99.48},
                                             {1.540, 92.67, 93.57, 95.68, 98.34, 99.63},
                                             {1.550, 95.37, 95.95, 97.29, 98.97, 99.77},
                                             {1.560, 98.09, 98.33, 98.89, 99.58, 99.91},
                                             {1.567, 100.00, 100.00, 100.00, 100.00, 100.00},
                                             {1.570, 100.82, 100.72, 100.48, 100.18, 100.04},
                                             {1.580, 103.57, 103.11, 102.05, 100.76, 100.16},
                                             {1.590, 106.34, 105.51, 103.62, 101.33, 100.28},
                                             {1.600, 109.12, 107.92, 105.18, 101.88, 100.39},
                                             {1.610, 111.91, 110.32, 106.73, 102.42, 100.50},
                                             {1.620, 114.72, 112.74, 108.27, 102.95, 100.59},
                                             {1.630, 117.54, 115.16, 109.80, 103.47, 100.69},
                                             {1.640, 120.38, 117.58, 111.32, 103.97, 100.78},
                                             {1.650, 123.22, 120.00, 112.83, 104.46, 100.86},
                                             {1.660, 126.08, 122.43, 114.34, 104.94, 100.94},
                                             {1.670, 128.95, 124.86, 115.83, 105.41, 101.02},
                                             {1.680, 131.83, 127.30, 117.32, 105.87, 101.09},
                                             {1.690, 134.71, 129.73, 118.80, 106.32, 101.16},
                                             {1.700, 137.61, 132.17, 120.27, 106.76, 101.22},
                                             {1.710, 140.52, 134.61, 121.73, 107.19, 101.28},
                                             {1.720, 143.43, 137.06, 123.19, 107.61, 101.33},
                                             {1.730, 146.35, 139.50, 124.63, 108.02, 101.39},
                                             {1.740, 149.29, 141.95, 126.07, 108.43, 101.43},
                                             {1.750, 152.22, 144.39, 127.51, 108.82, 101.48},
                                             {1.760, 155.17, 146.84, 128.93, 109.21, 101.52},
                                             {1.770, 158.12, 149.29, 130.35, 109.59, 101.56},
                                             {1.780, 161.08, 151.74, 131.76, 109.96, 101.59},
                                             {1.790, 164.04, 154.19, 133.17, 110.33, 101.63},
                                             {1.800, 167.01, 156.63, 134.57, 110.69, 101.66}}};

TEST(AssignedGloss, AgreesWithTheTableOfAnotherProgram) {
  const Scale scale = shipped_standard("iso_2813/2014").scale;
  for (const Assigned& row : assigned) {
    EXPECT_NEAR(assigned_gloss(row.n, degrees(20), scale), row.at_20, two_decimals) << row.n;
    EXPECT_NEAR(assigned_gloss(row.n, degrees(45), scale), row.at_45, two_decimals) << row.n;
    EXPECT_NEAR(assigned_gloss(row.n, degrees(60), scale), row.at_60, two_decimals) << row.n;
    EXPECT_NEAR(assigned_gloss(row.n, degrees(75), scale), row.at_75, two_decimals) << row.n;
    EXPECT_NEAR(assigned_gloss(row.n, degrees(85), scale), row.at_85, two_decimals) << row.n;
  }
}

TEST(AssignedGloss, AgreesWithTheReferenceFileToThreeDecimals) {
  constexpr double three_decimals = 0.00051;
  const Scale scale = shipped_standard("iso_2813/2014").scale;
  for (const auto& row :
       test::csv_rows(test::source_tree / "fixtures/reference/fresnel_gloss_vs_n.csv")) {
    for (const char* theta : {"20", "45", "60", "75", "85"}) {
      EXPECT_NEAR(assigned_gloss(row.number("n"), degrees(std::stod(theta)), scale),
                  row.number(std::string("GU") + theta), three_decimals)
          << row.text("n") << " at " << theta;
    }
  }
}

// The example that ASTM D523 prints: n = 1.527 reads 89.2, 93.6 and 99.4.
TEST(AssignedGloss, AgreesWithTheExampleOfAstmD523) {
  const Scale scale = shipped_standard("astm_d523/14").scale;
  EXPECT_NEAR(assigned_gloss(1.527, degrees(20), scale), 89.2, one_decimal);
  EXPECT_NEAR(assigned_gloss(1.527, degrees(60), scale), 93.6, one_decimal);
  EXPECT_NEAR(assigned_gloss(1.527, degrees(85), scale), 99.4, one_decimal);
}

// Its linear rule, 0.27 and 0.16 GU per 0.001 in n, holds near 1.567. (The 0.016 that it prints for
// 85 deg is rounded up: the slope there is 0.0129.)
TEST(AssignedGloss, HasTheSlopesOfAstmD523) {
  const Scale scale = shipped_standard("astm_d523/14").scale;
  const auto slope = [&](double theta_deg) {
    return assigned_gloss(1.5675, degrees(theta_deg), scale) -
           assigned_gloss(1.5665, degrees(theta_deg), scale);
  };
  constexpr double two_digits = 0.0051;
  EXPECT_NEAR(slope(20), 0.27, two_digits);
  EXPECT_NEAR(slope(60), 0.16, two_digits);
  EXPECT_NEAR(slope(85), 0.0129, 0.00005);
}

TEST(AssignedGloss, Is100ForTheReferenceAtEveryAngle) {
  const Scale iso = shipped_standard("iso_2813/2014").scale;
  const Scale paper = shipped_standard("tappi_t480/om_15").scale;
  for (double theta_deg = 0.0; theta_deg < 90.0; theta_deg += 5.0) {
    EXPECT_DOUBLE_EQ(assigned_gloss(1.567, degrees(theta_deg), iso), 100.0) << theta_deg;
    EXPECT_DOUBLE_EQ(assigned_gloss(1.540, degrees(theta_deg), paper), 100.0) << theta_deg;
  }
}

// Conversion between the scales: 0.9267 at 20 deg, 0.9834 at 75 deg.
TEST(AssignedGloss, ConvertsThePaperScaleToThatOfPaints) {
  constexpr double four_decimals = 0.00005;
  const Scale iso = shipped_standard("iso_2813/2014").scale;
  EXPECT_NEAR(assigned_gloss(1.540, degrees(20), iso) / 100.0, 0.9267, four_decimals);
  EXPECT_NEAR(assigned_gloss(1.540, degrees(75), iso) / 100.0, 0.9834, four_decimals);
}

// At 85 deg it falls again above n = 1.94.
TEST(AssignedGloss, GrowsWithTheIndexOfGlasses) {
  const Scale scale = shipped_standard("iso_2813/2014").scale;
  for (const double theta_deg : {20.0, 60.0, 85.0}) {
    double last = 0.0;
    for (double n = 1.3; n < 1.9; n += 0.01) {
      const double gloss = assigned_gloss(n, degrees(theta_deg), scale);
      EXPECT_GT(gloss, last) << n << " at " << theta_deg;
      last = gloss;
    }
  }
}

// ASTM C346 and C584 count thousandths of the incident light.
TEST(AssignedGloss, IsTheReflectanceOnAScaleWithoutAReferenceGlass) {
  constexpr double printed = 0.005;
  EXPECT_TRUE(is_close(assigned_gloss(1.567, degrees(45), shipped_standard("astm_c346/87").scale),
                       59.71, printed));
  EXPECT_TRUE(is_close(assigned_gloss(1.540, degrees(45), shipped_standard("astm_c346/87").scale),
                       55.87, printed));
  EXPECT_TRUE(is_close(assigned_gloss(1.567, degrees(60), shipped_standard("astm_c584/81").scale),
                       100.06, printed));
}

TEST(AssignedGloss, NeedsAnIndex) {
  const Scale scale = shipped_standard("iso_2813/2014").scale;
  EXPECT_THROW((void)assigned_gloss(0.0, degrees(60), scale), std::domain_error);
  EXPECT_THROW((void)assigned_gloss(-1.5, degrees(60), scale), std::domain_error);
  EXPECT_THROW((void)assigned_gloss(std::nan(""), degrees(60), scale), std::domain_error);
}

}  // namespace
}  // namespace gonio
