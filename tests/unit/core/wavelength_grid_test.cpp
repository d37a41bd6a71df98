#include "emulator/core/wavelength_grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace gonio {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(WavelengthGrid, StepsEquallyFromFirstToLast) {
  const WavelengthGrid grid(nanometres(400), nanometres(10), 31);
  ASSERT_EQ(grid.size(), 31);
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    EXPECT_DOUBLE_EQ(grid.nanometres()(i), 400.0 + 10.0 * double(i));
  }
  EXPECT_EQ(grid.first(), nanometres(400));
  EXPECT_EQ(grid.last(), nanometres(700));
}

TEST(WavelengthGrid, VisibleIs380To780NanometresBy5) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  EXPECT_EQ(grid.size(), 81);
  EXPECT_EQ(grid.first(), nanometres(380));
  EXPECT_EQ(grid.last(), nanometres(780));
}

TEST(WavelengthGrid, OfOneWavelengthNeedsNoStep) {
  const WavelengthGrid grid(nanometres(550), Length(), 1);
  EXPECT_EQ(grid.first(), nanometres(550));
  EXPECT_EQ(grid.last(), nanometres(550));
}

TEST(WavelengthGrid, EqualsAnotherWithTheSameWavelengths) {
  EXPECT_EQ(WavelengthGrid::visible(), WavelengthGrid(nanometres(380), nanometres(5), 81));
  EXPECT_FALSE(WavelengthGrid::visible() == WavelengthGrid(nanometres(380), nanometres(5), 80));
  EXPECT_FALSE(WavelengthGrid::visible() == WavelengthGrid(nanometres(380), nanometres(4), 81));
}

TEST(WavelengthGrid, RefusesValuesOutsideItsRange) {
  EXPECT_THROW(WavelengthGrid(nanometres(0), nanometres(5), 2), std::domain_error);
  EXPECT_THROW(WavelengthGrid(nanometres(-380), nanometres(5), 2), std::domain_error);
  EXPECT_THROW(WavelengthGrid(nanometres(not_a_number), nanometres(5), 2), std::domain_error);
  EXPECT_THROW(WavelengthGrid(nanometres(380), nanometres(0), 2), std::domain_error);
  EXPECT_THROW(WavelengthGrid(nanometres(380), nanometres(-5), 2), std::domain_error);
  EXPECT_THROW(WavelengthGrid(nanometres(380), nanometres(not_a_number), 2), std::domain_error);
  EXPECT_THROW(WavelengthGrid(nanometres(380), nanometres(5), 0), std::domain_error);
}

}  // namespace
}  // namespace gonio
