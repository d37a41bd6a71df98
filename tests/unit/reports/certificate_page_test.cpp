#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <regex>
#include <string>
#include <system_error>

#include "emulator/core/text_file.hpp"
#include "emulator/instrument/uncertainty_statement.hpp"
#include "reports/certificate_words.hpp"
#include "reports/templates.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"
#include "tests/unit/reports/hostile_certificate.hpp"

// How it looks and prints is seen by a browser in tests/pages.

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string page_of(const Certificate& certificate) {
  return certificate_page(test::report_of(certificate));
}

std::string hostile_page(const std::string& text) {
  const Certificate certificate = test::hostile_certificate(text);
  return certificate_page(test::hostile_report_of(certificate, text));
}

TEST(CertificatePage, OpensWithWhatItIsAndThatNoAccreditationIsClaimed) {
  const std::string page = page_of(test::example_certificate());
  const auto title = page.find("<h1>Calibration certificate</h1>");
  const auto mark = page.find("no accreditation is claimed");
  const auto table = page.find("<table");
  EXPECT_LT(title, mark);
  EXPECT_LT(mark, table);
  EXPECT_NE(table, std::string::npos);
}

TEST(CertificatePage, HasWhatTheLaboratoryStates) {
  const std::string page = page_of(test::example_certificate());
  for (const char* text :
       {"EGL-2026-0042", "Example Gloss Laboratory", "Example Paints", "2026-01-12", "2026-01-15",
        "23 degC \u00B1 1 degC", "Black glass wedge; Ray table", "EGL-P-07", "A. N. Example"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

TEST(CertificatePage, SaysWhatTheLaboratoryDidNotState) {
  const Certificate certificate = test::example_certificate();
  const std::string page = certificate_page({.certificate = certificate, .date = "2026-01-31"});
  EXPECT_THAT(page, HasSubstr("<dt>Certificate number</dt><dd>not stated</dd>"));
  EXPECT_THAT(page, HasSubstr("<dt>Traceability</dt><dd>not stated</dd>"));
  EXPECT_THAT(page, HasSubstr("<dt>Issued</dt><dd>2026-01-31</dd>"));
}

TEST(CertificatePage, NumbersItsSheetsBesideTheNumberOfTheCertificate) {
  const std::string page = page_of(test::example_certificate());
  EXPECT_THAT(page, HasSubstr("\"page \" counter(page) \" of \" counter(pages)"));
  EXPECT_THAT(page, HasSubstr("Calibration certificate EGL\\00002D 2026\\00002D 0042"));
}

TEST(CertificatePage, HasNoDateOfRecalibration) {
  EXPECT_THAT(page_of(test::example_certificate()),
              HasSubstr("recommends no date of recalibration"));
}

TEST(CertificatePage, HoldsHostileTextAsText) {
  const std::string page = hostile_page(test::hostile_text("trace"));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(page, HasSubstr("{{title}} {{{svg}}}"));
  EXPECT_THAT(page, Not(HasSubstr("\x1B")));
}

TEST(CertificatePage, LetsNoTextOutOfItsStyle) {
  const std::string page = hostile_page("\"; } </style><b> \\");
  const std::string style = page.substr(0, page.find("</style>"));
  EXPECT_THAT(style, HasSubstr("\\000022 \\00003B  \\00007D  \\00003C \\00002F style"));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
}

TEST(CertificatePage, LetsNobodyRunHostileText) {
  const test::TemporaryFolder folder;
  const auto trace = folder.path() / "trace";
  (void)hostile_page(test::hostile_text(trace));
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST(CertificatePage, TellsGnuplotNothingButNumbers) {
  const test::FakeGnuplot recorder("cat >> $here/scripts; echo '<svg></svg>'");
  (void)hostile_page("hostileword");
  const std::string scripts = read_text_file(recorder.folder() / "scripts");
  EXPECT_THAT(scripts, HasSubstr("$shares << END_OF_NUMBERS\n"));
  EXPECT_THAT(scripts, Not(HasSubstr("hostileword")));
}

TEST(CertificatePage, IsThereWithoutGeometriesAndWithoutLimits) {
  Certificate certificate = test::example_certificate();
  certificate.geometries.clear();
  certificate.limits.clear();
  certificate.inputs.clear();
  certificate.estimates.clear();
  const std::string page = page_of(certificate);
  EXPECT_THAT(page, HasSubstr("</html>"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
}

TEST(CertificatePage, DrawsWhatItCanOfNumbersThatAreNone) {
  Certificate certificate = test::example_certificate();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (GeometryCertificate& geometry : certificate.geometries) {
    for (CertifiedReading& reading : geometry.readings) {
      reading.gloss_gu = reading.propagated.expanded_uncertainty = nan;
      reading.lowest.change_gu = reading.highest.change_gu = nan;
      for (Contribution& part : reading.propagated.budget) {
        part.share = part.sensitivity = part.contribution = nan;
      }
    }
    for (DeviationEffect& effect : geometry.effects) {
      effect.as_built = effect.low = effect.high = nan;
      effect.as_built_gu.clear();
    }
  }
  EXPECT_THAT(page_of(certificate), HasSubstr("</html>"));
}

TEST(CertificatePage, IsAnErrorOfTheEnvironmentWithoutGnuplot) {
  const test::TemporaryFolder nothing;
  const test::SearchPath path(nothing.path().string());
  EXPECT_THROW((void)page_of(test::example_certificate()), std::system_error);
}

TEST(BudgetChart, NamesComponentsAsTheRestOfTheCertificateDoes) {
  const std::string script(template_text("budget.gnuplot"));
  std::size_t at = script.find("array name");
  for (const auto* names = setup_quantity_names.begin(); names != setup_quantity_names.end();
       ++names) {
    at = script.find("\"" + component_words(*names) + "\"", at);
    ASSERT_NE(at, std::string::npos) << *names;
  }
  for (const char* name : uncertainty_component_names) {
    at = script.find("\"" + component_words(name) + "\"", at);
    ASSERT_NE(at, std::string::npos) << name;
  }
}

}  // namespace
}  // namespace gonio
