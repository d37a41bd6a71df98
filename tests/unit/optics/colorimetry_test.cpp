#include "emulator/optics/colorimetry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/core/table.hpp"
#include "tests/unit/csv_rows.hpp"

namespace gonio {
namespace {

const std::string fixtures = GONIO_SOURCE_DIR "/fixtures/";
const std::string observer_2deg = fixtures + "observers/cie_1931_2deg.csv";
const std::string observer_10deg = fixtures + "observers/cie_1964_10deg.csv";

/// "LED-B1" is in led_b1.csv, "FL3.1" in fl3_1.csv.
SpectralTable illuminant(std::string name) {
  std::erase(name, ' ');
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c == '-' || c == '.' ? '_' : char(std::tolower(static_cast<unsigned char>(c)));
  });
  return SpectralTable::load(fixtures + "illuminants/" + name + ".csv");
}

/// Steps of 5 nm where both the illuminant and the observers have values.
WavelengthGrid grid_for(const SpectralTable& spd) {
  const double first = std::max(spd.first().nanometres(), 360.0);
  const double last = std::min(spd.last().nanometres(), 830.0);
  return {nanometres(first), nanometres(5), Eigen::Index((last - first) / 5.0) + 1};
}

// Tristimulus values.

TEST(Tristimulus, IsLinearInTheReflectance) {
  constexpr double rounding = 1e-12;  // of sums of 81 terms with a result about 100
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Observer observer = Observer::load(observer_2deg, grid);
  const Eigen::ArrayXd light = illuminant("D65").sample(grid);
  const Eigen::ArrayXd ramp = (grid.nanometres() - 380.0) / 400.0;
  const Xyz white = white_point(light, observer);
  const Xyz some = tristimulus(ramp, light, observer);
  const Xyz mixed = tristimulus(0.25 + 0.5 * ramp, light, observer);
  EXPECT_NEAR(mixed.X, 0.25 * white.X + 0.5 * some.X, rounding);
  EXPECT_NEAR(mixed.Y, 0.25 * white.Y + 0.5 * some.Y, rounding);
  EXPECT_NEAR(mixed.Z, 0.25 * white.Z + 0.5 * some.Z, rounding);
}

TEST(Tristimulus, DoesNotDependOnTheUnitOfTheIlluminant) {
  constexpr double rounding = 1e-12;
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Observer observer = Observer::load(observer_2deg, grid);
  const Eigen::ArrayXd light = illuminant("A").sample(grid);
  const Xyz one = white_point(light, observer);
  const Xyz other = white_point(0.001 * light, observer);
  EXPECT_NEAR(one.Y, 100.0, rounding);
  EXPECT_NEAR(other.X, one.X, rounding);
  EXPECT_NEAR(other.Y, one.Y, rounding);
  EXPECT_NEAR(other.Z, one.Z, rounding);
}

TEST(Tristimulus, RefusesArraysOfDifferentLengthsAndDarkness) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Observer observer = Observer::load(observer_2deg, grid);
  const Eigen::ArrayXd light = Eigen::ArrayXd::Ones(81);
  EXPECT_THROW((void)tristimulus(Eigen::ArrayXd::Ones(80), light, observer), std::invalid_argument);
  EXPECT_THROW((void)white_point(Eigen::ArrayXd::Ones(80), observer), std::invalid_argument);
  EXPECT_THROW((void)white_point(Eigen::ArrayXd::Zero(81), observer), std::invalid_argument);
}

TEST(Observer, CoversNoMoreThanItsFile) {
  const WavelengthGrid ultraviolet(nanometres(300), nanometres(5), 97);
  EXPECT_THROW((void)Observer::load(observer_2deg, ultraviolet), InputError);
}

