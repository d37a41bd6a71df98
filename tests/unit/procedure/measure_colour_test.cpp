#include "emulator/procedure/measure_colour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/csv_rows.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/laboratory.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::message_of;
using test::shipped;
using test::shipped_sample;
using test::shipped_standard;

/// A shipped instrument, and what its colours are computed for.
struct Bench {
  ColourConditions conditions;
  Colorimeter colorimeter;
};

Bench bench(const std::string& instrument, const std::string& illuminant,
            const std::string& observer, const WavelengthGrid& grid = test::visible) {
  const ColourConditions conditions = load_colour_conditions(shipped(), illuminant, observer, grid);
  return {.conditions = conditions,
          .colorimeter = {
              load_instrument(shipped().find(Catalog::Kind::instrument, instrument), shipped()),
              grid, std::make_shared<ApertureIntegrator>(), conditions.luminous_weight()}};
}

ColourMeasurement measured(const std::string& sample, const Bench& with,
                           const ColourOptions& options = {}) {
  return measure_colour(shipped_sample(sample), with.colorimeter, with.conditions, options);
}

Lab lab_of(const ColourMeasurement& measurement) { return measurement.geometries.front().lab; }

// Average spectra of 30 charts, and their colours as computed by another program: steps of 1 nm,
// the last value held beyond 730 nm.
class ColorCheckerPatches : public testing::TestWithParam<std::string> {};

TEST_P(ColorCheckerPatches, HaveTheirPublishedColoursInTheColorimeter) {
  constexpr double decimals = 1e-4;  // four of them, half a unit and as much of the integrator
  const std::string& illuminant = GetParam();
  const std::string suffix = illuminant == "d65" ? "_D65" : "_D50";
  const auto file = [](const char* name) { return shipped().fixture(name); };
  const WavelengthGrid grid(nanometres(380), nanometres(1), 401);
  const Bench with = bench("colorimeter_45_0", illuminant, "2", grid);
  for (const auto& row : test::csv_rows(file("colour/colorchecker_babelcolor_lab_computed.csv"))) {
    const std::string patch = row.text("patch");
    const SpectralTable table =
        SpectralTable::load(file("colour/colorchecker_babelcolor_average_10nm.csv"), patch);
    Eigen::ArrayXd reflectance(grid.size());
    for (Eigen::Index l = 0; l < grid.size(); ++l) {
      reflectance(l) = table.at(nanometres(std::min(grid.nanometres()(l), 730.0)));
    }
    const Sample sample{.file = {}, .id = patch, .surface = lambertian(grid, reflectance)};
    const Lab lab = lab_of(measure_colour(sample, with.colorimeter, with.conditions));
    EXPECT_TRUE(is_close(lab.L, row.number("L" + suffix), decimals)) << patch;
    EXPECT_TRUE(is_close(lab.a, row.number("a" + suffix), decimals)) << patch;
    EXPECT_TRUE(is_close(lab.b, row.number("b" + suffix), decimals)) << patch;
  }
}

INSTANTIATE_TEST_SUITE_P(Illuminants, ColorCheckerPatches, testing::Values("d65", "d50"));

TEST(MeasureColour, FindsTheIdealDiffuserWhiteForEachLightAndEye) {
  constexpr double rounding = 1e-6;
  for (const std::string& illuminant : colour_illuminants()) {
    for (const std::string& observer : colour_observers()) {
      const Lab lab =
          lab_of(measured("white_diffuser", bench("colorimeter_45_0", illuminant, observer)));
      EXPECT_NEAR(lab.L, 100.0, rounding) << illuminant << " " << observer;
      EXPECT_NEAR(lab.a, 0.0, rounding) << illuminant << " " << observer;
      EXPECT_NEAR(lab.b, 0.0, rounding) << illuminant << " " << observer;
    }
  }
}

TEST(MeasureColour, OfAColourDependsOnTheLightAndTheEye) {
  const auto b_of = [](const std::string& illuminant, const std::string& observer) {
    return lab_of(measured("red_satin", bench("colorimeter_45_0", illuminant, observer))).b;
  };
  EXPECT_GT(std::abs(b_of("d65", "10") - b_of("a", "10")), 1.0);
  EXPECT_GT(std::abs(b_of("d65", "10") - b_of("d65", "2")), 0.1);
}

