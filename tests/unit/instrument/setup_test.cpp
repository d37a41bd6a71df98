#include "emulator/instrument/setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/unit/instrument/instrument_file.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::error_of;
using test::instrument_text;
using test::load_text;
using test::message_of;
using test::shipped;
using test::shipped_standard;
using test::TemporaryFolder;
using enum SetupQuantity;

std::optional<StatedAngle> stated(double value_deg, double uncertainty_deg) {
  return StatedAngle{.value = degrees(value_deg), .expanded_uncertainty = degrees(uncertainty_deg)};
}

SetupQuantity quantity_at(std::size_t i) { return SetupQuantity(i); }

// As built.

TEST(SetupAsBuilt, IsNominalWhereTheFileDoesNotSay) {
  const Instrument nominal = nominal_instrument(shipped_standard("iso_2813/2014"));
  EXPECT_EQ(as_built(nominal, "20", theta_i), stated(20.0, 0.0));
  EXPECT_EQ(as_built(nominal, "20", theta_r), stated(20.0, 0.0));
  EXPECT_EQ(as_built(nominal, "20", source_in_plane), stated(0.75, 0.0));
  EXPECT_EQ(as_built(nominal, "20", source_perpendicular), stated(2.5, 0.0));
  EXPECT_EQ(as_built(nominal, "20", receptor_in_plane), stated(1.8, 0.0));
  EXPECT_EQ(as_built(nominal, "20", receptor_perpendicular), stated(3.6, 0.0));
}

TEST(SetupAsBuilt, HasTheMirrorDirectionWhereTheStandardStatesNoReceptorAxis) {
  Standard standard = shipped_standard("iso_2813/2014");
  standard.geometries[1].theta_r.reset();
  EXPECT_EQ(as_built(nominal_instrument(standard), "60", theta_r), stated(60.0, 0.0));
}

TEST(SetupAsBuilt, IsWhatTheFileSaysWithItsUncertainty) {
  const Instrument instrument = load_text(instrument_text(
      "as_built:\n"
      "  \"60\":\n"
      "    theta_i: {value: 60.04 deg, expanded_uncertainty: 0.02 deg}\n"
      "    theta_r: 59.97 deg\n"
      "    source: {in_plane: {value: 0.8 deg, expanded_uncertainty: 0 deg}}\n"
      "    receptor: {diameter: {value: 4.5 deg, expanded_uncertainty: 0.05 deg}}\n"));
  EXPECT_EQ(as_built(instrument, "60", theta_i), stated(60.04, 0.02));
  EXPECT_EQ(as_built(instrument, "60", theta_r), stated(59.97, 0.0));
  EXPECT_EQ(as_built(instrument, "60", source_in_plane), stated(0.8, 0.0));
  EXPECT_EQ(as_built(instrument, "60", receptor_diameter), stated(4.5, 0.05));
}

TEST(SetupAsBuilt, TakesTheCommonUncertaintyWhereNoneIsStatedWithAValue) {
  const Instrument instrument = load_text(
      instrument_text("setup_uncertainty: {angles: 0.01 deg, apertures: 0.03 deg}\n"
                      "as_built:\n"
                      "  \"60\":\n"
                      "    theta_i: {value: 60.04 deg, expanded_uncertainty: 0.02 deg}\n"
                      "    theta_r: 59.97 deg\n"
                      "    source: {in_plane: {value: 0.8 deg, expanded_uncertainty: 0 deg}}\n"
                      "    receptor: {in_plane: 4.43 deg}\n"));
  EXPECT_EQ(as_built(instrument, "60", theta_i), stated(60.04, 0.02));
  EXPECT_EQ(as_built(instrument, "60", theta_r), stated(59.97, 0.01));
  EXPECT_EQ(as_built(instrument, "60", source_in_plane), stated(0.8, 0.0));
  EXPECT_EQ(as_built(instrument, "60", receptor_in_plane), stated(4.43, 0.03));
  // Nobody has measured these.
  EXPECT_EQ(as_built(instrument, "60", receptor_perpendicular), stated(11.7, 0.0));
  EXPECT_EQ(as_built(instrument, "20", theta_i), stated(20.0, 0.0));
}