TEST(WhitePoint, EqualsTheReferenceForEveryIlluminant) {
  // Four decimals are printed; the reference sums the same tables over the same wavelengths.
  constexpr double printed_xyz = 0.5e-4 * (1 + 1e-6);
  // Published sums are of tables at 1 nm and of unrounded ones; FL10 at 10 deg differs by 2.9e-4.
  constexpr double published_xy = 3e-4;
  for (const auto& row : test::csv_rows(fixtures + "illuminants/reference_chromaticities.csv")) {
    const std::string name = row.text("illuminant");
    const SpectralTable spd = illuminant(name);
    const WavelengthGrid grid = grid_for(spd);
    const Eigen::ArrayXd light = spd.sample(grid);
    for (const std::string angle : {"2", "10"}) {
      const std::string& file = angle == "2" ? observer_2deg : observer_10deg;
      const Xyz white = white_point(light, Observer::load(file, grid));
      const Chromaticity xy = chromaticity(white);
      const auto reference = [&](char symbol, const char* kind) {
        return row.number(symbol + angle + kind);
      };
      EXPECT_NEAR(white.X, reference('X', "_calc"), printed_xyz) << name << ' ' << angle << " deg";
      EXPECT_NEAR(white.Z, reference('Z', "_calc"), printed_xyz) << name << ' ' << angle << " deg";
      if (!row.text("x2_pub").empty()) {
        EXPECT_NEAR(xy.x, reference('x', "_pub"), published_xy) << name << ' ' << angle << " deg";
        EXPECT_NEAR(xy.y, reference('y', "_pub"), published_xy) << name << ' ' << angle << " deg";
      }
    }
  }
}

