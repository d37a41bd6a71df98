#include "tests/conformance/closed_form.hpp"

#include <gtest/gtest.h>

#include "tests/unit/csv_rows.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio::conformance {
namespace {

constexpr double printed = 0.0006;  // of a table with three decimals

double gloss_of(const PolishedArtefact& artefact, double theta_deg) {
  return closed_form_gloss(artefact, degrees(theta_deg),
                           test::shipped_standard("iso_2813/2014").scale);
}

TEST(ClosedFormGloss, AgreesWithTheTableOfIndices) {
  int rows = 0;
  for (const auto& row :
       test::csv_rows(test::source_tree / "fixtures/reference/fresnel_gloss_vs_n.csv")) {
    for (const char* angle : {"20", "45", "60", "75", "85"}) {
      EXPECT_TRUE(test::is_close(gloss_of({.index = row.number("n")}, std::stod(angle)),
                                 row.number(std::string("GU") + angle), printed))
          << "n = " << row.number("n") << " at " << angle;
    }
    ++rows;
  }
  EXPECT_GT(rows, 40);
}

TEST(ClosedFormGloss, OfAnIdealMirrorIsTheUpperEndOfTheScale) {
  EXPECT_TRUE(test::is_close(gloss_of({.reflectance = 1.0}, 20), 2037.5686, 1e-4));
  EXPECT_TRUE(test::is_close(gloss_of({.reflectance = 1.0}, 60), 999.4400, 1e-4));
  EXPECT_TRUE(test::is_close(gloss_of({.reflectance = 1.0}, 85), 161.5122, 1e-4));
}

// Of a metal at normal incidence: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
TEST(ClosedFormGloss, OfAMetalIsFresnelsAtNormalIncidence) {
  const double n = 0.6, k = 2.6;
  const double metal = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
  const double glass = (0.567 * 0.567) / (2.567 * 2.567);
  EXPECT_TRUE(test::is_close(gloss_of({.index = {n, k}}, 0), 100 * metal / glass, 1e-9));
}

// ASTM C584 counts thousandths of the incident light: a glass of n = 1.567 reads 100.06 at 60 deg.
TEST(ClosedFormGloss, KnowsAScaleWithoutAReferenceGlass) {
  const Scale scale = test::shipped_standard("astm_c584/81").scale;
  EXPECT_TRUE(
      test::is_close(closed_form_gloss({.index = 1.567}, degrees(60), scale), 100.06, 0.005));
}

}  // namespace
}  // namespace gonio::conformance
