#include "emulator/goniometry/setup_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "emulator/core/parallel_for.hpp"
#include "tests/unit/goniometry/simulated_spectra.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"
#include "tests/unit/trials.hpp"

namespace gonio::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

const std::vector<std::string> all_angles{"20", "60", "85"};

/// Angles are planted so that the receptor's edge stays within the image: beyond it a second set-up
/// explains the same spectra, see the test of what else explains them.
/// The paper's set-up with a receptor that sees a part of the source's image: of black glass with
/// dispersion at three angles, two of which and the receptor are to be found.
Unknown angles_and_receptor() {
  std::vector<CalibrationSpectrum> spectra;
  for (const std::string& geometry : all_angles) {
    spectra.push_back(unmeasured(shipped_family("s_til26"), geometry));
  }
  return {.instrument = with_diameter(shipped_instrument("paper_setup"), all_angles,
                                      SetupQuantity::receptor_diameter, 4.0),
          .spectra = std::move(spectra),
          .free = {"theta_i:60", "theta_i:85", "receptor"}};
}

/// All four at 60 deg: the glass, a mirror, and the mirror on wedges of both directions, which
/// drives the image over both edges of the receptor.
Unknown all_at_60(const TemporaryFolder& folder) {
  const auto mirror = [&](const std::string& name, const std::string& tilt) {
    return family(folder.file(name + ".yaml", "schema: gonio/sample/1\nid: " + name +
                                                  "\ntitle: Mirror on a wedge\ntilt: " + tilt +
                                                  "\nsurface: {model: smooth, reflectance: 1}\n"));
  };
  return {.instrument = with_diameter(shipped_instrument("paper_setup"), {"60"},
                                      SetupQuantity::receptor_diameter, 4.0),
          .spectra = {unmeasured(shipped_family("s_til26"), "60"),
                      unmeasured(mirror("flat", "0 deg"), "60"),
                      unmeasured(mirror("up", "1.2 deg"), "60"),
                      unmeasured(mirror("down", "-1.2 deg"), "60")},
          .free = {"theta_i", "theta_r", "source", "receptor"}};
}

/// How often the region held what was planted.
struct Coverage {
  std::size_t joint = 0, converged = 0;
  std::vector<std::size_t> own = {};  // by parameter
};

constexpr std::uint64_t seed_of_noise = 2813;
constexpr std::uint64_t seed_of_setups = 523;

/// @param spread  of what is planted round what is assumed, standard, by parameter.
Coverage coverage(const Unknown& unknown, const VectorXd& spread, std::size_t trials,
                  bool states_u) {
  const SetupModel model = unknown.model();
  const Index p = spread.size();
  std::vector<SetupCalibration> found(trials, {.instrument = unknown.instrument});
  std::vector<VectorXd> planted(trials, VectorXd(p));
  parallel_for(trials, [&](std::size_t k) {
    Draws(seed_of_setups, k).normal({planted[k].data(), std::size_t(p)});
    planted[k] = model.assumed() + planted[k].cwiseProduct(spread);
    const SetupModel measured = unknown.measured(model(planted[k]), seed_of_noise, k, states_u);
    found[k] = calibrate_setup(measured, model.assumed());
  });
  Coverage result{.own = std::vector<std::size_t>(std::size_t(p))};
  for (std::size_t k = 0; k < trials; ++k) {
    result.joint += found[k].distance(planted[k]) <= found[k].region_quantile ? 1 : 0;
    result.converged += found[k].has_converged ? 1 : 0;
    for (Index i = 0; i < p; ++i) {
      const CalibratedParameter& one = found[k].parameters[std::size_t(i)];
      result.own[std::size_t(i)] += one.low <= planted[k](i) && planted[k](i) <= one.high ? 1 : 0;
    }
  }
  return result;
}

/// Of 200 trials 190 are expected; the band of 2.58 standard deviations of that binomial count is
/// 182 to 198, and leaves 1 % to chance.
constexpr std::size_t trials_of_region = test::trials(200);
constexpr double standard_deviations = 2.58;

void expect_coverage(const Coverage& found) {
  const double n = double(trials_of_region);
  const double band = chance_about_95_percent(trials_of_region, standard_deviations);
  EXPECT_NEAR(double(found.joint) / n, 0.95, band) << found.joint << " of " << n << " joint";
  for (std::size_t i = 0; i < found.own.size(); ++i) {
    EXPECT_NEAR(double(found.own[i]) / n, 0.95, band) << found.own[i] << " of parameter " << i;
  }
  EXPECT_EQ(found.converged, trials_of_region);
  testing::Test::RecordProperty("joint", int(found.joint));
}

TEST(CalibrateSetup, HasPlantedAnglesAndReceptorInItsRegionIn95PercentOfTrials) {
  expect_coverage(
      coverage(angles_and_receptor(), VectorXd{{0.08, 0.08, 0.05}}, trials_of_region, true));
}

TEST(CalibrateSetup, HasAllOfAPlantedSetUpInItsRegionIn95PercentOfTrials) {
  const TemporaryFolder folder;
  expect_coverage(
      coverage(all_at_60(folder), VectorXd{{0.2, 0.1, 0.1, 0.1}}, trials_of_region, true));
}