TEST(Chromaticity, OfEqualTristimulusValuesIsAThird) {
  EXPECT_DOUBLE_EQ(chromaticity({50, 50, 50}).x, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(chromaticity({50, 50, 50}).y, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(chromaticity({10, 20, 70}).x, 0.1);
  EXPECT_DOUBLE_EQ(chromaticity({10, 20, 70}).y, 0.2);
  EXPECT_THROW((void)chromaticity({0, 0, 0}), std::domain_error);
}

// CIELAB.

constexpr Xyz white_d65{95.047, 100.0, 108.883};

TEST(Cielab, OfTheWhitePointIs100AndGrey) {
  const Lab white = cielab(white_d65, white_d65);
  EXPECT_DOUBLE_EQ(white.L, 100.0);
  EXPECT_DOUBLE_EQ(white.a, 0.0);
  EXPECT_DOUBLE_EQ(white.b, 0.0);
}

TEST(Cielab, OfBlackIsZero) {
  constexpr double rounding = 1e-13;
  const Lab black = cielab({0, 0, 0}, white_d65);
  EXPECT_NEAR(black.L, 0.0, rounding);
  EXPECT_NEAR(black.a, 0.0, rounding);
  EXPECT_NEAR(black.b, 0.0, rounding);
}

TEST(Cielab, OfAGreyOfAnEighthIsHalfTheCubeRoot) {
  constexpr double rounding = 1e-13;
  const Lab grey = cielab({white_d65.X / 8, 12.5, white_d65.Z / 8}, white_d65);
  EXPECT_NEAR(grey.L, 42.0, rounding);  // 116 / 2 - 16
  EXPECT_NEAR(grey.a, 0.0, rounding);
  EXPECT_NEAR(grey.b, 0.0, rounding);
}

TEST(Cielab, IsSmoothWhereItsTwoBranchesMeet) {
  constexpr double joint = 100.0 * 216.0 / 24389.0;  // L = 8
  constexpr double step = 1e-6;
  constexpr double curvature =
      5e-6;  // of the cube root there, 6.8 per unit of Y^2, times half a step
  const auto lightness = [](double Y) { return cielab({1, Y, 1}, white_d65).L; };
  EXPECT_NEAR(lightness(joint), 8.0, 1e-12);
  EXPECT_NEAR((lightness(joint + step) - lightness(joint)) / step,
              (lightness(joint) - lightness(joint - step)) / step, curvature);
}

TEST(Cielab, RefusesAWhitePointThatIsNotPositive) {
  EXPECT_THROW((void)cielab({1, 1, 1}, {0, 100, 100}), std::domain_error);
  EXPECT_THROW((void)cielab({1, 1, 1}, {100, std::nan(""), 100}), std::domain_error);
  EXPECT_THROW((void)cielab({1, 1, 1}, {100, 100, -1}), std::domain_error);
}

TEST(Cielab, EqualsTheReferenceForTheColorChecker) {
  // The reference sums at 1 nm the official tables of D65 and D50, which differ from the 5 nm
  // tables interpolated by up to 0.001 in 100.
  constexpr double tolerance = 5e-4;
  const WavelengthGrid grid(nanometres(380), nanometres(1), 401);
  const WavelengthGrid measured(nanometres(380), nanometres(1), 351);
  const Observer observer = Observer::load(observer_2deg, grid);
  const std::string spectra = fixtures + "colour/colorchecker_babelcolor_average_10nm.csv";
  const auto rows = test::csv_rows(fixtures + "colour/colorchecker_babelcolor_lab_computed.csv");
  EXPECT_EQ(rows.size(), 24U);
  for (const auto& row : rows) {
    const std::string patch = row.text("patch");
    const SpectralTable table = SpectralTable::load(spectra, patch);
    Eigen::ArrayXd reflectance =
        Eigen::ArrayXd::Constant(grid.size(), table.value()(table.value().size() - 1));
    reflectance.head(measured.size()) = table.sample(measured);
    for (const std::string name : {"D65", "D50"}) {
      const Eigen::ArrayXd light = illuminant(name).sample(grid);
      const Xyz colour = tristimulus(reflectance, light, observer);
      const Lab lab = cielab(colour, white_point(light, observer));
      EXPECT_NEAR(colour.X, row.number("X_" + name), tolerance) << patch << ' ' << name;
      EXPECT_NEAR(colour.Y, row.number("Y_" + name), tolerance) << patch << ' ' << name;
      EXPECT_NEAR(colour.Z, row.number("Z_" + name), tolerance) << patch << ' ' << name;
      EXPECT_NEAR(lab.L, row.number("L_" + name), tolerance) << patch << ' ' << name;
      EXPECT_NEAR(lab.a, row.number("a_" + name), tolerance) << patch << ' ' << name;
      EXPECT_NEAR(lab.b, row.number("b_" + name), tolerance) << patch << ' ' << name;
    }
  }
}

// CIEDE2000.

TEST(Ciede2000, EqualsThePublishedPairs) {
  constexpr double printed = 0.5e-4;  // four decimals
  const auto rows = test::csv_rows(fixtures + "colour/ciede2000_sharma34.csv");
  EXPECT_EQ(rows.size(), 34U);
  for (const auto& row : rows) {
    const Lab first{row.number("L1"), row.number("a1"), row.number("b1")};
    const Lab second{row.number("L2"), row.number("a2"), row.number("b2")};
    EXPECT_NEAR(ciede2000(first, second), row.number("dE00"), printed)
        << "pair " << row.text("pair");
    EXPECT_NEAR(ciede2000(second, first), row.number("dE00"), printed)
        << "pair " << row.text("pair") << " the other way round";
  }
}

TEST(Ciede2000, IsZeroForEqualColoursAndSymmetricForOthers) {
  constexpr int pairs = 2000;
  constexpr double rounding = 1e-10;
  std::mt19937 random(20240417);
  std::uniform_real_distribution<double> lightness(0, 100);
  std::uniform_real_distribution<double> chroma(-100, 100);
  for (int i = 0; i < pairs; ++i) {
    const Lab one{lightness(random), chroma(random), chroma(random)};
    const Lab two{lightness(random), chroma(random), chroma(random)};
    EXPECT_EQ(ciede2000(one, one), 0.0);
    EXPECT_GT(ciede2000(one, two), 0.0);
    EXPECT_NEAR(ciede2000(one, two), ciede2000(two, one), rounding);
  }
}

TEST(Ciede2000, IsTheSameForAColourAndItsMirrorImageOnTheOtherSideOfGrey) {
  // The stretch by 1 + (1 - root) / 2 goes to 3/2 at low chroma: of 0.001 it makes 0.0015.
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(ciede2000({50, 0.001, 0}, {50, 0, 0}), 0.0015, 1e-6);
  EXPECT_NEAR(ciede2000({50, 0.001, 0}, {50, 0, 0}), ciede2000({50, -0.001, 0}, {50, 0, 0}),
              rounding);
}

TEST(Ciede2000, OfGreysIsTheWeightedDifferenceOfLightness) {
  // For L about 50, S_L = 1 + 0.015 * 0 / sqrt(20).
  EXPECT_DOUBLE_EQ(ciede2000({49, 0, 0}, {51, 0, 0}), 2.0);
  EXPECT_DOUBLE_EQ(ciede2000({49, 0, 0}, {51, 0, 0}, {.k_L = 2.0}), 1.0);
}

TEST(Ciede2000, WeightsChromaAndHueApart) {
  const Lab one{50, 20, 0};
  EXPECT_DOUBLE_EQ(ciede2000(one, {50, 30, 0}, {.k_C = 2.0}), ciede2000(one, {50, 30, 0}) / 2.0);
  EXPECT_DOUBLE_EQ(ciede2000(one, {50, 30, 0}, {.k_H = 2.0}), ciede2000(one, {50, 30, 0}));
  EXPECT_LT(ciede2000(one, {50, 0, 20}, {.k_H = 2.0}), ciede2000(one, {50, 0, 20}));
}

}  // namespace
}  // namespace gonio
