#include "emulator/instrument/instrument.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/instrument/instrument_file.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::error_of;
using test::ids_of_shipped;
using test::instrument_text;
using test::load_text;
using test::message_of;
using test::shipped;
using test::shipped_standard;
using test::TemporaryFolder;
using testing::StartsWith;

constexpr double rounding = 1e-12;

double theta_deg(const Aperture& aperture) {
  return std::acos(aperture.frame().axis.z()) * 180.0 / std::numbers::pi;
}
double in_plane_deg(const Aperture& aperture) {
  return 2.0 * std::atan(aperture.u_high()) * 180.0 / std::numbers::pi;
}
double perpendicular_deg(const Aperture& aperture) {
  return 2.0 * std::atan(aperture.v_high()) * 180.0 / std::numbers::pi;
}

// What ships.

TEST(ShippedInstruments, LoadUnderTheIdOfTheirFile) {
  const auto ids = ids_of_shipped(Catalog::Kind::instrument);
  EXPECT_THAT(ids, testing::IsSupersetOf({"collimated_iso_2813", "nominal_iso_2813", "paper_setup",
                                          "pocket_gloss_60", "triangle_gloss"}));
  for (const std::string& id : ids) {
    const Instrument instrument =
        load_instrument(shipped().find(Catalog::Kind::instrument, id), shipped());
    EXPECT_EQ(instrument.id, id);
    EXPECT_FALSE(instrument.title.empty()) << id;
  }
}

// As built.

TEST(InstrumentGeometry, IsTheStandardsWhereNothingIsStated) {
  const Instrument nominal = nominal_instrument(shipped_standard("iso_2813/2014"));
  const Instrument loaded = load_text(instrument_text(""));
  for (const Instrument& instrument : {nominal, loaded}) {
    const MeasuringGeometry geometry = instrument.geometry("60");
    EXPECT_NEAR(theta_deg(geometry.source), 60.0, rounding);
    EXPECT_NEAR(theta_deg(geometry.receptor), 60.0, rounding);
    EXPECT_LT(geometry.source.frame().axis.x(), 0.0);
    EXPECT_GT(geometry.receptor.frame().axis.x(), 0.0);
    EXPECT_NEAR(in_plane_deg(geometry.source), 0.75, rounding);
    EXPECT_NEAR(perpendicular_deg(geometry.source), 2.5, rounding);
    EXPECT_NEAR(in_plane_deg(geometry.receptor), 4.4, rounding);
    EXPECT_NEAR(perpendicular_deg(geometry.receptor), 11.7, rounding);
  }
}

TEST(InstrumentGeometry, TakesWhatIsStatedAndTheStandardForTheRest) {
  const Instrument instrument = load_text(instrument_text(
      "as_built:\n"
      "  \"60\": {theta_i: 60.04 deg, theta_r: 59.97 deg, receptor: {in_plane: 4.43 deg}}\n"
      "  \"85\": {source: {perpendicular: 2.4 deg}}\n"));
  const MeasuringGeometry at_60 = instrument.geometry("60");
  EXPECT_NEAR(theta_deg(at_60.source), 60.04, rounding);
  EXPECT_NEAR(theta_deg(at_60.receptor), 59.97, rounding);
  EXPECT_NEAR(in_plane_deg(at_60.receptor), 4.43, rounding);
  EXPECT_NEAR(perpendicular_deg(at_60.receptor), 11.7, rounding);
  EXPECT_NEAR(in_plane_deg(at_60.source), 0.75, rounding);
  const MeasuringGeometry at_85 = instrument.geometry("85");
  EXPECT_NEAR(theta_deg(at_85.source), 85.0, 1e-10);  // acos loses digits there
  EXPECT_NEAR(in_plane_deg(at_85.source), 0.75, rounding);
  EXPECT_NEAR(perpendicular_deg(at_85.source), 2.4, rounding);
}

TEST(InstrumentGeometry, LeavesTheReceptorWhereItIsWhenTheSourceIsMisplaced) {
  const Instrument instrument =
      load_text(instrument_text("as_built:\n  \"60\": {theta_i: 60.2 deg}\n"));
  EXPECT_NEAR(theta_deg(instrument.geometry("60").source), 60.2, rounding);
  EXPECT_NEAR(theta_deg(instrument.geometry("60").receptor), 60.0, rounding);
}