TEST(CalibrateSetup, HoldsItsRegionWhereUComesFromTheResiduals) {
  const TemporaryFolder folder;
  expect_coverage(
      coverage(all_at_60(folder), VectorXd{{0.2, 0.1, 0.1, 0.1}}, trials_of_region, false));
}

TEST(CalibrateSetup, FindsASetUpWithoutNoise) {
  const TemporaryFolder folder;
  const Unknown unknown = all_at_60(folder);
  const SetupModel model = unknown.model();
  const VectorXd planted = model.assumed() + VectorXd{{0.3, -0.2, 0.15, -0.1}};
  std::vector<CalibrationSpectrum> spectra = unknown.spectra;
  const VectorXd exact = model(planted);
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    spectra[i].spectrum.reflectance = exact.segment(Index(i) * 16, 16);
  }
  const SetupCalibration found = calibrate_setup(unknown.model(spectra), model.assumed());
  constexpr double tolerance_deg = 1e-4;  // the search ends where spectra are met to 1e-5
  for (Index i = 0; i < planted.size(); ++i) {
    EXPECT_NEAR(found.parameters[std::size_t(i)].estimate, planted(i), tolerance_deg);
    EXPECT_TRUE(found.parameters[std::size_t(i)].is_determined);
  }
  EXPECT_TRUE(found.confusions.empty());
  EXPECT_LT(found.rmse, 1e-5);
  EXPECT_GT(found.rmse_at_start, 1e-2);
}

TEST(CalibrateSetup, SaysThatABlackGlassTellsNothingOfAReceptorThatIsLarger) {
  Unknown unknown = angles_and_receptor();
  unknown.instrument =
      with_diameter(unknown.instrument, all_angles, SetupQuantity::receptor_diameter, 6.0);
  unknown.free = {"theta_i:60", "theta_r:60", "receptor"};
  const SetupModel model = unknown.model();
  const SetupModel measured = unknown.measured(model(model.assumed()), seed_of_noise, 0);
  const SetupCalibration found = calibrate_setup(measured, model.assumed());
  const auto& [theta_i, theta_r, receptor] =
      std::tie(found.parameters[0], found.parameters[1], found.parameters[2]);
  EXPECT_TRUE(theta_i.is_determined);
  for (const CalibratedParameter& one : {theta_r, receptor}) {
    EXPECT_FALSE(one.is_determined) << one.parameter.name;
    EXPECT_EQ(one.effect, 0.0) << one.parameter.name;
    EXPECT_EQ(one.estimate, one.start) << one.parameter.name;
  }
  ASSERT_EQ(found.confusions.size(), 2u);
  EXPECT_NEAR(found.confusions[0].remaining, 1.0, 1e-9);
  EXPECT_NEAR(std::abs(found.confusions[0].direction[1]), 1.0, 1e-6);
  EXPECT_NEAR(std::abs(found.confusions[1].direction[2]), 1.0, 1e-6);
}

TEST(CalibrateSetup, SaysThatOneGlassDoesNotTellAScaleFromAnOpening) {
  // A receptor within the image takes the share (sin r / sin s)^2 of any spectrum at 20 deg, where
  // reflectance hardly changes over it: so does a scale.
  Unknown unknown = angles_and_receptor();
  unknown.spectra = {unmeasured(shipped_family("black_glass_n1567"), "20")};
  unknown.free = {"receptor", "scale"};
  const SetupModel model = unknown.model();
  const SetupModel measured = unknown.measured(model(model.assumed()), seed_of_noise, 0);
  const SetupCalibration found = calibrate_setup(measured, model.assumed());
  ASSERT_EQ(found.confusions.size(), 1u);
  const Confusion& confusion = found.confusions.front();
  EXPECT_GT(confusion.remaining, 0.9);
  EXPECT_LT(confusion.direction[0] * confusion.direction[1], 0.0);
  EXPECT_GT(found.parameters[1].effect, 100.0) << "each alone would be told";
}

TEST(CalibrateSetup, StatesAnUncertaintyThatFallsAsNoiseDoes) {
  const TemporaryFolder folder;
  const Unknown unknown = all_at_60(folder);
  const SetupModel model = unknown.model();
  const SetupModel measured = unknown.measured(model(model.assumed()), seed_of_noise, 0);
  std::vector<CalibrationSpectrum> noisier = measured.spectra();
  for (CalibrationSpectrum& one : noisier) {
    one.spectrum.u *= 2.0;
  }
  const SetupCalibration found = calibrate_setup(measured, model.assumed());
  const SetupCalibration doubled = calibrate_setup(unknown.model(noisier), model.assumed());
  for (std::size_t i = 0; i < found.parameters.size(); ++i) {
    EXPECT_NEAR(doubled.parameters[i].u / found.parameters[i].u, 2.0, 0.02);
  }
  EXPECT_GT(found.p_value, 1e-3);
  EXPECT_GT(doubled.p_value, 0.999) << "of residuals that are too small for such an u";
}

