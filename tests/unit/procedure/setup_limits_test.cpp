#include "emulator/procedure/setup_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/procedure/certification.hpp"

namespace gonio {
namespace {

using test::clauses_of;
using test::triangle_gloss;
using enum ConformanceVerdict;

constexpr JudgementRule guarded{};
constexpr JudgementRule simple{.rule = DecisionRule::simple};

std::vector<CertificateLimit> judged(const Instrument& instrument,
                                     const JudgementRule& rule = guarded) {
  return judge_limits(instrument, clauses_of("iso_2813/2014"), instrument.geometries, rule);
}

const CertificateLimit& find(const std::vector<CertificateLimit>& limits,
                             const std::string& quantity, const std::string& geometry = "") {
  for (const CertificateLimit& limit : limits) {
    if (limit.limit.quantity == quantity && limit.limit.geometry == geometry) {
      return limit;
    }
  }
  throw std::out_of_range(quantity + " at " + geometry);
}

TEST(SetupLimits, OfAnInstrumentWithinThemAllPass) {
  const auto limits = judged(triangle_gloss());
  for (const CertificateLimit& limit : limits) {
    if (limit.counts) {
      EXPECT_EQ(limit.verdict, pass) << limit.clause;
    }
  }
  EXPECT_EQ(verdict_of(limits), pass);
}

TEST(SetupLimits, TellNominalLimitAsBuiltAndSource) {
  const auto limits = judged(triangle_gloss());
  const CertificateLimit& theta_i = find(limits, "theta_i", "60");
  EXPECT_EQ(theta_i.clause, "geometry/incidence_60");
  EXPECT_DOUBLE_EQ(*theta_i.limit.nominal, 60.0);
  EXPECT_DOUBLE_EQ(*theta_i.limit.tolerance, 0.1);
  EXPECT_DOUBLE_EQ(*theta_i.as_built, 60.04);
  EXPECT_DOUBLE_EQ(theta_i.expanded_uncertainty, 0.01);
  EXPECT_TRUE(theta_i.limit.mark.file.ends_with("standard.yaml"));
  EXPECT_FALSE(theta_i.limit.evidence.sources.empty());
  EXPECT_NEAR(*theta_i.probability, 1.0, 1e-9);
}

TEST(SetupLimits, AreMissedByAnAngleThatIsOff) {
  const auto limits = judged(triangle_gloss("{as_built: {\"60\": {theta_i: 60.2 deg}}}"));
  EXPECT_EQ(find(limits, "theta_i", "60").verdict, fail);
  EXPECT_EQ(find(limits, "theta_i", "20").verdict, pass);
  EXPECT_EQ(verdict_of(limits), fail);
}

TEST(SetupLimits, AreGuardedByTheUncertaintyOfWhatWasFound) {
  const Instrument near_limit = triangle_gloss("{as_built: {\"60\": {theta_i: 60.095 deg}}}");
  EXPECT_EQ(find(judged(near_limit), "theta_i", "60").verdict, inconclusive);
  EXPECT_EQ(find(judged(near_limit, simple), "theta_i", "60").verdict, pass);
  const JudgementRule half_band{.guard_band_factor = 0.4};
  EXPECT_EQ(find(judged(near_limit, half_band), "theta_i", "60").verdict, pass);
  // u = 0.005 deg, and 0.005 deg to the limit: 84.13 % of a normal distribution.
  EXPECT_NEAR(*find(judged(near_limit), "theta_i", "60").probability, 0.8413, 1e-4);
}

TEST(SetupLimits, OfGeometriesThatAreNotCertifiedAreLeftOut) {
  const Instrument instrument = triangle_gloss();
  for (const CertificateLimit& limit :
       judge_limits(instrument, clauses_of("iso_2813/2014"), {"20"}, guarded)) {
    EXPECT_TRUE(limit.limit.geometry.empty() || limit.limit.geometry == "20") << limit.clause;
  }
}

TEST(SetupLimits, OfTheDetectorAreJudgedToo) {
  const auto limits = judged(triangle_gloss());
  EXPECT_DOUBLE_EQ(*find(limits, "linearity").as_built, 0.0005);
  EXPECT_EQ(find(limits, "linearity").verdict, pass);
  EXPECT_FALSE(find(limits, "linearity").counts);  // known from memory
  const auto bent = judged(triangle_gloss("{behaviour: {linearity: 0.03}}"));
  EXPECT_EQ(find(bent, "linearity").verdict, fail);
  // 0.0002 an hour that tends to 0.004, after 8 h; right after warm-up exp(-5) of 0.02 is lost.
  const double at_end = 1.0 - 0.004 * (1.0 - std::exp(-0.4));
  const double at_calibration = 1.0 - 0.02 * std::exp(-5.0);
  EXPECT_NEAR(*find(limits, "drift").as_built, 100.0 * (at_end / at_calibration - 1.0), 1e-4);
}

TEST(SetupLimits, OfTheImageTakeBothAnglesTogether) {
  const auto limits = judged(triangle_gloss());
  EXPECT_NEAR(*find(limits, "image_offset", "60").as_built, -0.07, 1e-12);
}

TEST(SetupLimits, ThatNobodyKnowsAreNotJudged) {
  for (const CertificateLimit& limit : judged(triangle_gloss())) {
    EXPECT_EQ(limit.verdict == not_applicable, !limit.limit.low && !limit.limit.high)
        << limit.clause;
    EXPECT_EQ(limit.note.empty(), limit.verdict != not_applicable) << limit.clause;
  }
}

TEST(VerdictOnASetup, IsInconclusiveWhereNoLimitCounts) {
  EXPECT_EQ(verdict_of({}), inconclusive);
  EXPECT_EQ(verdict_of({{.verdict = pass, .counts = false}}), inconclusive);
  EXPECT_EQ(verdict_of({{.verdict = pass, .counts = true}, {.verdict = fail, .counts = false}}),
            pass);
}

}  // namespace
}  // namespace gonio