TEST(InstrumentGeometry, MayBeRoundWhereTheStandardIsNot) {
  const MeasuringGeometry geometry =
      load_text(instrument_text("as_built:\n  \"20\": {receptor: {diameter: 4.7 deg}}\n"))
          .geometry("20");
  EXPECT_EQ(geometry.receptor.outline(), Aperture::Outline::circle);
  EXPECT_NEAR(in_plane_deg(geometry.receptor), 4.7, rounding);
  EXPECT_EQ(geometry.source.outline(), Aperture::Outline::rectangle);
}

TEST(InstrumentGeometry, StatesWhatTheStandardLeavesUnknown) {
  const MeasuringGeometry geometry =
      load_text(instrument_text("as_built:\n"
                                "  \"75\":\n"
                                "    source: {in_plane: 1 deg, perpendicular: 2 deg}\n"
                                "    receptor: {in_plane: 5 deg, perpendicular: 6 deg}\n",
                                "tappi_t480/om_15"))
          .geometry("75");
  EXPECT_NEAR(perpendicular_deg(geometry.source), 2.0, rounding);
  EXPECT_NEAR(perpendicular_deg(geometry.receptor), 6.0, rounding);
}

TEST(InstrumentGeometry, NamesTheFirstNumberThatIsStillMissing) {
  const Instrument instrument =
      load_text(instrument_text("as_built:\n"
                                "  \"75\":\n"
                                "    source: {in_plane: 1 deg, perpendicular: 2 deg}\n"
                                "    receptor: {in_plane: 5 deg}\n",
                                "tappi_t480/om_15"));
  EXPECT_THAT(message_of([&] { (void)instrument.geometry("75"); }),
              testing::EndsWith("geometries[0].receptor.perpendicular: expected a number, to "
                                "measure in this geometry, found 'unknown'"));
}

TEST(InstrumentGeometry, WithOneSideInPlaceOfACircleNamesTheOtherSideInTheInstrumentsFile) {
  const TemporaryFolder folder;
  const auto file = folder.file(
      "mine.yaml", instrument_text("as_built:\n"
                                   "  \"20\":\n"
                                   "    source: {in_plane: 1 deg, perpendicular: 2 deg}\n"
                                   "    receptor: {in_plane: 4 deg}\n",
                                   "tappi_t653/om_07"));
  const std::string message =
      message_of([&] { (void)load_instrument(file, shipped()).geometry("20"); });
  EXPECT_EQ(message, file.string() +
                         ":8:15: as_built.20.receptor.perpendicular: expected the key "
                         "'perpendicular', since the standard has a circle, found 'only in_plane'");
}

TEST(InstrumentGeometry, OfAnUnknownIdIsOutOfRange) {
  EXPECT_THROW((void)load_text(instrument_text("")).geometry("45"), std::out_of_range);
}

TEST(InstrumentLoad, ReadsSpectraAndRepeatability) {
  const Instrument triangle =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  EXPECT_EQ(triangle.behaviour.repeatability_gu, 0.05);
  EXPECT_NE(triangle.source.at(nanometres(450)), triangle.standard.source.at(nanometres(450)));
  EXPECT_EQ(triangle.responsivity.at(nanometres(555)), 1.0);
  EXPECT_EQ(load_text(instrument_text("")).behaviour.repeatability_gu, 0.0);
}

TEST(InstrumentLoad, ReadsWhatLiesBesideIt) {
  const TemporaryFolder folder;
  (void)folder.file("own.yaml", "schema: gonio/sample/1\n");
  const Instrument instrument = load_instrument(
      folder.file("mine.yaml", instrument_text("samples: [black_matt, own.yaml]\n")), shipped());
  ASSERT_EQ(instrument.samples.size(), 2U);
  EXPECT_EQ(instrument.samples[0], shipped().find(Catalog::Kind::sample, "black_matt"));
  EXPECT_EQ(instrument.samples[1], folder.path() / "own.yaml");
  EXPECT_TRUE(load_text(instrument_text("")).samples.empty());
}

TEST(InstrumentLoad, HandsTheWireOnUnread) {
  const Instrument instrument = load_text(instrument_text("wire: {anything: [at, all]}\n"));
  ASSERT_TRUE(instrument.wire);
  EXPECT_EQ(instrument.wire->mark().line, 5);
  EXPECT_TRUE(instrument.wire->is_map());
  EXPECT_FALSE(load_text(instrument_text("")).wire);
}