TEST(MeasureColour, FindsAMirrorBlackAt45And0) {
  const ColourMeasurement mirror =
      measured("perfect_mirror", bench("colorimeter_45_0", "d65", "10"));
  EXPECT_EQ(mirror.geometries.front().xyz.Y, 0.0);
  EXPECT_EQ(mirror.geometries.front().lab.L, 0.0);
  EXPECT_FALSE(mirror.geometries.front().xy);
}

TEST(MeasureColour, OfAGlossPaintIsLighterWithTheSpecularPart) {
  const ColourMeasurement paint =
      measured("white_high_gloss_enamel", bench("sphere_8_d", "d65", "10"));
  EXPECT_EQ(paint.geometries[0].id, "8_di");
  EXPECT_GT(paint.geometries[0].lab.L, paint.geometries[1].lab.L + 1.0);
  EXPECT_FALSE(paint.geometries[0].aspecular);
  EXPECT_FALSE(paint.flop);
}

TEST(MeasureColour, RefusesAGeometryThatTheInstrumentDoesNotHave) {
  const Bench with = bench("colorimeter_45_0", "d65", "10");
  EXPECT_EQ(message_of([&] { (void)measured("red_satin", with, {.geometries = {"8_di"}}); }),
            "colorimeter_45_0 has the geometries 45_0, not '8_di'");
}

// The flop index.

TEST(FlopIndex, IsZeroOfALambertianSample) {
  const ColourMeasurement white = measured("white_diffuser", bench("multi_angle_45", "d65", "10"));
  ASSERT_TRUE(white.flop);
  EXPECT_EQ(white.flop->value, 0.0);
  EXPECT_TRUE(white.flop->evidence.is_informative());
}

TEST(FlopIndex, IsTheFormula) {
  constexpr double rounding = 1e-12;
  const FlopRule rule = *shipped_standard("din_6175_2/2001").flop;
  const auto flop = flop_index(rule, {{"45_as15", 120.0}, {"45_as45", 50.0}, {"45_as110", 25.0}});
  ASSERT_TRUE(flop);
  EXPECT_TRUE(is_close(*flop, 2.69 * std::pow(95.0, 1.11) / std::pow(50.0, 0.86), rounding));
}

TEST(FlopIndex, IsNotDefinedWithoutAGeometryOfBlackAndOfWhatGetsLighter) {
  const FlopRule rule = *shipped_standard("din_6175_2/2001").flop;
  EXPECT_FALSE(flop_index(rule, {{"45_as15", 120.0}, {"45_as45", 50.0}}));
  EXPECT_FALSE(flop_index(rule, {{"45_as15", 120.0}, {"45_as45", 0.0}, {"45_as110", 25.0}}));
  EXPECT_FALSE(flop_index(rule, {{"45_as15", 20.0}, {"45_as45", 20.0}, {"45_as110", 25.0}}));
}

TEST(FlopIndex, OfAnEffectPaintIsLargerThanOfAWallPaint) {
  const Bench with = bench("multi_angle_45", "d65", "10");
  const auto flop = [&](const std::string& id) { return *measured(id, with).flop->value; };
  EXPECT_GT(flop("silver_effect_paint"), 5.0);
  EXPECT_LT(flop("white_matt_wall_paint"), 0.1);
}

TEST(MeasureColours, AreThoseOfSingleSamplesInTheirOrder) {
  const Bench with = bench("colorimeter_45_0", "d65", "10");
  int advanced = 0;
  const auto all = measure_colours({shipped_sample("red_satin"), shipped_sample("black_matt")},
                                   with.colorimeter, with.conditions, {}, [&] { ++advanced; });
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(advanced, 2);
  EXPECT_EQ(all[0].sample, "red_satin");
  EXPECT_EQ(lab_of(all[1]).L, lab_of(measured("black_matt", with)).L);
}

}  // namespace
}  // namespace gonio
