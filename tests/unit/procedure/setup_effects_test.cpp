#include "emulator/procedure/setup_effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::is_close_relative;
using test::shipped_standard;
using testing::ElementsAre;
using testing::SizeIs;

constexpr double tolerance_gu = 1e-6;
const WavelengthGrid few_wavelengths(nanometres(450), nanometres(100), 3);
const std::vector<std::string> geometries{"20", "60", "85"};

Instrument nominal() { return nominal_instrument(shipped_standard("iso_2813/2014")); }

/// A row of the ladder, with one quantity of the nominal instrument at its limits.
class Effects {
 public:
  explicit Effects(const Instrument& instrument = nominal()) {
    for (const std::string& geometry : geometries) {
      for (SetupEffects& effects :
           setup_effects(instrument, geometry, effect_ladder(few_wavelengths), tolerance_gu)) {
        effects_.push_back(std::move(effects));
      }
    }
  }

  [[nodiscard]] const SetupEffects& of(const std::string& geometry, SetupQuantity quantity) const {
    return *std::ranges::find_if(effects_, [&](const SetupEffects& effects) {
      return effects.geometry == geometry && effects.quantity == quantity;
    });
  }
  [[nodiscard]] const LadderRow& row(const std::string& geometry, SetupQuantity quantity,
                                     const std::string& sample) const {
    return *std::ranges::find(of(geometry, quantity).rows, sample, &LadderRow::sample);
  }

 private:
  std::vector<SetupEffects> effects_;
};

// What is expected is read for the nominal instrument, once for all tests.
const Effects& by_the_standard() {
  static const Effects effects;
  return effects;
}

TEST(EffectLadder, GrowsFromMattToMirror) {
  EXPECT_GE(effect_ladder(few_wavelengths).size(), 12u);
  const SetupEffects& effects = by_the_standard().of("60", SetupQuantity::theta_i);
  EXPECT_TRUE(std::ranges::is_sorted(effects.rows, std::less<>(), &LadderRow::nominal_gu));
  EXPECT_LT(effects.rows.front().nominal_gu, 3.0);
  EXPECT_GT(effects.rows.back().nominal_gu, 999.0);
}

TEST(SetupEffects, AreThoseOfAllQuantitiesThatTheStandardLimits) {
  const auto effects = setup_effects(nominal(), "60", effect_ladder(few_wavelengths), tolerance_gu);
  std::vector<SetupQuantity> quantities;
  for (const SetupEffects& one : effects) {
    quantities.push_back(one.quantity);
    EXPECT_EQ(one.geometry, "60");
    EXPECT_THAT(one.rows, SizeIs(effect_ladder(few_wavelengths).size()));
  }
  EXPECT_THAT(quantities,
              ElementsAre(SetupQuantity::theta_i, SetupQuantity::theta_r,
                          SetupQuantity::source_in_plane, SetupQuantity::source_perpendicular,
                          SetupQuantity::receptor_in_plane, SetupQuantity::receptor_perpendicular));
  EXPECT_TRUE(is_close(effects[0].low.degrees(), 59.9, 1e-9));
  EXPECT_TRUE(is_close(effects[0].nominal.degrees(), 60.0, 1e-9));
  EXPECT_TRUE(is_close(effects[0].high.degrees(), 60.1, 1e-9));
}

TEST(SetupEffects, AreNoneWithoutTolerances) {
  const test::TemporaryFolder folder;
  const Instrument without =
      nominal_instrument(load_standard(folder.file("house.yaml", test::user_standard())));
  EXPECT_THAT(setup_effects(without, "60", effect_ladder(few_wavelengths), 1e-3), SizeIs(0));
}

// Figures for a step of 0.1 deg of incidence, computed from Fresnel's formula: a smooth paint
// against the tile, and an ideal mirror for each 100 GU of its reading.
TEST(EffectOfIncidence, CancelsInSmoothPaintButForTheFiguresKnown) {
  constexpr double of_the_source = 1e-3;  // which Fresnel's formula is averaged over; and rounding
  const std::vector<double> known{0.001, 0.043, 0.025};
  for (std::size_t g = 0; g < geometries.size(); ++g) {
    const LadderRow& paint =
        by_the_standard().row(geometries[g], SetupQuantity::theta_i, "paint_smooth");
    EXPECT_TRUE(is_close(std::abs(paint.high_gu), known[g], of_the_source)) << geometries[g];
    EXPECT_TRUE(is_close(std::abs(paint.low_gu), known[g], of_the_source)) << geometries[g];
    const auto gloss = [&](double theta_deg) {
      const double cos_theta_i = std::cos(degrees(theta_deg).radians());
      return 100.0 * fresnel_reflectance(cos_theta_i, 1.5) /
             fresnel_reflectance(cos_theta_i, 1.567);
    };
    const double theta_deg = std::stod(geometries[g]);
    EXPECT_TRUE(is_close(paint.high_gu, gloss(theta_deg + 0.1) - gloss(theta_deg), 1e-4));
    EXPECT_TRUE(is_close(paint.low_gu, gloss(theta_deg - 0.1) - gloss(theta_deg), 1e-4));
  }
}

