#include "emulator/measured/specular_table.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "emulator/measured/brdf_reflectance.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/measured_fixture.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using std::numbers::pi;

const std::vector<BrdfChannel> one_channel{{.band = BrdfChannel::Band::luminance}};
constexpr double rounding = 1e-12;  // of roots and powers of doubles

/// f_r at nodes by (rotation, theta_i, azimuth, radial).
template <typename Function>
SpecularTable table_of(const SpecularTable::Grid& grid, const Function& function) {
  Eigen::ArrayXXd f_r(grid.size(), 1);
  for (Index i = 0; i < grid.rotation.size(); ++i) {
    for (Index j = 0; j < grid.theta_i.size(); ++j) {
      for (Index k = 0; k < grid.azimuth.size(); ++k) {
        for (Index l = 0; l < grid.radial.size(); ++l) {
          f_r(grid.row(i, j, k, l), 0) =
              function(grid.rotation[i], grid.theta_i[j], grid.azimuth[k], grid.radial[l]);
        }
      }
    }
  }
  return {one_channel, grid, f_r};
}

SpecularTable::Grid half_grid() {
  return {.rotation = ArrayXd::Zero(1),
          .theta_i = ArrayXd::LinSpaced(4, 0.0, degrees(60.0).radians()),
          .azimuth = ArrayXd::LinSpaced(7, 0.0, pi),
          .radial = ArrayXd::LinSpaced(37, 0.0, pi)};
}

double lobe(double radial) { return std::pow(1.0 + radial, -8.0); }

TEST(SpecularTable, IsItsNodesAboutTheMirrorDirection) {
  const SpecularTable table =
      table_of(half_grid(), [](double, double, double, double radial) { return lobe(radial); });
  for (const double theta_i : {0.0, 20.0, 35.0, 60.0}) {
    EXPECT_TRUE(is_close(in_plane(table, theta_i, theta_i)[0], 1.0, rounding));
    EXPECT_TRUE(is_close(in_plane(table, theta_i, theta_i - 40.0)[0], lobe(degrees(40.0).radians()),
                         rounding));
  }
  EXPECT_EQ(table.step(degrees(30.0)).degrees(), degrees(5.0).degrees());
  EXPECT_DOUBLE_EQ(table.largest_theta().degrees(), 60.0);
}

TEST(SpecularTable, HasAzimuthZeroTowardsTheNormal) {
  const SpecularTable table = table_of(half_grid(), [](double, double, double azimuth, double) {
    return std::pow(1.0 + azimuth, 4.0);  // its fourth root is linear
  });
  EXPECT_TRUE(is_close(in_plane(table, 40.0, 30.0)[0], 1.0, rounding));
  EXPECT_TRUE(is_close(in_plane(table, 40.0, 50.0)[0], std::pow(1.0 + pi, 4.0), 1e-9));
  const Vector3 left = direction_at(40.0, 10.0), right = direction_at(40.0, -10.0);
  const Vector3 omega_i = direction_at(40.0, 180.0);
  EXPECT_TRUE(is_close(value_of(table, omega_i, left)[0], value_of(table, omega_i, right)[0],
                       rounding));  // one side mirrors the other
}

TEST(SpecularTable, TellsSidesApartWhereItHasBoth) {
  SpecularTable::Grid grid = half_grid();
  grid.azimuth = ArrayXd::LinSpaced(12, 0.0, 11.0 * pi / 6.0);
  const SpecularTable table = table_of(grid, [](double, double, double azimuth, double radial) {
    return 1.0 + std::sin(azimuth) * std::sin(radial);
  });
  const Vector3 omega_i = direction_at(40.0, 180.0);
  // azimuths turn from the normal against +y: y = -sin(radial) sin(azimuth)
  const double beyond = value_of(table, omega_i, direction_at(40.0, -10.0))[0];
  const double before = value_of(table, omega_i, direction_at(40.0, 10.0))[0];
  EXPECT_GT(beyond, 1.05);
  EXPECT_LT(before, 0.95);
}

TEST(SpecularTable, TurnsWithTheIncidence) {
  const SpecularTable isotropic =
      table_of(half_grid(), [](double, double theta_i, double azimuth, double radial) {
        return (1.0 + theta_i) * (2.0 + std::cos(azimuth)) * lobe(radial);
      });
  const double here = value_of(isotropic, direction_at(35.0, 180.0), direction_at(50.0, 25.0))[0];
  const double there = value_of(isotropic, direction_at(35.0, 250.0), direction_at(50.0, 95.0))[0];
  EXPECT_TRUE(is_close(here, there, rounding));
  SpecularTable::Grid grid = half_grid();
  grid.rotation = ArrayXd::LinSpaced(4, 0.0, 1.5 * pi);
  const SpecularTable anisotropic =
      table_of(grid, [](double rotation, double, double, double) { return 1.0 + rotation; });
  EXPECT_TRUE(
      is_close(value_of(anisotropic, direction_at(35.0, 180.0), {0, 0, 1})[0], 1.0, rounding));
  EXPECT_TRUE(is_close(value_of(anisotropic, direction_at(35.0, 270.0), {0, 0, 1})[0],
                       1.0 + pi / 2.0, rounding));
  // past the last rotation the first follows
  const double between = std::pow((std::pow(1.0 + 1.5 * pi, 0.25) + 1.0) / 2.0, 4.0);
  EXPECT_TRUE(
      is_close(value_of(anisotropic, direction_at(35.0, 135.0), {0, 0, 1})[0], between, 1e-9));
}

TEST(SpecularTable, IsNotDarkenedByNodesBelowTheSurface) {
  const SpecularTable::Grid grid = half_grid();
  Eigen::ArrayXXd f_r = Eigen::ArrayXXd::Constant(grid.size(), 1, 1.0 / pi);
  for (Index j = 0; j < grid.theta_i.size(); ++j) {
    for (Index k = 0; k < grid.azimuth.size(); ++k) {
      for (Index l = 0; l < grid.radial.size(); ++l) {
        if (grid.cos_theta_r(j, k, l) <= 0.0) {
          f_r(grid.row(0, j, k, l), 0) = 0.0;
        }
      }
    }
  }
  const SpecularTable table(one_channel, grid, f_r);
  EXPECT_TRUE(is_close(in_plane(table, 50.0, 89.5)[0], 1.0 / pi, rounding));
  EXPECT_EQ(in_plane(table, 50.0, 90.5)[0], 0.0);
  EXPECT_EQ(value_of(table, {0, 0, -1}, {0, 0, 1})[0], 0.0);
  constexpr double rule = 2e-4;
  for (const double theta_i : {0.0, 33.0, 60.0}) {
    EXPECT_TRUE(
        is_close(directional_hemispherical_reflectance(table, degrees(theta_i))[0], 1.0, rule))
        << theta_i;
  }
}

TEST(SpecularTable, RefusesShapesThatDoNotAgree) {
  EXPECT_EQ(
      message_of([] { (void)SpecularTable(one_channel, half_grid(), Eigen::ArrayXXd(3, 1)); }),
      "expected f_r of 1036 nodes and 1 channels, found 3, 1");
  EXPECT_EQ(message_of([] {
              SpecularTable::Grid grid = half_grid();
              grid.radial[3] = grid.radial[2];
              (void)SpecularTable(one_channel, grid, Eigen::ArrayXXd::Zero(grid.size(), 1));
            }),
            "expected radial angles that ascend in [0, 3.1416] rad");
}

}  // namespace
}  // namespace gonio::test
