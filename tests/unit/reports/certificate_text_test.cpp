#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/reports/hostile_certificate.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string text_of(const Certificate& certificate) {
  return certificate_text(test::report_of(certificate), false);
}

TEST(CertificateText, OpensWithTheVerdictAndWhatItRestsOn) {
  EXPECT_THAT(text_of(test::example_certificate()),
              StartsWith("fail: At least one limit that counts is not met: theta_r at 60.\n"
                         "The transcription of this standard is partial: no claim of conformity "
                         "may be made.\n"));
}

TEST(CertificateText, SaysThatNobodyMeasuredTheInstrument) {
  EXPECT_THAT(text_of(test::example_certificate()), HasSubstr("no accreditation is claimed"));
}

TEST(CertificateText, ShowsTwoBudgetsOfEachGeometryUnlessAllAreAskedFor) {
  const Certificate certificate = test::example_certificate();
  const auto budgets = [](const std::string& text) {
    std::size_t count = 0;
    for (auto at = text.find(": budget of"); at != std::string::npos;
         at = text.find(": budget of", at + 1)) {
      ++count;
    }
    return count;
  };
  CertificateReport report = test::report_of(certificate);
  EXPECT_EQ(budgets(certificate_text(report, false)), 4u);
  report.budgets = Budgets::all;
  EXPECT_EQ(budgets(certificate_text(report, false)), 24u);
}

TEST(CertificateText, HasEscapesOnlyWhereItIsStyled) {
  const std::string hostile = test::hostile_text("trace");
  const Certificate certificate = test::hostile_certificate(hostile);
  const CertificateReport report = test::hostile_report_of(certificate, hostile);
  EXPECT_THAT(certificate_text(report, false), Not(HasSubstr("\033")));
  EXPECT_THAT(certificate_text(report, true), HasSubstr("\033[1mfail\033[0m"));
  EXPECT_THAT(certificate_text(report, true), Not(HasSubstr("\033[31m")));
}

TEST(CertificateText, IsThereWithoutGeometries) {
  Certificate certificate = test::example_certificate();
  certificate.geometries.clear();
  certificate.limits.clear();
  certificate.verdict = ConformanceVerdict::not_applicable;
  EXPECT_THAT(text_of(certificate),
              StartsWith("not applicable: No limit that counts could be judged."));
}

}  // namespace
}  // namespace gonio
