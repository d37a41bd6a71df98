#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/unit/reports/hostile_certificate.hpp"

namespace gonio {
namespace {

using nlohmann::json;

json json_of(const Certificate& certificate) {
  return json::parse(certificate_json(test::report_of(certificate)));
}

TEST(CertificateJson, HasTheKeysThatItsSchemaPromises) {
  const json written = json_of(test::example_certificate());
  EXPECT_EQ(written.at("schema"), "gonio/certificate/1");
  EXPECT_EQ(written.at("verdict"), "fail");
  const json& limit = written.at("limits").at(6);
  EXPECT_EQ(limit.at("clause"), "geometry/theta_i_60");
  EXPECT_EQ(limit.at("geometry"), "60");
  EXPECT_EQ(limit.at("quantity"), "theta_i");
  EXPECT_EQ(limit.at("nominal"), 60.0);
  EXPECT_EQ(limit.at("tolerance"), 0.1);
  EXPECT_EQ(limit.at("as_built"), 60.04);
  EXPECT_EQ(limit.at("verdict"), "pass");
  const json& sample = written.at("samples").at(12);
  EXPECT_EQ(sample.at("id"), "sample_1");
  EXPECT_EQ(sample.at("geometry"), "60");
  for (const char* key : {"gloss_gu", "u_gu", "U_gu", "k"}) {
    EXPECT_TRUE(sample.at(key).is_number()) << key;
  }
  for (const char* key : {"u", "sensitivity", "contribution_gu", "share"}) {
    EXPECT_TRUE(sample.at("budget").at(0).at(key).is_number()) << key;
  }
}

TEST(CertificateJson, HasEverySampleAtEveryGeometryWithTheInputsOfBoth) {
  const json written = json_of(test::example_certificate());
  EXPECT_EQ(written.at("samples").size(), 24u);
  const json& budget = written.at("samples").at(23).at("budget");
  EXPECT_EQ(budget.size(), 13u);
  for (const json& line : budget) {
    EXPECT_TRUE(line.at("input") == "reference_index" ||
                line.at("input").get<std::string>().starts_with("60/"))
        << line;
  }
}

TEST(CertificateJson, HasNumbersAtFullPrecision) {
  Certificate certificate = test::example_certificate();
  const double value = 54.100000000000001;
  certificate.geometries.front().readings.front().gloss_gu = value;
  EXPECT_EQ(json_of(certificate).at("samples").at(0).at("gloss_gu"), value);
}

TEST(CertificateJson, IsNullForWhatIsNoNumberOrNotThere) {
  Certificate certificate = test::example_certificate();
  certificate.limits.front().as_built.reset();
  certificate.geometries.front().readings.front().propagated.degrees_of_freedom =
      std::numeric_limits<double>::infinity();
  certificate.geometries.front().surrogate_error_gu.clear();
  const json written = json_of(certificate);
  EXPECT_TRUE(written.at("limits").at(0).at("as_built").is_null());
  EXPECT_TRUE(written.at("samples").at(0).at("degrees_of_freedom").is_null());
  EXPECT_TRUE(written.at("samples").at(0).at("surrogate_error_gu").is_null());
}

TEST(CertificateJson, NamesTheCornerOfAWorstCase) {
  const json worst = json_of(test::example_certificate()).at("samples").at(12).at("worst_case");
  EXPECT_EQ(worst.at("highest").at("setup_deg").at("theta_i"), 60.1);
}

TEST(CertificateJson, KeepsHostileTextAsText) {
  const std::string text = "a\"\\\n`b` \xFF";
  const Certificate certificate = test::hostile_certificate(text);
  const json written = json::parse(certificate_json(test::hostile_report_of(certificate, text)));
  EXPECT_EQ(written.at("laboratory").at("name"), "a\"\\\n`b` \uFFFD");
  EXPECT_EQ(written.at("samples").at(0).at("id"), "a\"\\\n`b` \uFFFD");
}

}  // namespace
}  // namespace gonio