TEST(CalibrateSetup, StatesTheEstimateInTheInstrument) {
  const Unknown unknown = angles_and_receptor();
  const SetupModel model = unknown.model();
  const SetupModel measured = unknown.measured(model(model.assumed()), seed_of_noise, 0);
  const SetupCalibration found = calibrate_setup(measured, model.assumed());
  const auto theta = as_built(found.instrument, "60", SetupQuantity::theta_i);
  EXPECT_NEAR(theta->value.degrees(), found.parameters[0].estimate, 1e-12);
  EXPECT_NEAR(theta->expanded_uncertainty.degrees(), 2.0 * found.parameters[0].u, 1e-12);
  for (const std::string& geometry : all_angles) {
    EXPECT_NEAR(
        as_built(found.instrument, geometry, SetupQuantity::receptor_diameter)->value.degrees(),
        found.parameters[2].estimate, 1e-12);
  }
}

TEST(OtherSetups, AreThoseThatExplainTheSameSpectra) {
  // More light by a steeper angle, and less because the receptor's edge cuts the image: as one that
  // is not cut.
  const Unknown unknown = angles_and_receptor();
  const SetupModel model = unknown.model();
  const VectorXd planted = model.assumed() + VectorXd{{0.58, 0.0, 0.0}};
  const SetupModel measured = unknown.measured(model(planted), seed_of_noise, 0);
  const SetupCalibration found = calibrate_setup(measured, model.assumed());
  std::vector<VectorXd> all;
  for (const OtherSetup& other : other_setups(measured, found)) {
    EXPECT_LE(other.chi_squared, found.chi_squared + found.region_quantile);
    all.push_back(other.estimate);
  }
  ASSERT_FALSE(all.empty());
  constexpr double tolerance_deg = 0.05;
  EXPECT_TRUE(found.distance(planted) <= found.region_quantile ||
              std::ranges::any_of(all, [&](const VectorXd& other) {
                return (other - planted).cwiseAbs().maxCoeff() < tolerance_deg;
              }));
}

TEST(SearchSetup, LeavesAMinimumThatIsNotTheBest) {
  // From a receptor as large as the source its derivative is that of an edge.
  Unknown unknown = angles_and_receptor();
  unknown.instrument =
      with_diameter(unknown.instrument, all_angles, SetupQuantity::receptor_diameter, 4.7);
  unknown.free = {"theta", "receptor", "scale"};
  const SetupModel model = unknown.model();
  const VectorXd planted = model.assumed() + VectorXd{{0.1, 0.25, -0.1, 0.5, 0.0}};
  const SetupModel measured = unknown.measured(model(planted), seed_of_noise, 0);
  const SearchedSetup found = search_setup(measured, {model.assumed()});
  EXPECT_GT(found.best.p_value, 1e-3);
  constexpr double tolerance_deg = 0.1;
  EXPECT_NEAR(found.best.parameters[1].estimate, planted(1), tolerance_deg);
  for (const OtherSetup& other : found.others) {
    EXPECT_GE(other.chi_squared, found.best.chi_squared - 0.1);
  }
}

TEST(CalibrateSetup, RefusesWhatCannotBeFitted) {
  Unknown unknown = angles_and_receptor();
  unknown.free = {};
  EXPECT_EQ(message_of([&] { (void)calibrate_setup(unknown.model(), VectorXd()); }),
            "calibrate_setup: expected a parameter and more values than parameters, found 0 "
            "parameters and 48 values");
}

TEST(SetupParameters, AreThoseThatNamesStandFor) {
  const Instrument paper = shipped_instrument("paper_setup");
  std::vector<std::string> names;
  for (const SetupParameter& parameter :
       setup_parameters(paper, {"20", "60"}, {"theta_i", "source", "receptor:60", "scale"})) {
    names.push_back(parameter.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"theta_i 20", "theta_i 60", "source_diameter",
                                             "receptor_diameter 60", "scale"}));
  names.clear();
  for (const SetupParameter& parameter :
       setup_parameters(shipped_instrument("triangle_gloss"), {"60"}, {"source", "index"})) {
    names.push_back(parameter.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"source_in_plane 60", "source_perpendicular 60",
                                             "index offset"}));
}

TEST(SetupParameters, RefusesOtherNames) {
  const Instrument paper = shipped_instrument("paper_setup");
  const auto refusal = [&](const std::vector<std::string>& names) {
    return message_of([&] { (void)setup_parameters(paper, {"20", "60"}, names); });
  };
  EXPECT_EQ(
      refusal({"lamp"}),
      "expected theta_i, theta_r, theta, source, receptor, scale or index as a parameter, of one "
      "geometry with :<id> behind it, found 'lamp'");
  EXPECT_EQ(refusal({"theta_i:85"}),
            "'theta_i:85': expected one of the geometries 20, 60, found '85'");
  EXPECT_EQ(refusal({"theta_i", "theta_i:60"}),
            "expected each parameter once, found 'theta_i 60' twice");
}

}  // namespace
}  // namespace gonio::test
