#include "reports/certificate_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/certificate_budget.hpp"
#include "tests/unit/reports/example_certificate.hpp"

namespace gonio {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

TEST(CertificateMeaning, NamesTheLimitsThatCountAlone) {
  Certificate certificate = test::example_certificate();
  certificate.limits[2].verdict = ConformanceVerdict::fail;  // known from memory
  EXPECT_EQ(certificate_meaning(certificate),
            "At least one limit that counts is not met: theta_r at 60.");
  certificate.verdict = ConformanceVerdict::inconclusive;
  EXPECT_EQ(certificate_meaning(certificate),
            "At a limit, the uncertainty is too large to tell: receptor_in_plane at 60.");
  certificate.verdict = ConformanceVerdict::pass;
  EXPECT_EQ(certificate_meaning(certificate),
            "Every limit that counts is met by the set-up as stated.");
}

TEST(CertificateMeaning, BlamesNoUncertaintyWhereNothingCouldBeJudged) {
  Certificate certificate = test::example_certificate();
  certificate.verdict = ConformanceVerdict::inconclusive;
  for (CertificateLimit& limit : certificate.limits) {
    limit.verdict = ConformanceVerdict::not_applicable;
  }
  EXPECT_EQ(certificate_meaning(certificate), "No limit that counts could be judged.");
}

TEST(CertificateWarnings, TellWhereBothMethodsDoNotAgree) {
  Certificate certificate = test::example_certificate();
  EXPECT_THAT(certificate_warnings(certificate),
              Contains(HasSubstr("do not agree on sample_8 at 60")));
  certificate.geometries.back().readings[7].methods_agree = true;
  EXPECT_THAT(certificate_warnings(certificate), Each(Not(HasSubstr("do not agree"))));
}

TEST(CertificateWarnings, TellOfMonteCarloThatIsNotStable) {
  Certificate certificate = test::example_certificate();
  EXPECT_THAT(certificate_warnings(certificate), Each(Not(HasSubstr("not stable"))));
  certificate.is_stable = false;
  EXPECT_THAT(certificate_warnings(certificate), Contains(HasSubstr("not stable")));
}

TEST(CertificateWarnings, TellOfASurrogateThatErrsUnlessTheSampleWasReadWithoutIt) {
  Certificate certificate = test::example_certificate();
  certificate.geometries.front().surrogate_error_gu[3] = 0.02;
  EXPECT_THAT(certificate_warnings(certificate), Contains(HasSubstr("errs by 0.020 GU")));
  certificate.geometries.front().direct_samples = {3};
  EXPECT_THAT(certificate_warnings(certificate), Each(Not(HasSubstr("errs by"))));
}

TEST(CertificateWarnings, TellOfReadingsThatNoSetUpExplains) {
  Certificate certificate = test::example_certificate();
  certificate.estimates.front().p_value = 1e-6;
  EXPECT_THAT(certificate_warnings(certificate), Contains(HasSubstr("no set-up near")));
  certificate.estimates.front().has_converged = false;
  EXPECT_THAT(certificate_warnings(certificate), Contains(HasSubstr("came to no end")));
}

TEST(DecisionWords, NameAGuardBandThatIsNotU) {
  Certificate certificate = test::example_certificate();
  EXPECT_THAT(decision_words(certificate), Not(HasSubstr("guard band is")));
  certificate.guard_band_factor = 0.83;
  EXPECT_THAT(decision_words(certificate), HasSubstr("the guard band is 0.83 U"));
  certificate.decision_rule = DecisionRule::simple;
  EXPECT_THAT(decision_words(certificate), Not(HasSubstr("guard band is")));
}

TEST(ConfusionWords, NameTheParametersThatMatter) {
  const Certificate certificate = test::example_certificate();
  const SetupEstimate& estimate = certificate.estimates.front();
  EXPECT_EQ(confusion_words(estimate, estimate.confusions.front()),
            "The readings do not tell apart receptor_in_plane (+0.72), receptor_perpendicular "
            "(+0.69): 97 % of the uncertainty of this combination is left.");
  EXPECT_EQ(confusion_words(estimate, {.direction = {0.0, 0.0, 0.0, 1.0}, .remaining = 0.5}),
            "The readings leave 50 % of the uncertainty of zero.");
}

TEST(ShownBudgets, AreOfTheLargestUncertaintyAndOfTheSampleMostLikeTheReference) {
  const Certificate certificate = test::example_certificate();
  const auto shown = shown_budgets(test::report_of(certificate), certificate.geometries.front());
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown.front().sample, 10u);  // of 77 GU; its neighbour has 128
  EXPECT_EQ(shown.back().sample, 11u);
}

TEST(MainBudgetLines, LeaveOutWhatContributesNothing) {
  const Certificate certificate = test::example_certificate();
  const GeometryCertificate& geometry = certificate.geometries.front();
  const auto all = budget_lines(certificate, geometry, geometry.readings.back());
  const auto main = main_budget_lines(certificate, geometry, geometry.readings.back());
  EXPECT_EQ(all.size(), 13u);
  EXPECT_EQ(main.size(), 7u);
  for (std::size_t i = 1; i < main.size(); ++i) {
    EXPECT_GE(main[i - 1].contribution->share, main[i].contribution->share);
  }
}

}  // namespace
}  // namespace gonio