// Over the wire a sample is known by its place in the list, so that new ones stand at the end.
TEST(ShippedTriangleGloss, KeepsTheOrderOfItsSamples) {
  const Instrument triangle =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  std::vector<std::string> ids;
  for (const std::filesystem::path& file : triangle.samples) {
    ids.push_back(file.stem().string());
  }
  EXPECT_THAT(
      ids, testing::ElementsAre("black_matt", "red_satin", "black_semi_gloss", "black_high_gloss",
                                "black_glass_n1567", "perfect_mirror", "glass_n1400", "glass_n1500",
                                "glass_n1527", "glass_n1600", "glass_n1700", "glass_n1800",
                                "white_diffuser", "copper_smooth_johnson", "gold_smooth_johnson",
                                "mirror_tilted_0_2deg", "check_m005_n1567"));
}

TEST(InstrumentLoad, ReadsIdentityAndBehaviour) {
  const Instrument triangle =
      load_instrument(shipped().find(Catalog::Kind::instrument, "triangle_gloss"), shipped());
  EXPECT_EQ(triangle.identity.model, "Triangle Gloss");
  EXPECT_EQ(triangle.behaviour.full_scale_gu, (std::vector<double>{2000.0, 1000.0, 160.0}));
}

TEST(InstrumentGeometries, AreThoseOfTheStandardInItsOrder) {
  using testing::ElementsAre;
  EXPECT_THAT(load_text(instrument_text("")).geometries, ElementsAre("20", "60", "85"));
  EXPECT_THAT(load_text(instrument_text("geometries: [\"60\", \"20\"]\n")).geometries,
              ElementsAre("20", "60"));
}

TEST(InstrumentGeometries, ThatItDoesNotHaveAreOutOfRange) {
  const Instrument instrument = load_text(instrument_text("geometries: [\"60\"]\n"));
  EXPECT_TRUE(instrument.has("60"));
  EXPECT_FALSE(instrument.has("20"));
  EXPECT_NO_THROW((void)instrument.geometry("60"));
  EXPECT_EQ(message_of([&] { (void)instrument.geometry("20"); }),
            "Instrument::geometry: mine has no '20'");
  EXPECT_THROW((void)instrument.geometry("20"), std::out_of_range);
}

// Errors.

TEST(InstrumentErrors, OfGeometries) {
  EXPECT_EQ(error_of(instrument_text("geometries: [\"45\"]\n")),
            ":5:14: geometries[0]: expected one of 20, 60, 85, found '45'");
  EXPECT_EQ(error_of(instrument_text("geometries: [\"60\", \"60\"]\n")),
            ":5:20: geometries[1]: expected each geometry once, found '60'");
  EXPECT_EQ(error_of(instrument_text("geometries: []\n")),
            ":5:13: geometries: expected a list of at least one item, found 'a list'");
  EXPECT_EQ(
      error_of(instrument_text("geometries: [\"60\"]\nas_built:\n  \"20\": {theta_i: 20 deg}\n")),
      ":7:9: as_built.20: expected one of the geometries of this instrument, found '20'");
  EXPECT_EQ(
      error_of(instrument_text("geometries: [\"60\"]\nbehaviour: {full_scale: {\"20\": 9 GU}}\n")),
      ":6:25: behaviour.full_scale.60: expected the key '60', found 'only 20'");
}

TEST(InstrumentErrors, OfGeometriesWithoutTheOneThatTheyAreRelativeTo) {
  const Standard standard = shipped_standard("astm_e430/11");
  std::string relative;
  std::string to;
  for (const GeometryLimits& geometry : standard.geometries) {
    if (geometry.relative_to) {
      relative = geometry.id;
      to = *geometry.relative_to;
      break;
    }
  }
  ASSERT_FALSE(relative.empty());
  EXPECT_EQ(error_of(instrument_text("geometries: [\"" + relative + "\"]\n", "astm_e430/11")),
            ":5:13: geometries: expected '" + to + "' too, where the reference of '" + relative +
                "' is read, found 'none'");
}

TEST(InstrumentErrors, OfASampleThatIsNotThereNameItsPlaceInTheFile) {
  EXPECT_THAT(error_of(instrument_text("samples: [black_matt, gold_leaf]\n")),
              testing::AllOf(StartsWith(":5:23: samples[1]: expected a sample file"),
                             testing::EndsWith("found 'gold_leaf'")));
  EXPECT_EQ(error_of(instrument_text("samples: []\n")),
            ":5:10: samples: expected a list of at least one item, found 'a list'");
}

