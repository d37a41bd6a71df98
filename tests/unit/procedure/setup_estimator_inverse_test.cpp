#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "emulator/procedure/setup_estimator.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/tile_set.hpp"

namespace gonio {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::is_close;
using test::parameter;
using test::place;
using test::quick_tiles;
using test::tile;
using test::TileSet;
using test::useful_tiles;

// From readings back to the set-up.

TEST(SetupEstimate, OfReadingsAsAssumedIsAsAssumed) {
  const TileSet set("60", useful_tiles(), 0.2, {});
  const SetupEstimate found = set.estimate_of(set.as_assumed());
  EXPECT_TRUE(found.has_converged);
  EXPECT_LT(found.chi_squared, 1e-9);
  EXPECT_GT(found.p_value, 0.999);
  for (const EstimatedParameter& one : found.parameters) {
    EXPECT_TRUE(is_close(one.estimate, one.assumed, 1e-6)) << one.name;
    EXPECT_LT(one.standard_uncertainty, one.prior_uncertainty) << one.name;
  }
}

TEST(SetupEstimate, OfReadingsWithoutNoiseIsTheSetUp) {
  // Readings so certain that the priors weigh nothing: what is left of the way is theirs, and
  // that of a search that ends at a tenth of an uncertainty.
  constexpr double share_of_u = 0.2;
  const TileSet set("60", useful_tiles(), 0.002, {.prior_tolerances = 1.0});
  VectorXd t(8);
  t << 1.0, -0.5, 0.4, -0.3, 1.2, -0.8, 0.5, 0.7;
  const VectorXd planted = set.setup(t);
  const SetupEstimate found = set.estimate_of(planted);
  EXPECT_TRUE(found.has_converged);
  for (std::size_t i = 0; i < 8; ++i) {
    const EstimatedParameter& one = found.parameters[i];
    EXPECT_TRUE(one.is_determined) << one.name;
    EXPECT_TRUE(is_close(one.estimate, planted(Index(i)), share_of_u * one.standard_uncertainty))
        << one.name;
  }
  for (const double residual : found.residual_gu) {
    EXPECT_LT(std::abs(residual), set.u_gu());
  }
}

TEST(SetupEstimate, DeterminesAnglesAndReceptorFromAUsefulSetOfTiles) {
  for (const char* geometry : {"60", "85"}) {
    const TileSet set(geometry, useful_tiles(), 0.1, {.tolerance = 1e-4});
    const SetupEstimate found = set.estimate_of(set.as_assumed());
    for (const char* name :
         {"theta_i", "theta_r", "receptor_in_plane", "receptor_perpendicular", "reference_value"}) {
      EXPECT_TRUE(parameter(found, name).is_determined) << geometry << " " << name;
    }
  }
}

TEST(SetupEstimate, TellsThatMirrorsSayNothingOfOpenings) {
  const TileSet set("60",
                    {tile("ideal_mirror"), tile("paint_smooth"), tile("glass_n1800"),
                     tile("aluminium_smooth"), tile("gold_smooth_johnson")},
                    0.1, {});
  const SetupEstimate found = set.estimate_of(set.as_assumed());
  std::vector<std::string> open;  // named one by one
  for (const Confusion& confusion : found.confusions) {
    for (std::size_t i = 0; i < found.parameters.size(); ++i) {
      if (confusion.direction[i] > 0.99 && confusion.remaining > 0.99) {
        open.push_back(found.parameters[i].name);
      }
    }
  }
  EXPECT_THAT(open, testing::IsSupersetOf({"source_in_plane", "source_perpendicular",
                                           "receptor_in_plane", "receptor_perpendicular"}));
  EXPECT_FALSE(parameter(found, "receptor_in_plane").is_determined);
  EXPECT_TRUE(parameter(found, "theta_i").is_determined);  // by Fresnel's reflectance
}

TEST(SetupEstimate, TellsThatWideLobesShowTheAreaOfTheReceptorOnly) {
  const TileSet set(
      "20",
      {tile("paint_m300"), tile("white_diffuser"), tile("paint_m150"), tile("aluminium_m200")},
      0.02, {.prior_tolerances = 1.0});
  const SetupEstimate found = set.estimate_of(set.as_assumed());
  const std::size_t in_plane = place(found, "receptor_in_plane");
  const std::size_t perpendicular = place(found, "receptor_perpendicular");
  EXPECT_FALSE(found.parameters[in_plane].is_determined);
  EXPECT_FALSE(found.parameters[perpendicular].is_determined);
  EXPECT_LT(found.correlation[in_plane][perpendicular], -0.8);  // the larger one, the smaller other
  EXPECT_TRUE(std::ranges::any_of(found.confusions, [&](const Confusion& confusion) {
    return confusion.remaining > 0.9 &&
           confusion.direction[in_plane] * confusion.direction[perpendicular] < -0.2;
  }));
}

TEST(SetupEstimate, TellsThatTiltedTilesShowTheDifferenceOfTheAngles) {
  const TileSet set("20",
                    {tile("glass_m030", degrees(0.5)), tile("glass_m030", degrees(-0.5)),
                     tile("glass_m030"), tile("glass_m050")},
                    0.1, {.prior_tolerances = 1.0});
  const SetupEstimate found = set.estimate_of(set.as_assumed());
  const std::size_t theta_i = place(found, "theta_i");
  const std::size_t theta_r = place(found, "theta_r");
  EXPECT_FALSE(found.parameters[theta_i].is_determined);
  EXPECT_GT(found.correlation[theta_i][theta_r], 0.9);
  EXPECT_TRUE(std::ranges::any_of(found.confusions, [&](const Confusion& confusion) {
    return confusion.remaining > 0.9 &&
           confusion.direction[theta_i] * confusion.direction[theta_r] > 0.4;
  }));
}

TEST(SetupEstimate, ShowsAGrossErrorOfOneReading) {
  const TileSet set("60", quick_tiles("60"), 0.2, {});
  VectorXd gloss_gu = set.estimator().reading(set.as_assumed());
  gloss_gu(3) += 3.0;  // thirty uncertainties
  const SetupEstimate found = set.estimate(gloss_gu);
  EXPECT_LT(found.p_value, 1e-6);
  EXPECT_GT(found.chi_squared, 10.0 * double(found.degrees_of_freedom));
}

}  // namespace
}  // namespace gonio