TEST(EffectOfIncidence, DoesNotCancelInAMirror) {
  constexpr double rounding_percent = 0.005;
  const std::vector<double> known_percent{0.012, 0.50, 0.92};
  for (std::size_t g = 0; g < geometries.size(); ++g) {
    const LadderRow& mirror =
        by_the_standard().row(geometries[g], SetupQuantity::theta_i, "ideal_mirror");
    EXPECT_TRUE(is_close(-100.0 * mirror.high_gu / mirror.nominal_gu, known_percent[g],
                         rounding_percent + 0.01 * known_percent[g]))
        << geometries[g];
  }
}

// A mirror's image stays within the receptor; smooth paint reads as it does.
TEST(EffectOfTheReceptor, IsNoneOnMirrors) {
  for (const std::string& geometry : geometries) {
    for (const auto quantity : {SetupQuantity::theta_r, SetupQuantity::receptor_in_plane,
                                SetupQuantity::receptor_perpendicular}) {
      for (const std::string sample : {"ideal_mirror", "aluminium_smooth", "paint_smooth"}) {
        const LadderRow& row = by_the_standard().row(geometry, quantity, sample);
        EXPECT_TRUE(is_close_relative(row.nominal_gu + row.low_gu, row.nominal_gu, 1e-12));
        EXPECT_TRUE(is_close_relative(row.nominal_gu + row.high_gu, row.nominal_gu, 1e-12));
      }
    }
  }
}

TEST(EffectOfTheReceptor, OnAWhiteDiffuserFollowsItsArea) {
  constexpr double of_first_order = 0.025;  // relative: tangents, and cosines at the edge
  struct Size {
    std::string geometry;
    SetupQuantity quantity;
    double nominal_deg, tolerance_deg;
  };
  for (const Size& size : {Size{"20", SetupQuantity::receptor_in_plane, 1.8, 0.05},
                           Size{"20", SetupQuantity::receptor_perpendicular, 3.6, 0.1},
                           Size{"60", SetupQuantity::receptor_in_plane, 4.4, 0.1},
                           Size{"60", SetupQuantity::receptor_perpendicular, 11.7, 0.2},
                           Size{"85", SetupQuantity::receptor_in_plane, 4.0, 0.3},
                           Size{"85", SetupQuantity::receptor_perpendicular, 6.0, 0.3}}) {
    const LadderRow& white = by_the_standard().row(size.geometry, size.quantity, "white_diffuser");
    const double share = size.tolerance_deg / size.nominal_deg;
    EXPECT_TRUE(is_close_relative(white.high_gu / white.nominal_gu, share, of_first_order));
    EXPECT_TRUE(is_close_relative(-white.low_gu / white.nominal_gu, share, of_first_order));
  }
}

// Figures published for both sizes at their limits together; the product of both effects is left
// out here.
TEST(EffectOfApertures, AddsUpToTheFiguresKnown) {
  constexpr double rounding_gu = 0.005;
  struct Known {
    std::string geometry, sample;
    SetupQuantity in_plane, perpendicular;
    double low_gu, nominal_gu, high_gu, product_gu;
  };
  const auto receptor = SetupQuantity::receptor_in_plane;
  const auto receptor_p = SetupQuantity::receptor_perpendicular;
  for (const Known& known :
       {Known{"60", "glass_m030", receptor, receptor_p, 62.20, 63.30, 64.38, 0.001},
        Known{"60", "glass_m050", receptor, receptor_p, 40.13, 41.02, 41.90, 0.001},
        Known{"60", "glass_m100", receptor, receptor_p, 17.57, 18.13, 18.68, 0.004},
        Known{"20", "glass_m020", SetupQuantity::source_in_plane,
              SetupQuantity::source_perpendicular, 30.66, 29.80, 28.77, 0.006}}) {
    const LadderRow& a = by_the_standard().row(known.geometry, known.in_plane, known.sample);
    const LadderRow& b = by_the_standard().row(known.geometry, known.perpendicular, known.sample);
    EXPECT_TRUE(is_close(a.nominal_gu, known.nominal_gu, rounding_gu)) << known.sample;
    EXPECT_TRUE(
        is_close(a.nominal_gu + a.low_gu + b.low_gu, known.low_gu, rounding_gu + known.product_gu))
        << known.sample;
    EXPECT_TRUE(is_close(a.nominal_gu + a.high_gu + b.high_gu, known.high_gu,
                         rounding_gu + known.product_gu))
        << known.sample;
  }
}