TEST(InstrumentErrors, OfKeys) {
  EXPECT_EQ(error_of(instrument_text("colour: red\n")),
            ":5:1: colour: expected one of the keys as_built, behaviour, built_to, geometries, id, "
            "identity, notes, polarization, repeatability, responsivity, samples, schema, "
            "setup_uncertainty, "
            "source_spectrum, spot, title, uncertainty, wire, found 'colour'");
  EXPECT_EQ(error_of(instrument_text("as_built:\n  \"60\": {colour: 3 deg}\n")),
            ":6:10: as_built.60.colour: expected one of the keys receptor, source, theta_i, "
            "theta_r, found 'colour'");
  EXPECT_EQ(error_of(instrument_text("as_built:\n  \"60\": {source: {width: 3 deg}}\n")),
            ":6:19: as_built.60.source.width: expected one of the keys diameter, in_plane, "
            "perpendicular, found 'width'");
  EXPECT_EQ(
      error_of(
          instrument_text("as_built:\n  \"60\": {receptor: {diameter: 3 deg, in_plane: 3 deg}}\n")),
      ":6:38: as_built.60.receptor.in_plane: expected one of the keys diameter, found 'in_plane'");
}

TEST(InstrumentErrors, OfAGeometryThatTheStandardDoesNotHave) {
  EXPECT_EQ(error_of(instrument_text("as_built:\n  \"45\": {theta_i: 45 deg}\n")),
            ":6:9: as_built.45: expected a geometry of iso_2813/2014, found '45'");
}

TEST(InstrumentErrors, OfNumbers) {
  EXPECT_EQ(error_of(instrument_text("as_built:\n  \"60\": {theta_i: 60}\n")),
            ":6:19: as_built.60.theta_i: expected an angle (deg, rad, mrad) in [0, 90), found "
            "'60'");
  EXPECT_EQ(error_of(instrument_text("as_built:\n  \"60\": {theta_r: 91 deg}\n")),
            ":6:19: as_built.60.theta_r: expected an angle (deg, rad, mrad) in [-90, 90], found "
            "'91 deg'");
  EXPECT_EQ(error_of(instrument_text("as_built:\n  \"60\": {source: {in_plane: -1 deg}}\n")),
            ":6:29: as_built.60.source.in_plane: expected an angle (deg, rad, mrad) in [0, 120], "
            "found '-1 deg'");
  EXPECT_EQ(error_of(instrument_text("repeatability: 0.05\n")),
            ":5:16: repeatability: expected a gloss value (GU) >= 0, found '0.05'");
  EXPECT_EQ(error_of(instrument_text("repeatability: -0.05 GU\n")),
            ":5:16: repeatability: expected a gloss value (GU) >= 0, found '-0.05 GU'");
}

TEST(InstrumentErrors, OfAStandardThatIsNotThereNameItsPlaceInTheFile) {
  const std::string message = error_of(instrument_text("", "iso_2813/2099"));
  EXPECT_THAT(message, StartsWith(":4:11: built_to: expected"));
  EXPECT_THAT(message, testing::HasSubstr("iso_2813/2014"));
  EXPECT_THAT(message, testing::EndsWith("found 'iso_2813/2099'"));
}

TEST(InstrumentErrors, OfASpectrumThatIsNotThere) {
  EXPECT_THAT(error_of(instrument_text("source_spectrum: {file: lamp.csv}\n")),
              testing::HasSubstr("lamp.csv"));
}

TEST(InstrumentSpot, IsTheBeamMadeLongerByTheAngleOfIncidence) {
  const Instrument instrument =
      load_text(instrument_text("as_built: {\"20\": {theta_i: 21 deg}}\nspot: {in_plane: 3 mm, "
                                "perpendicular: 5 mm}\n"));
  const struct {
    const char* geometry;
    double theta_i_deg;
  } rows[] = {{"20", 21.0}, {"60", 60.0}, {"85", 85.0}};
  for (const auto& row : rows) {
    const Spot spot = instrument.spot(row.geometry, 70, 40);
    EXPECT_EQ(spot.x_mm, 70.0);
    EXPECT_EQ(spot.y_mm, 40.0);
    EXPECT_NEAR(spot.half_length_mm, 1.5 / std::cos(row.theta_i_deg * std::numbers::pi / 180.0),
                rounding);
    EXPECT_NEAR(spot.half_width_mm, 2.5, rounding);
  }
}

TEST(InstrumentSpot, IsAPointUnlessTheFileSays) {
  const Instrument nominal = nominal_instrument(shipped_standard("iso_2813/2014"));
  EXPECT_EQ(nominal.spot("60", 1, 2), (Spot{.x_mm = 1, .y_mm = 2}));
  EXPECT_THROW((void)nominal.spot("45", 1, 2), std::out_of_range);
}

}  // namespace
}  // namespace gonio
