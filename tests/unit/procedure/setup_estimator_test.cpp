#include "emulator/procedure/setup_estimator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/tile_set.hpp"

namespace gonio {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::is_close;
using test::tile;
using test::TileSet;
using testing::ElementsAre;

constexpr double rounding = 1e-12;

std::vector<std::string> names(const std::vector<EstimatedParameter>& parameters) {
  std::vector<std::string> result;
  for (const EstimatedParameter& one : parameters) {
    result.push_back(one.name);
  }
  return result;
}

// Before readings.

TEST(SetupEstimator, HasTheQuantitiesOfTheGeometryAndOfTheScale) {
  const TileSet set("60", {tile("glass_m050")}, 0.2, {});
  const auto& parameters = set.estimator().parameters();
  EXPECT_THAT(names(parameters), ElementsAre("theta_i", "theta_r", "source_in_plane",
                                             "source_perpendicular", "receptor_in_plane",
                                             "receptor_perpendicular", "reference_value", "zero"));
  EXPECT_TRUE(is_close(parameters[0].assumed, 60.04, rounding));  // as built
  EXPECT_TRUE(is_close(parameters[0].prior_uncertainty, 0.3, rounding));
  EXPECT_TRUE(is_close(parameters[5].prior_uncertainty, 0.6, rounding));
  EXPECT_EQ(parameters[5].unit, "deg");
  EXPECT_EQ(parameters[6].prior_uncertainty, 0.01);
  EXPECT_EQ(parameters[6].unit, "");
  EXPECT_EQ(parameters[7].prior_uncertainty, 0.2);
  EXPECT_EQ(parameters[7].unit, "GU");
}

TEST(SetupEstimator, GivesAQuantityWithoutToleranceAThirdOfADegree) {
  Instrument instrument = nominal_instrument(test::shipped_standard("iso_2813/2014"));
  GeometryAsBuilt& built = instrument.as_built["60"];
  built.receptor.diameter = AngleAsBuilt{.value = degrees(5.0)};  // the standard has a rectangle
  const std::vector<Sample> tiles{tile("glass_m050")};
  const SetupEstimator estimator(instrument, "60", tiles, {});
  EXPECT_EQ(estimator.parameters()[4].name, "receptor_diameter");
  EXPECT_TRUE(is_close(estimator.parameters()[4].prior_uncertainty, 0.3, rounding));
}

TEST(SetupEstimator, CannotBeginWhereTheImageMissesTheReceptor) {
  const Instrument astray =
      with_quantity(test::triangle_gloss(), "60", SetupQuantity::theta_r, {.value = degrees(50.0)});
  const std::vector<Sample> tiles{tile("glass_m050")};
  EXPECT_THAT(test::message_of([&] { (void)SetupEstimator(astray, "60", tiles, {}); }),
              testing::HasSubstr("expected a receptor that the image of the source reaches"));
}

// What is read.

TEST(SetupEstimator, ReadsWhatTheOpticsSeeTimesTheScale) {
  const std::vector<Sample> tiles{tile("glass_m050"), tile("paint_smooth")};
  Instrument instrument = test::triangle_gloss();
  instrument.behaviour.linearity = 0.0;
  const SetupEstimator estimator(instrument, "60", tiles, {});
  const OpticalResponse optics(instrument, "60", tiles, 1e-6);
  VectorXd x(8);
  x << optics.as_built().head(6), 0.02, 0.5;
  const VectorXd g = optics(optics.as_built());
  const VectorXd expected = 1.02 * (g.array() + 0.5) / (1.0 + 0.5 / 100.0);
  EXPECT_TRUE(is_close(estimator.reading(x)(0), expected(0), 1e-9));
  EXPECT_TRUE(is_close(estimator.reading(x)(1), expected(1), 1e-9));
}

TEST(SetupEstimator, ReadsTheValueOfTheScaleFromTheReferenceGlassWhateverTheSetUp) {
  // Even where the detector is not linear: it was adjusted there.
  const std::vector<Sample> tiles{tile("black_glass_n1567")};
  const SetupEstimator estimator(test::triangle_gloss(), "60", tiles, {});
  VectorXd x(8);
  x << 60.2, 59.9, 0.9, 2.2, 4.3, 11.8, 0.01, 0.3;
  EXPECT_TRUE(is_close(estimator.reading(x)(0), 101.0, 1e-9));
}

TEST(SetupEstimator, HasTheDerivativesOfItsReadings) {
  // Against the extrapolated ones of the optics; the steps here leave a third of a per cent.
  constexpr double of_steps = 3e-3;
  const std::vector<Sample> tiles{tile("glass_m050", degrees(0.5)), tile("copper_m065")};
  Instrument instrument = test::triangle_gloss();
  instrument.behaviour.linearity = 0.0;
  const SetupEstimator estimator(instrument, "60", tiles, {.prior_tolerances = 1.0});
  const OpticalResponse optics(instrument, "60", tiles, 1e-6);
  VectorXd x(8);
  x << optics.as_built().head(6), 0.02, 0.5;
  const MatrixXd found = estimator.jacobian(x);
  const MatrixXd of_optics =
      1.02 / 1.005 * optics.jacobian(optics.as_built(), VectorXd::Constant(8, 0.1));
  const VectorXd g = optics(optics.as_built());
  for (Index s = 0; s < 2; ++s) {
    const double largest = of_optics.row(s).head(6).cwiseAbs().maxCoeff();
    for (Index i = 0; i < 6; ++i) {
      EXPECT_TRUE(is_close(found(s, i), of_optics(s, i), of_steps * largest)) << s << " " << i;
    }
    EXPECT_TRUE(is_close(found(s, 6), (g(s) + 0.5) / 1.005, 1e-6));
    EXPECT_TRUE(is_close(found(s, 7), 1.02 * (1.0 - g(s) / 100.0) / (1.005 * 1.005), 1e-6));
  }
}

TEST(SetupEstimator, ReadsNothingFiniteWhereTheImageMissesTheReceptor) {
  const TileSet set("20", {tile("glass_m050")}, 0.2, {});
  VectorXd x = set.as_assumed();
  x(1) += 5.0;
  EXPECT_TRUE(std::isinf(set.estimator().reading(x)(0)));
  x(1) = 95.0;
  EXPECT_TRUE(std::isinf(set.estimator().reading(x)(0)));
}

TEST(SetupEstimator, HasDerivativesAtTheEdgeOfTheReceptor) {
  const TileSet set("20", {tile("glass_m050")}, 0.2, {});
  VectorXd x = set.as_assumed();
  x(1) = x(0) + 0.5 * (x(2) + x(4)) - 0.01;  // a little further, and the image misses the receptor
  ASSERT_TRUE(set.estimator().reading(x).allFinite());
  EXPECT_TRUE(set.estimator().jacobian(x).allFinite());
}

// Uncertainties of readings.

TEST(SetupEstimator, TakesTheInstrumentsNoiseAndStepWhereAReadingStatesNothing) {
  Instrument instrument = test::triangle_gloss();
  instrument.behaviour.repeatability_gu = 0.03;
  instrument.behaviour.resolution_gu = 0.04 * std::sqrt(12.0);
  const std::vector<Sample> tiles{tile("glass_m050")};
  const SetupEstimator estimator(instrument, "60", tiles, {});
  const TileReading unstated{.sample = "a", .geometry = "60", .gloss_gu = 40.0};
  TileReading stated = unstated;
  stated.expanded_uncertainty_gu = 0.1;  // twice 0.05, of 0.03 and 0.04
  EXPECT_TRUE(is_close(estimator.estimate({unstated}, {0}).chi_squared,
                       estimator.estimate({stated}, {0}).chi_squared, 1e-9));
}

TEST(SetupEstimator, AsksForAnUncertaintyThatNobodyStates) {
  Instrument instrument = test::triangle_gloss();
  instrument.behaviour = instrument.behaviour.ideal();
  const std::vector<Sample> tiles{tile("glass_m050")};
  const SetupEstimator estimator(instrument, "60", tiles, {});
  const SourceMark mark{.file = "tiles.csv", .line = 7, .column = 1, .key = "sample"};
  EXPECT_EQ(test::message_of([&] {
              (void)estimator.estimate({{.sample = "a", .geometry = "60", .mark = mark}}, {0});
            }),
            "tiles.csv:7:1: sample: expected an expanded_uncertainty_gu, as the instrument states "
            "neither a repeatability nor a resolution, found nothing");
}

TEST(SetupEstimator, NeedsATileForEachReading) {
  const std::vector<Sample> tiles{tile("glass_m050")};
  const SetupEstimator estimator(test::triangle_gloss(), "60", tiles, {});
  EXPECT_THROW((void)estimator.estimate({TileReading{}}, {1}), std::invalid_argument);
  EXPECT_THROW((void)estimator.estimate({TileReading{}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace gonio
