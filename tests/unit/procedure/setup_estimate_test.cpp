#include "emulator/procedure/setup_estimate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/tile_set.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::parameter;
using test::tile;
using testing::ElementsAre;
using testing::SizeIs;

TileReading reading(const std::string& sample, const std::string& geometry, double gloss_gu) {
  return {.sample = sample,
          .geometry = geometry,
          .gloss_gu = gloss_gu,
          .expanded_uncertainty_gu = 0.2,
          .geometry_mark = {.file = "tiles.csv", .line = 2, .column = 12, .key = "geometry"}};
}

std::vector<SetupEstimate> estimates_of(const std::vector<TileReading>& readings,
                                        const SetupEstimateOptions& options = {}) {
  std::vector<Sample> tiles;
  for (const TileReading& one : readings) {
    tiles.push_back(tile(one.sample));
  }
  return estimate_setup(test::triangle_gloss(), readings, tiles, options);
}

TEST(EstimateSetup, GivesOneEstimateForEachGeometryReadInTheInstrumentsOrder) {
  const auto estimates =
      estimates_of({reading("glass_m050", "85", 38.0), reading("glass_m100", "20", 1.6),
                    reading("glass_m100", "85", 20.0)});
  ASSERT_THAT(estimates, SizeIs(2));
  EXPECT_EQ(estimates[0].geometry, "20");
  EXPECT_EQ(estimates[1].geometry, "85");
  EXPECT_EQ(estimates[1].degrees_of_freedom, 2u);
  ASSERT_THAT(estimates[1].readings, SizeIs(2));
  EXPECT_EQ(estimates[1].readings[1].sample, "glass_m100");
  EXPECT_THAT(estimates[1].residual_gu, SizeIs(2));
}

TEST(EstimateSetup, GivesNothingWithoutReadings) { EXPECT_TRUE(estimates_of({}).empty()); }

TEST(EstimateSetup, RefusesAGeometryThatTheInstrumentHasNot) {
  EXPECT_EQ(test::message_of([] { (void)estimates_of({reading("glass_m050", "45", 38.0)}); }),
            "tiles.csv:2:12: geometry: expected one of the geometries 20, 60, 85, found '45'");
}

TEST(EstimateSetup, NeedsATileForEachReading) {
  EXPECT_THROW(
      (void)estimate_setup(test::triangle_gloss(), {reading("glass_m050", "60", 41.0)}, {}, {}),
      std::invalid_argument);
}

TEST(EstimateSetup, TakesARepeatedReadingForMoreOfTheSame) {
  // Four readings say what one of half the uncertainty says.
  const TileReading once = reading("glass_m050", "60", 41.5);
  TileReading surer = once;
  surer.expanded_uncertainty_gu = 0.1;
  const auto four = estimates_of({once, once, once, once});
  const auto one = estimates_of({surer});
  for (std::size_t i = 0; i < one[0].parameters.size(); ++i) {
    const EstimatedParameter& expected = one[0].parameters[i];
    EXPECT_TRUE(is_close(four[0].parameters[i].estimate, expected.estimate,
                         0.01 * expected.standard_uncertainty));
    EXPECT_TRUE(is_close(four[0].parameters[i].standard_uncertainty, expected.standard_uncertainty,
                         0.01 * expected.standard_uncertainty));
  }
}

// The shipped example, whose comment tells what was planted.

std::vector<SetupEstimate> shipped_estimates() {
  const auto readings =
      load_tile_readings(test::shipped().fixture("measured/tiles_triangle_gloss.csv"));
  std::vector<Sample> tiles;
  for (const TileReading& one : readings) {
    tiles.push_back(test::shipped_sample(one.sample));
  }
  return estimate_setup(test::triangle_gloss(), readings, tiles, {});
}

TEST(ShippedReadings, ComeFromTheSetUpThatTheirCommentTells) {
  const std::map<std::string, std::map<std::string, double>> planted{
      {"20", {{"source_perpendicular", 2.9}, {"reference_value", 0.004}, {"zero", 0.12}}},
      {"60",
       {{"theta_i", 60.16},
        {"receptor_in_plane", 4.58},
        {"reference_value", 0.003},
        {"zero", 0.1}}},
      {"85",
       {{"theta_r", 84.91},
        {"receptor_in_plane", 4.3},
        {"reference_value", -0.002},
        {"zero", 0.1}}}};
  const std::vector<SetupEstimate> estimates = shipped_estimates();
  ASSERT_THAT(estimates, SizeIs(3));
  for (const SetupEstimate& found : estimates) {
    EXPECT_TRUE(found.has_converged);
    EXPECT_GT(found.p_value, 0.01);
    for (const EstimatedParameter& one : found.parameters) {
      const auto& deviations = planted.at(found.geometry);
      const auto deviation = deviations.find(one.name);
      const double expected = deviation == deviations.end() ? one.assumed : deviation->second;
      // 24 parameters: the largest of so many is seldom beyond three.
      EXPECT_TRUE(is_close(one.estimate, expected, 3.0 * one.standard_uncertainty))
          << found.geometry << " " << one.name;
    }
  }
  const EstimatedParameter& theta_i = parameter(estimates[1], "theta_i");  // beyond its limit
  EXPECT_TRUE(theta_i.is_determined);
  EXPECT_GT(theta_i.estimate - 2.0 * theta_i.standard_uncertainty, 60.1);
}

}  // namespace
}  // namespace gonio