TEST(SetupUncertainty, IsNothingWhereNobodyStatesIt) {
  const Instrument some = load_text(
      instrument_text("setup_uncertainty: {angles: 0.01 deg}\n"
                      "as_built:\n"
                      "  \"60\":\n"
                      "    theta_i: {value: 60.04 deg, expanded_uncertainty: 0 deg}\n"
                      "    theta_r: 59.97 deg\n"
                      "    source: {in_plane: {value: 0.8 deg, expanded_uncertainty: 0.02 deg}}\n"
                      "    receptor: {in_plane: 4.43 deg}\n"));
  EXPECT_EQ(stated_uncertainty(some, "60", theta_i), degrees(0.0));
  EXPECT_EQ(stated_uncertainty(some, "60", theta_r), degrees(0.01));
  EXPECT_EQ(stated_uncertainty(some, "20", theta_i), degrees(0.01));  // nominal for lack of another
  EXPECT_EQ(stated_uncertainty(some, "60", source_in_plane), degrees(0.02));
  EXPECT_EQ(stated_uncertainty(some, "60", receptor_in_plane), std::nullopt);
  EXPECT_EQ(as_built(some, "60", receptor_in_plane), stated(4.43, 0.0));
}

TEST(SetupAsBuilt, OfACircleHasADiameterAndNoSides) {
  const Instrument built =
      load_text(instrument_text("as_built:\n  \"20\": {receptor: {diameter: 4.7 deg}}\n"));
  EXPECT_EQ(as_built(built, "20", receptor_diameter), stated(4.7, 0.0));
  EXPECT_EQ(as_built(built, "20", receptor_in_plane), std::nullopt);
  EXPECT_EQ(as_built(built, "20", receptor_perpendicular), std::nullopt);
  EXPECT_EQ(as_built(built, "20", source_diameter), std::nullopt);
  EXPECT_EQ(as_built(built, "20", source_in_plane), stated(0.75, 0.0));
}

TEST(SetupAsBuilt, OfARectangleWhereTheStandardHasACircleHasSides) {
  const Instrument built =
      load_text(instrument_text("as_built:\n"
                                "  \"20\": {receptor: {in_plane: 4 deg, perpendicular: 4.2 deg}}\n",
                                "tappi_t653/om_07"));
  EXPECT_EQ(as_built(built, "20", receptor_in_plane), stated(4.0, 0.0));
  EXPECT_EQ(as_built(built, "20", receptor_perpendicular), stated(4.2, 0.0));
  EXPECT_EQ(as_built(built, "20", receptor_diameter), std::nullopt);
}

TEST(SetupAsBuilt, IsNothingWhereTheNumberIsUnknown) {
  const Instrument paper = nominal_instrument(shipped_standard("tappi_t480/om_15"));
  EXPECT_EQ(as_built(paper, "75", source_in_plane), std::nullopt);
  EXPECT_EQ(as_built(paper, "75", theta_i), stated(75.0, 0.0));
}

TEST(SetupAsBuilt, IsNothingInAGeometryThatTheInstrumentDoesNotHave) {
  const Instrument pocket =
      load_instrument(shipped().find(Catalog::Kind::instrument, "pocket_gloss_60"), shipped());
  EXPECT_EQ(as_built(pocket, "60", theta_i), stated(60.0, 0.0));
  EXPECT_EQ(as_built(pocket, "20", theta_i), std::nullopt);
  EXPECT_EQ(as_built(pocket, "45", theta_i), std::nullopt);
}

TEST(ShippedTriangleGloss, LiesWithinTheLimitsByMoreThanItsUncertainty) {
  const Instrument triangle =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  int judged = 0;
  for (const std::string& id : triangle.geometries) {
    for (std::size_t i = 0; i < setup_quantity_count; ++i) {
      const auto found = as_built(triangle, id, quantity_at(i));
      const Stated<Angle>* limit = limit_of(triangle.standard.geometry(id), quantity_at(i));
      ASSERT_EQ(found.has_value(), limit != nullptr) << id << ' ' << setup_quantity_names[i];
      if (found) {
        EXPECT_EQ(found->expanded_uncertainty, degrees(0.01)) << id << setup_quantity_names[i];
        EXPECT_LT(std::abs((found->value - limit->nominal).degrees()) +
                      found->expanded_uncertainty.degrees(),
                  limit->tolerance->degrees())
            << id << ' ' << setup_quantity_names[i];
        ++judged;
      }
    }
  }
  EXPECT_EQ(judged, 3 * 6);
}