TEST(EffectOfIncidence, IsReadByAReceptorThatStaysWhereItIs) {
  const std::vector<Sample> ladder = effect_ladder(few_wavelengths);
  const Sample& glass = *std::ranges::find(ladder, std::string("glass_m020"), &Sample::id);
  const auto gloss = [&](double theta_r_deg) {
    Instrument off = with_quantity(nominal(), "20", SetupQuantity::theta_i, {degrees(20.1)});
    off = with_quantity(off, "20", SetupQuantity::theta_r, {degrees(theta_r_deg)});
    return Glossmeter(off, few_wavelengths, std::make_shared<ApertureIntegrator>())
        .read(glass.surface, "20", tolerance_gu)
        .gloss;
  };
  const LadderRow& row = by_the_standard().row("20", SetupQuantity::theta_i, "glass_m020");
  EXPECT_TRUE(is_close(row.nominal_gu + row.high_gu, gloss(20.0), 3 * tolerance_gu));
  EXPECT_GT(std::abs(row.nominal_gu + row.high_gu - gloss(20.1)), 0.03);
}

// As built.

TEST(EffectAsBuilt, IsZeroForTheNominalInstrument) {
  for (const SetupEffects& effects :
       setup_effects(nominal(), "85", effect_ladder(few_wavelengths), tolerance_gu)) {
    EXPECT_EQ(effects.as_built, effects.nominal);
    for (const LadderRow& row : effects.rows) {
      EXPECT_EQ(row.as_built_gu, 0.0);
    }
  }
}

TEST(EffectAsBuilt, IsOfOneQuantityWithAllOthersNominal) {
  Instrument off = with_quantity(nominal(), "60", SetupQuantity::theta_i, {degrees(60.1)});
  off = with_quantity(off, "60", SetupQuantity::receptor_in_plane, {degrees(4.3)});
  const Effects built(off);
  for (const LadderRow& row : built.of("60", SetupQuantity::theta_i).rows) {
    const LadderRow& expected = by_the_standard().row("60", SetupQuantity::theta_i, row.sample);
    EXPECT_EQ(row.nominal_gu, expected.nominal_gu);
    EXPECT_TRUE(is_close(row.as_built_gu, expected.high_gu, 2 * tolerance_gu));
  }
  for (const LadderRow& row : built.of("60", SetupQuantity::receptor_in_plane).rows) {
    EXPECT_TRUE(
        is_close(row.as_built_gu,
                 by_the_standard().row("60", SetupQuantity::receptor_in_plane, row.sample).low_gu,
                 2 * tolerance_gu));
  }
}

TEST(EffectAsBuilt, IsZeroForSidesOfACircle) {
  Instrument round = nominal();
  round.as_built["60"].receptor.diameter = AngleAsBuilt{degrees(4.7)};
  const Effects effects(round);
  for (const LadderRow& row : effects.of("60", SetupQuantity::receptor_in_plane).rows) {
    EXPECT_EQ(row.as_built_gu, 0.0);
  }
}

TEST(SetupEffects, OfAnOpeningThatTheStandardLeavesUnknownAreThoseAsBuilt) {
  Instrument paper = nominal_instrument(shipped_standard("tappi_t480/om_15"));
  for (GeometryLimits& limits : paper.standard.geometries) {
    limits.theta_i.tolerance = degrees(0.1);
  }
  const std::vector<Sample> ladder = effect_ladder(few_wavelengths);
  EXPECT_THROW((void)setup_effects(paper, "75", ladder, tolerance_gu), InputError);
  paper.as_built["75"].receptor.diameter = AngleAsBuilt{degrees(5)};
  paper.as_built["75"].source.diameter = AngleAsBuilt{degrees(1)};
  const auto effects = setup_effects(paper, "75", ladder, 1e-3);
  ASSERT_THAT(effects, SizeIs(1));
  EXPECT_EQ(effects.front().quantity, SetupQuantity::theta_i);
  EXPECT_NE(effects.front().rows.back().high_gu, 0.0);
}

}  // namespace
}  // namespace gonio
