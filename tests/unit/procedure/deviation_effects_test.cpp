#include "emulator/procedure/deviation_effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/certification.hpp"

namespace gonio {
namespace {

using test::rungs;
using test::shipped_standard;
using test::triangle_gloss;

constexpr double tolerance = 1e-7;  // of the integrator, GU
constexpr double same = 1e-5;       // GU: two integrals by other paths
const std::vector<std::string> samples{"white_diffuser", "glass_m050", "paint_smooth",
                                       "aluminium_smooth"};

std::vector<DeviationEffect> effects_of(const Instrument& instrument, const std::string& geometry,
                                        const std::vector<Sample>& ladder) {
  const OpticalResponse optics(instrument, geometry, ladder, tolerance);
  return deviation_effects(instrument, instrument.standard.geometry(geometry), optics,
                           {.scale = instrument.standard.scale,
                            .theta_i = instrument.standard.geometry(geometry).theta_i.nominal,
                            .full_scale_gu = 1000.0});
}

const DeviationEffect& find(const std::vector<DeviationEffect>& effects,
                            const std::string& component) {
  for (const DeviationEffect& effect : effects) {
    if (effect.component == component) {
      return effect;
    }
  }
  throw std::out_of_range(component);
}

TEST(DeviationEffects, AreThoseOfTheLadderForAnglesAndOpenings) {
  const Instrument instrument = triangle_gloss();
  const auto ladder = rungs(samples);
  const auto effects = effects_of(instrument, "60", ladder);
  // setup_effects() reads with the instrument's nominal spectra, and one quantity off.
  for (const SetupEffects& expected : setup_effects(instrument, "60", ladder, tolerance)) {
    const DeviationEffect& effect =
        find(effects, setup_quantity_names[std::size_t(expected.quantity)]);
    EXPECT_NEAR(*effect.low, expected.low.degrees(), 1e-12);
    EXPECT_NEAR(*effect.as_built, expected.as_built.degrees(), 1e-12);
    for (std::size_t s = 0; s < ladder.size(); ++s) {
      EXPECT_NEAR(effect.as_built_gu[s], expected.rows[s].as_built_gu, same) << effect.component;
      EXPECT_NEAR(effect.low_gu[s], expected.rows[s].low_gu, same) << effect.component;
      EXPECT_NEAR(effect.high_gu[s], expected.rows[s].high_gu, same) << effect.component;
    }
  }
}

TEST(DeviationEffects, OfAnInstrumentWithoutAnyAreZero) {
  const Instrument instrument = nominal_instrument(shipped_standard("iso_2813/2014"));
  for (const DeviationEffect& effect : effects_of(instrument, "85", rungs(samples))) {
    EXPECT_THAT(effect.as_built_gu, testing::Each(testing::DoubleNear(0.0, same)))
        << effect.component;
  }
}

TEST(DeviationEffects, EndWithAllTogether) {
  const auto effects = effects_of(triangle_gloss(), "60", rungs(samples));
  EXPECT_EQ(effects.back().component, "all");
  for (std::size_t s = 0; s < samples.size(); ++s) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < effects.size(); ++i) {
      sum += effects[i].as_built_gu[s];
    }
    // Deviations are small, so that their products are smaller.
    EXPECT_NEAR(effects.back().as_built_gu[s], sum, 0.05 * std::abs(sum) + 0.02) << samples[s];
  }
}

TEST(DeviationEffects, OfATileThatLostGlossRaiseEveryReading) {
  const auto effects = effects_of(triangle_gloss("{behaviour: {tile: {contamination: 0.02}}}"),
                                  "60", rungs({"ideal_mirror"}));
  EXPECT_NEAR(find(effects, "tile_contamination").as_built_gu[0], 999.27 * (1.0 / 0.98 - 1.0),
              0.01);
}

TEST(DeviationEffects, OfSpectraAreNoneForGreySamples) {
  const auto effects =
      effects_of(triangle_gloss(), "60", rungs({"paint_smooth", "red_paint_m150"}));
  EXPECT_NEAR(find(effects, "spectrum").as_built_gu[0], 0.0, same);
  EXPECT_GT(std::abs(find(effects, "spectrum").as_built_gu[1]), 1e-3);
}

TEST(DeviationEffects, OfLinearityFollowItsFormula) {
  const auto effects = effects_of(triangle_gloss("{behaviour: {linearity: 0.001}}"), "60",
                                  rungs({"aluminium_smooth"}));
  const double g = 904.0;  // about; both it and the tile bend
  const auto bent = [](double x) { return x + 4.0 * 0.001 * x * (1.0 - x / 1000.0); };
  EXPECT_NEAR(find(effects, "linearity").as_built_gu[0], 100.0 * bent(g) / bent(100.0) - g, 0.1);
}

}  // namespace
}  // namespace gonio