// Another value.

TEST(SetupWithQuantity, ChangesThatQuantityAndNoOther) {
  const Instrument nominal = nominal_instrument(shipped_standard("iso_2813/2014"));
  for (std::size_t i = 0; i < setup_quantity_count; ++i) {
    if (!as_built(nominal, "60", quantity_at(i))) {
      continue;
    }
    const Instrument changed = with_quantity(
        nominal, "60", quantity_at(i), {.value = degrees(3.5), .expanded_uncertainty = degrees(1)});
    for (const std::string& id : nominal.geometries) {
      for (std::size_t j = 0; j < setup_quantity_count; ++j) {
        EXPECT_EQ(as_built(changed, id, quantity_at(j)),
                  id == "60" && i == j ? stated(3.5, 1.0) : as_built(nominal, id, quantity_at(j)))
            << setup_quantity_names[i] << ' ' << id << ' ' << setup_quantity_names[j];
      }
    }
  }
}

TEST(SetupWithQuantity, MovesTheAperturesThatAreMeasuredWith) {
  const Instrument nominal = nominal_instrument(shipped_standard("iso_2813/2014"));
  const MeasuringGeometry before = nominal.geometry("60");
  const MeasuringGeometry after =
      with_quantity(nominal, "60", receptor_in_plane, {.value = degrees(4.5)}).geometry("60");
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(after.receptor.u_high(), std::tan(degrees(2.25).radians()), rounding);
  EXPECT_EQ(after.receptor.v_high(), before.receptor.v_high());
  EXPECT_EQ(after.source.u_high(), before.source.u_high());
}

TEST(SetupWithQuantity, ReplacesTheUncertaintyToo) {
  const Instrument triangle =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  EXPECT_EQ(
      as_built(with_quantity(triangle, "60", theta_i, {.value = degrees(60.2)}), "60", theta_i),
      stated(60.2, 0.0));
}

TEST(SetupWithQuantity, SetsASizeThatTheStandardLeavesUnknown) {
  const Instrument paper = with_quantity(nominal_instrument(shipped_standard("tappi_t480/om_15")),
                                         "75", source_in_plane, {.value = degrees(1.0)});
  EXPECT_EQ(as_built(paper, "75", source_in_plane), stated(1.0, 0.0));
}

TEST(SetupWithQuantity, RefusesWhatTheGeometryDoesNotHave) {
  const Instrument nominal = nominal_instrument(shipped_standard("iso_2813/2014"));
  const StatedAngle value{.value = degrees(1.0)};
  EXPECT_THROW((void)with_quantity(nominal, "60", source_diameter, value), std::invalid_argument);
  EXPECT_EQ(message_of([&] { (void)with_quantity(nominal, "60", source_diameter, value); }),
            "with_quantity: nominal has no source_diameter in the geometry '60'");
  EXPECT_THROW((void)with_quantity(nominal, "45", theta_i, value), std::invalid_argument);
  const Instrument round =
      load_text(instrument_text("as_built:\n  \"20\": {receptor: {diameter: 4.7 deg}}\n"));
  EXPECT_THROW((void)with_quantity(round, "20", receptor_in_plane, value), std::invalid_argument);
}

// Errors of the file.

