#include "emulator/procedure/certify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/certification.hpp"

namespace gonio {
namespace {

using test::all_normal;
using test::clauses_of;
using test::message_of;
using test::rungs;
using test::triangle_gloss;

Certificate certified(const Instrument& instrument, const std::vector<Sample>& ladder,
                      const CertifyOptions& options) {
  return certify(instrument, clauses_of("iso_2813/2014"), ladder, options);
}

void expect_limits_effects_and_uncertainty(const Certificate& certificate) {
  EXPECT_EQ(certificate.verdict, ConformanceVerdict::pass);
  EXPECT_EQ(certificate.samples.size(), 4U);
  ASSERT_EQ(certificate.geometries.size(), 3U);
  for (const GeometryCertificate& geometry : certificate.geometries) {
    ASSERT_EQ(geometry.readings.size(), certificate.samples.size());
    ASSERT_EQ(geometry.effects.back().component, "all");
    for (std::size_t s = 0; s < geometry.readings.size(); ++s) {
      const CertifiedReading& reading = geometry.readings[s];
      EXPECT_GT(reading.propagated.expanded_uncertainty, 0.0);
      EXPECT_NEAR(reading.deviation_gu(), geometry.effects.back().as_built_gu[s], 1e-5)
          << geometry.id << ' ' << certificate.samples[s];
      EXPECT_LE(reading.lowest.change_gu, 0.0);
      EXPECT_GE(reading.highest.change_gu, 0.0);
    }
  }
}

void expect_shares_of_one(const Certificate& certificate) {
  for (const GeometryCertificate& geometry : certificate.geometries) {
    for (const CertifiedReading& reading : geometry.readings) {
      double sum = 0.0;
      for (const Contribution& part : reading.propagated.budget) {
        sum += part.share;
      }
      EXPECT_NEAR(sum, 1.0, 1e-9) << geometry.id;
    }
  }
}

void expect_surrogates_good_to_a_thousandth(const Certificate& certificate) {
  for (const GeometryCertificate& geometry : certificate.geometries) {
    EXPECT_THAT(geometry.direct_samples, testing::IsEmpty()) << geometry.id;
    EXPECT_THAT(geometry.surrogate_error_gu, testing::Each(testing::Lt(1e-3))) << geometry.id;
  }
}

void expect_sensitivities_of_plain_differences(const Certificate& certificate) {
  for (const GeometryCertificate& geometry : certificate.geometries) {
    for (std::size_t s = 0; s < geometry.readings.size(); ++s) {
      const CertifiedReading& reading = geometry.readings[s];
      for (std::size_t i = 0; i < reading.sensitivity_error.size(); ++i) {
        const double u = certificate.inputs[i].distribution.standard_uncertainty;
        // Differences one standard uncertainty wide see some curvature.
        EXPECT_LE(std::abs(reading.sensitivity_error[i]) * u,
                  0.02 * reading.propagated.standard_uncertainty)
            << geometry.id << ' ' << certificate.samples[s] << ' ' << certificate.inputs[i].id;
      }
    }
  }
}

/// One certificate for all that is expected of it: it is dear to make.
TEST(Certify, OfTheShippedInstrumentHoldsTogether) {
  const Certificate certificate = certified(
      triangle_gloss(), rungs({"white_diffuser", "glass_m050", "paint_smooth", "ideal_mirror"}),
      {.trials = 20'000});
  expect_limits_effects_and_uncertainty(certificate);
  expect_shares_of_one(certificate);
  expect_surrogates_good_to_a_thousandth(certificate);
  expect_sensitivities_of_plain_differences(certificate);
}

TEST(Certify, BothMethodsAgreeWithinTwoPercentOnALinearSetup) {
  constexpr std::size_t trials = 200'000;  // leaves 0.5 % of noise in U
  const Certificate certificate =
      certified(triangle_gloss(all_normal), rungs({"glass_m100", "paint_smooth", "copper_m065"}),
                {.trials = trials});
  EXPECT_GE(certificate.trials, trials);
  for (const GeometryCertificate& geometry : certificate.geometries) {
    for (const CertifiedReading& reading : geometry.readings) {
      const double U = reading.propagated.expanded_uncertainty;
      EXPECT_NEAR(reading.monte_carlo.expanded_uncertainty(), U, 0.02 * U) << geometry.id;
      EXPECT_NEAR(reading.monte_carlo.mean, reading.gloss_gu, 0.02 * U) << geometry.id;
      EXPECT_TRUE(reading.methods_agree) << geometry.id;
    }
  }
}

/// A narrow lobe seen by a receptor right at its peak: the first derivative vanishes, the reading
/// can only fall. The law of propagation does not see that.
TEST(Certify, BothMethodsDisagreeAtThePeakOfANarrowLobe) {
  Instrument instrument = triangle_gloss(
      "{setup_uncertainty: {angles: 0 deg, apertures: 0 deg}, as_built: {\"60\": {theta_i: {value: "
      "60 deg, expanded_uncertainty: 0 deg}, "
      "theta_r: {value: 60 deg, expanded_uncertainty: 0.6 deg}}}}");
  instrument.uncertainty->correlations.clear();
  const Certificate certificate = certified(instrument, rungs({"glass_m020", "paint_m150"}),
                                            {.geometries = {"60"}, .trials = 50'000});
  const CertifiedReading& narrow = certificate.geometries[0].readings[0];
  EXPECT_FALSE(narrow.methods_agree);
  EXPECT_LT(narrow.monte_carlo.mean, narrow.gloss_gu);
  EXPECT_TRUE(certificate.geometries[0].readings[1].methods_agree);  // a wide one
}

TEST(Certify, IsTheSameForTheSameSeed) {
  const CertifyOptions options{.geometries = {"60"}, .seed = 7, .trials = 20'000};
  const auto ladder = rungs({"glass_m050"});
  const MonteCarloOutput a =
      certified(triangle_gloss(), ladder, options).geometries[0].readings[0].monte_carlo;
  const MonteCarloOutput b =
      certified(triangle_gloss(), ladder, options).geometries[0].readings[0].monte_carlo;
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

TEST(Certify, WantsEveryUncertaintyStated) {
  Instrument instrument = triangle_gloss();
  instrument.uncertainty.reset();
  EXPECT_THAT(
      message_of([&] { (void)certified(instrument, rungs({"glass_m050"}), {}); }),
      testing::AllOf(testing::HasSubstr("triangle_gloss.yaml"), testing::HasSubstr("uncertainty")));
}

TEST(Certify, WantsCorrelationsThatCanBe) {
  const std::string message = message_of([] {
    (void)certified(triangle_gloss("{uncertainty: {correlations: ["
                                   "{between: [theta_i, theta_r], coefficient: 0.9},"
                                   "{between: [theta_i, receptor_in_plane], coefficient: 0.9},"
                                   "{between: [theta_r, receptor_in_plane], coefficient: -0.9}]}}"),
                    rungs({"glass_m050"}), {});
  });
  EXPECT_THAT(message, testing::AllOf(testing::HasSubstr("overlay:1:"),
                                      testing::HasSubstr("positive definite")));
}

TEST(Certify, WantsGeometriesThatTheInstrumentHas) {
  EXPECT_THAT(message_of([] {
                (void)certified(triangle_gloss(), rungs({"glass_m050"}), {.geometries = {"45"}});
              }),
              testing::HasSubstr("'45'"));
}

}  // namespace
}  // namespace gonio
