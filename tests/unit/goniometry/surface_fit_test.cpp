#include "emulator/goniometry/surface_fit.hpp"

#include <gtest/gtest.h>

#include <random>

#include "emulator/goniometry/fit_comparison.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/goniometry/fit_spectra.hpp"
#include "tests/unit/trials.hpp"

namespace gonio::test {
namespace {

constexpr double noise_to_signal = 1.0 / 900.0;  // the spectrometer of [Mihalik], section 6

TEST(SurfaceFit, FindsTheSlopeOfCopperWithinOnePercent) {
  constexpr unsigned seed = 1;
  std::mt19937_64 random(seed);
  const FitSpectra bench("main/Cu/Johnson.yml");
  for (const double m : {0.065, 0.2}) {
    const auto spectra =
        bench.measured(cook_torrance(bench.grid, m, bench.n_hat), noise_to_signal, random);
    const SurfaceFit fit = fit_surface(observations_of(spectra, bench.instrument),
                                       fittable_model("cook_torrance"), bench.n_hat);
    EXPECT_TRUE(fit.has_converged);
    EXPECT_TRUE(is_close_relative(fit.parameter("rms_slope").value, m, 0.01));
  }
}

/// Intervals are right as often as they say, and the model that made the spectra is found.
TEST(SurfaceFit, CoversTheTruthAndFindsTheTrueModelInTrials) {
  constexpr unsigned seed = 2;
  const std::size_t count = trials(200);
  constexpr double m = 0.2, specular = 0.7, standard_deviations = 4.0;
  std::mt19937_64 random(seed);
  const FitSpectra bench("main/Cu/Johnson.yml");
  const auto spectra = bench.exact(cook_torrance(
      bench.grid, m, bench.n_hat,
      {.specular = specular, .diffuse = Eigen::ArrayXd::Constant(bench.grid.size(), 0.2)}));
  const FitObservations exact = observations_of(spectra, bench.instrument);
  ModelResponses beckmann(exact, fittable_model("cook_torrance"), bench.n_hat);
  ModelResponses trowbridge(exact, fittable_model("ggx"), bench.n_hat);
  std::size_t slopes = 0, shares = 0, found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const FitObservations noisy =
        observations_of(bench.with_noise(spectra, noise_to_signal, random), bench.instrument);
    const std::vector<SurfaceFit> fits{fit_surface(noisy, trowbridge),
                                       fit_surface(noisy, beckmann)};
    const auto covers = [&](const char* name, double truth) {
      const FittedParameter& fitted = fits[1].parameter(name);
      return fitted.low <= truth && truth <= fitted.high;
    };
    slopes += covers("rms_slope", m) ? 1U : 0U;
    shares += covers("specular", specular) ? 1U : 0U;
    found += compare_fits(fits, true).ranking.front().fit == 1 ? 1U : 0U;
  }
  RecordProperty("slopes_covered", int(slopes));
  RecordProperty("shares_covered", int(shares));
  RecordProperty("true_model_found", int(found));
  const double chance = chance_about_95_percent(count, standard_deviations);
  EXPECT_NEAR(double(slopes) / double(count), 0.95, chance);
  EXPECT_NEAR(double(shares) / double(count), 0.95, chance);
  EXPECT_GT(double(found) / double(count), 0.95);
}

/// f_r is compared at directions: nothing is integrated, and nothing is lost.
TEST(SurfaceFit, ReturnsTheParametersOfABrdf) {
  constexpr double accuracy = 1e-4;  // of the interpolation between slopes
  const WavelengthGrid grid(nanometres(555), nanometres(1), 1);
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(1, 1.5);
  const Surface surface = cook_torrance(
      grid, 0.17, n_hat, {.specular = 0.6, .diffuse = Eigen::ArrayXd::Constant(1, 0.3)});
  BrdfSamples samples{.channels = {{}}};
  constexpr Eigen::Index n = 90;
  samples.theta_i = Eigen::ArrayXd::Constant(n, 0.6);
  samples.phi_i = Eigen::ArrayXd::Constant(n, 3.14159265358979);
  samples.theta_r = Eigen::ArrayXd::LinSpaced(n, 0.0, 1.3);
  samples.phi_r = Eigen::ArrayXd::Zero(n);
  samples.f_r.resize(n, 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    samples.f_r(i, 0) =
        surface.brdf({std::sin(0.6) * std::cos(samples.phi_i(i)),
                      std::sin(0.6) * std::sin(samples.phi_i(i)), std::cos(0.6)},
                     {std::sin(samples.theta_r(i)), 0.0, std::cos(samples.theta_r(i))})(0);
  }
  const FitObservations observations = observations_of(samples);
  std::vector<SurfaceFit> fits;
  for (const char* name : {"ggx", "cook_torrance"}) {
    fits.push_back(fit_surface(observations, fittable_model(name), n_hat));
  }
  EXPECT_TRUE(is_close_relative(fits[1].parameter("rms_slope").value, 0.17, accuracy));
  EXPECT_TRUE(is_close_relative(fits[1].parameter("specular").value, 0.6, accuracy));
  EXPECT_TRUE(is_close_relative(fits[1].parameter("diffuse").value, 0.3, accuracy));
  EXPECT_EQ(compare_fits(fits, false).ranking.front().fit, 1u);
}

}  // namespace
}  // namespace gonio::test