TEST(SetupErrors, OfAnAngleWithItsUncertainty) {
  const auto text = [](const std::string& theta_i) {
    return instrument_text("as_built:\n  \"60\": {theta_i: " + theta_i + "}\n");
  };
  EXPECT_EQ(error_of(text("{value: 90 deg, expanded_uncertainty: 0.02 deg}")),
            ":6:27: as_built.60.theta_i.value: expected an angle (deg, rad, mrad) in [0, 90), "
            "found '90 deg'");
  EXPECT_EQ(error_of(text("{value: 60 deg, expanded_uncertainty: -0.02 deg}")),
            ":6:57: as_built.60.theta_i.expanded_uncertainty: expected an angle (deg, rad, mrad) "
            ">= 0, found '-0.02 deg'");
  EXPECT_EQ(error_of(text("{value: 60 deg, expanded_uncertainty: 0.02}")),
            ":6:57: as_built.60.theta_i.expanded_uncertainty: expected an angle (deg, rad, mrad) "
            ">= 0, found '0.02'");
  EXPECT_EQ(error_of(text("{value: 60 deg}")),
            ":6:19: as_built.60.theta_i.expanded_uncertainty: expected the key "
            "'expanded_uncertainty', found 'only value'");
  EXPECT_EQ(error_of(text("{expanded_uncertainty: 0.02 deg}")),
            ":6:19: as_built.60.theta_i.value: expected the key 'value', found 'only "
            "expanded_uncertainty'");
  EXPECT_EQ(error_of(text("{value: 60 deg, expanded_uncertainty: 0 deg, k: 2}")),
            ":6:64: as_built.60.theta_i.k: expected one of the keys expanded_uncertainty, value, "
            "found 'k'");
  EXPECT_EQ(error_of(text("[60 deg]")),
            ":6:19: as_built.60.theta_i: expected an angle (deg, rad, mrad) in [0, 90), found "
            "'a list'");
}

TEST(SetupErrors, OfTheCommonUncertainty) {
  EXPECT_EQ(error_of(instrument_text("setup_uncertainty: {angles: -0.01 deg}\n")),
            ":5:29: setup_uncertainty.angles: expected an angle (deg, rad, mrad) >= 0, found "
            "'-0.01 deg'");
  EXPECT_EQ(error_of(instrument_text("setup_uncertainty: {apertures: 0.01}\n")),
            ":5:32: setup_uncertainty.apertures: expected an angle (deg, rad, mrad) >= 0, found "
            "'0.01'");
  EXPECT_EQ(error_of(instrument_text("setup_uncertainty: {angle: 0.01 deg}\n")),
            ":5:21: setup_uncertainty.angle: expected one of the keys angles, apertures, found "
            "'angle'");
  EXPECT_EQ(error_of(instrument_text("setup_uncertainty: 0.01 deg\n")),
            ":5:20: setup_uncertainty: expected a map of keys and values, found "
            "'0.01 deg'");
}

// By another standard.

TEST(ByStandard, KeepsWhatWasBuilt) {
  const Instrument instrument =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  const Instrument by_astm = by_standard(instrument, shipped_standard("astm_d523/14"));
  EXPECT_EQ(by_astm.standard.id, "astm_d523/14");
  EXPECT_EQ(by_astm.geometries, instrument.geometries);
  for (const std::string& id : instrument.geometries) {
    for (std::size_t i = 0; i < setup_quantity_count; ++i) {
      const auto before = as_built(instrument, id, quantity_at(i));
      const auto after = as_built(by_astm, id, quantity_at(i));
      ASSERT_EQ(before.has_value(), after.has_value()) << id << setup_quantity_names[i];
      if (before) {
        EXPECT_EQ(before->value, after->value) << id << setup_quantity_names[i];
      }
    }
  }
}

TEST(ByStandard, KeepsTheNominalValuesThatItWasBuiltTo) {
  // Both have a geometry of 60 deg.
  const Instrument instrument = nominal_instrument(shipped_standard("iso_2813/2014"));
  const Instrument by_film = by_standard(instrument, shipped_standard("astm_d2457/13"));
  EXPECT_EQ(as_built(by_film, "60", receptor_in_plane)->value, degrees(4.4));
  EXPECT_EQ(by_film.behaviour.full_scale_gu.size(), 0U);
}

TEST(ByStandard, LeavesOutWhatTheOtherStandardDoesNotHave) {
  const Instrument instrument =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  const Instrument at_20 = by_standard(instrument, shipped_standard("astm_e430/11"));
  for (const std::string& id : at_20.geometries) {
    EXPECT_NO_THROW((void)at_20.standard.geometry(id)) << id;
  }
  EXPECT_LT(at_20.geometries.size(), instrument.geometries.size());
  EXPECT_EQ(at_20.behaviour.full_scale_gu.size(), at_20.geometries.size());
  EXPECT_EQ(
      message_of([&] { (void)by_standard(instrument, shipped_standard("tappi_t480/om_15")); }),
      "expected a standard with one of the geometries 20, 60, 85 of "
      "triangle_gloss, found 'tappi_t480/om_15'");
}

}  // namespace
}  // namespace gonio
