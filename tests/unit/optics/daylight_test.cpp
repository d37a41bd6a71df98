#include "emulator/optics/daylight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "emulator/core/table.hpp"
#include "emulator/optics/colorimetry.hpp"

namespace gonio {
namespace {

const std::string fixtures = GONIO_SOURCE_DIR "/fixtures/";
const std::string d_series = fixtures + "illuminants/d_series.csv";

TEST(Daylight, EqualsTheTablesOfTheStandardIlluminants) {
  // The tables have two decimals in part; the worst of all four differs by 0.0009.
  constexpr double tolerance = 0.001;
  const WavelengthGrid grid(nanometres(300), nanometres(5), 97);
  const DaylightComponents components = DaylightComponents::load(d_series, grid);
  for (const int name : {50, 55, 65, 75}) {
    const std::string file = "illuminants/d" + std::to_string(name) + ".csv";
    const Eigen::ArrayXd table = SpectralTable::load(fixtures + file).sample(grid);
    const Eigen::ArrayXd computed = daylight(100.0 * name * daylight_name_to_cct, components);
    for (Eigen::Index i = 0; i < grid.size(); ++i) {
      EXPECT_NEAR(computed(i), table(i), tolerance)
          << "D" << name << " at " << grid.nanometres()(i) << " nm";
    }
  }
}

TEST(Daylight, Is100At560Nanometres) {
  constexpr double rounding = 1e-12;
  const WavelengthGrid one(nanometres(560), Length(), 1);
  const DaylightComponents components = DaylightComponents::load(d_series, one);
  for (const double cct_k : {4000.0, 5000.0, 6999.0, 7001.0, 12000.0, 25000.0}) {
    EXPECT_NEAR(daylight(cct_k, components)(0), 100.0, rounding) << cct_k << " K";
  }
}

TEST(Daylight, GetsBluerWithItsTemperatureAcrossTheJointOfItsBranches) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  const DaylightComponents components = DaylightComponents::load(d_series, grid);
  const Observer observer = Observer::load(fixtures + "observers/cie_1931_2deg.csv", grid);
  double warmer = 1.0;
  for (int cct_k = 4000; cct_k <= 25000; cct_k += 250) {
    const double x = chromaticity(white_point(daylight(cct_k, components), observer)).x;
    EXPECT_LT(x, warmer) << cct_k << " K";
    warmer = x;
  }
}

TEST(Daylight, LiesOnTheDaylightLocus) {
  // y = -3 x^2 + 2.87 x - 0.275 is a fit, and M_1, M_2 are rounded to three decimals.
  constexpr double tolerance = 5e-4;
  const WavelengthGrid grid = WavelengthGrid::visible();
  const DaylightComponents components = DaylightComponents::load(d_series, grid);
  const Observer observer = Observer::load(fixtures + "observers/cie_1931_2deg.csv", grid);
  for (const double cct_k : {4000.0, 5000.0, 6500.0, 10000.0, 25000.0}) {
    const Chromaticity c = chromaticity(white_point(daylight(cct_k, components), observer));
    EXPECT_NEAR(c.y, -3.0 * c.x * c.x + 2.87 * c.x - 0.275, tolerance) << cct_k << " K";
  }
}

TEST(Daylight, RefusesTemperaturesOutsideItsRange) {
  const DaylightComponents components =
      DaylightComponents::load(d_series, WavelengthGrid::visible());
  for (const double cct_k : {3999.0, 25001.0, 0.0, -6500.0, std::nan("")}) {
    EXPECT_THROW((void)daylight(cct_k, components), std::domain_error) << cct_k << " K";
  }
}

}  // namespace
}  // namespace gonio
