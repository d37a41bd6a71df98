#include "emulator/procedure/measure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::message_of;
using test::meter_by_standard;
using test::meter_of;
using test::observer;
using test::shipped_meter;
using test::shipped_sample;
using test::TemporaryFolder;

std::vector<std::string> ids_of(const Measurement& measurement) {
  std::vector<std::string> ids;
  for (const GeometryResult& result : measurement.geometries) {
    ids.push_back(result.id);
  }
  return ids;
}

Measurement measured(const std::string& sample, const std::string& standard,
                     const MeasureOptions& options = {}) {
  return measure(shipped_sample(sample), meter_by_standard(standard), observer(), options);
}

// Geometries.

TEST(MeasureGeometries, AreAllOfTheStandardUnlessSomeAreAskedFor) {
  EXPECT_EQ(ids_of(measured("black_satin", "iso_2813/2014")),
            (std::vector<std::string>{"20", "60", "85"}));
  EXPECT_EQ(ids_of(measured("black_satin", "iso_2813/2014", {.geometries = {"85", "20"}})),
            (std::vector<std::string>{"85", "20"}));
}

TEST(MeasureGeometries, AskedForTwiceAreMeasuredOnce) {
  EXPECT_EQ(ids_of(measured("black_satin", "iso_2813/2014", {.geometries = {"60", "20", "60"}})),
            (std::vector<std::string>{"60", "20"}));
}

TEST(MeasureGeometries, ThatTheStandardDoesNotHaveAreRefusedByName) {
  EXPECT_THROW((void)measured("black_satin", "iso_2813/2014", {.geometries = {"45"}}),
               std::invalid_argument);
  EXPECT_EQ(message_of([] {
              (void)measured("black_satin", "iso_2813/2014", {.geometries = {"60", "45"}});
            }),
            "iso_2813/2014 has the geometries 20, 60, 85, not '45'");
}

TEST(MeasureGeometries, AreThoseThatTheInstrumentHas) {
  const Glossmeter pocket = shipped_meter("pocket_gloss_60");
  const Sample paint = shipped_sample("black_satin");
  EXPECT_EQ(ids_of(measure(paint, pocket, observer(), {})), (std::vector<std::string>{"60"}));
  EXPECT_EQ(message_of([&] { (void)measure(paint, pocket, observer(), {.geometries = {"20"}}); }),
            "pocket_gloss_60 has the geometries 60, not '20'");
}

TEST(MeasureGeometries, MayBeAskedForWhereAnotherOneIsUnknown) {
  EXPECT_EQ(ids_of(measured("black_satin", "jis_z_8741/1997", {.geometries = {"60"}})),
            (std::vector<std::string>{"60"}));
  EXPECT_THROW((void)measured("black_satin", "jis_z_8741/1997"), InputError);
}

TEST(Measurement, FindsAGeometryOrNothing) {
  const Measurement measurement = measured("black_satin", "iso_2813/2014", {.geometries = {"60"}});
  EXPECT_EQ(measurement.find("60")->id, "60");
  EXPECT_EQ(measurement.find("20"), nullptr);
  EXPECT_EQ(measurement.sample, "black_satin");
}

// The geometry that the standard selects, by mirrors that read close to its limits at 60 deg.

std::optional<std::string> selected_for(double gloss_at_60) {
  const TemporaryFolder folder;
  const Glossmeter meter = meter_by_standard("iso_2813/2014");
  const double ideal = meter.read(smooth(test::visible, 1.0), "60", 1e-9).gloss;  // 999.27
  const Sample sample{
      .file = {}, .id = "mirror", .surface = smooth(test::visible, gloss_at_60 / ideal)};
  return measure(sample, meter, observer(), {.tolerance = 1e-9}).selected_geometry;
}

TEST(MeasureSelection, FollowsTheGlossAtSixtyDegrees) {
  EXPECT_EQ(selected_for(70.0001), "20");
  EXPECT_EQ(selected_for(69.9999), "60");
  EXPECT_EQ(selected_for(10.0001), "60");
  EXPECT_EQ(selected_for(9.9999), "85");
}

TEST(MeasureSelection, IsNothingUnlessSixtyDegreesWasMeasured) {
  EXPECT_EQ(
      measured("black_satin", "iso_2813/2014", {.geometries = {"20", "85"}}).selected_geometry,
      std::nullopt);
}

// Haze of ASTM D4039: G60 - G20, for specimens above 70 GU at 60 deg.

TEST(MeasureHaze, IsTheDifferenceAboveSeventy) {
  const Measurement measurement = measured("clearcoat_hazy", "astm_d4039/09");
  ASSERT_EQ(measurement.haze.size(), 1u);
  EXPECT_EQ(measurement.haze.front().id, "haze_index");
  const double at_60 = measurement.find("60")->reading.gloss;
  ASSERT_GT(at_60, 70.0);
  EXPECT_EQ(measurement.haze.front().value, at_60 - measurement.find("20")->reading.gloss);
}

TEST(MeasureHaze, IsNotDefinedBelowSeventy) {
  const Measurement measurement = measured("black_satin", "astm_d4039/09");
  ASSERT_LT(measurement.find("60")->reading.gloss, 70.0);
  ASSERT_EQ(measurement.haze.size(), 1u);
  EXPECT_EQ(measurement.haze.front().value, std::nullopt);
}

TEST(MeasureHaze, NeedsBothGeometries) {
  EXPECT_EQ(measured("clearcoat_hazy", "astm_d4039/09", {.geometries = {"60"}}).haze.front().value,
            std::nullopt);
}

TEST(MeasureHaze, UsesTheGlossOfAstmD523) {
  const Measurement by_d523 = measured("clearcoat_hazy", "astm_d523/14");
  const Measurement by_d4039 = measured("clearcoat_hazy", "astm_d4039/09");
  for (const char* id : {"20", "60"}) {
    EXPECT_EQ(by_d4039.find(id)->reading.gloss, by_d523.find(id)->reading.gloss);
    EXPECT_TRUE(
        (by_d4039.find(id)->reading.reflectance == by_d523.find(id)->reading.reflectance).all());
  }
}

// A receptor beside the mirror direction, read relative to the reference in the mirror direction.

Standard standard_with_haze_receptor(const TemporaryFolder& folder) {
  const std::string evidence = ", evidence: {level: C2, sources: []}}\n";
  return load_standard(folder.file(
      "standard.yaml", test::user_standard() +
                           "  - id: \"60_r57\"\n"
                           "    theta_i: {nominal: 60 deg" +
                           evidence + "    theta_r: {nominal: 57 deg" + evidence +
                           "    relative_to: \"60\"\n"
                           "    source:\n"
                           "      in_plane: {nominal: 0.75 deg" +
                           evidence + "      perpendicular: {nominal: 2.5 deg" + evidence +
                           "    receptor:\n"
                           "      in_plane: {nominal: 1 deg" +
                           evidence + "      perpendicular: {nominal: 11.7 deg" + evidence));
}

TEST(MeasureOffSpecular, ReadsNothingOfAMirrorAndTheHazeOfARoughSurface) {
  const TemporaryFolder folder;
  const Glossmeter meter = meter_of(nominal_instrument(standard_with_haze_receptor(folder)));
  const auto gloss = [&](const std::string& sample) {
    return measure(shipped_sample(sample), meter, observer(), {}).find("60_r57")->reading.gloss;
  };
  EXPECT_EQ(gloss("perfect_mirror"), 0.0);
  EXPECT_GT(gloss("black_satin"), 1.0);
  EXPECT_LT(gloss("black_satin"), 100.0);
}

TEST(MeasureOffSpecular, IsRelativeToTheReferenceInTheMirrorDirection) {
  const TemporaryFolder folder;
  const Glossmeter meter = meter_of(nominal_instrument(standard_with_haze_receptor(folder)));
  const Measurement measurement =
      measure(shipped_sample("white_diffuser"), meter, observer(), {.tolerance = 1e-8});
  // For a diffuser the flux is proportional to the receptor's projected solid angle.
  const MeasuringGeometry mirror = meter.instrument().geometry("60");
  const MeasuringGeometry beside = meter.instrument().geometry("60_r57");
  const double ratio = beside.receptor.solid_angle() * std::cos(degrees(57).radians()) /
                       (mirror.receptor.solid_angle() * std::cos(degrees(60).radians()));
  EXPECT_TRUE(test::is_close_relative(measurement.find("60_r57")->reading.gloss,
                                      ratio * measurement.find("60")->reading.gloss, 2e-3));
}

// Tilt and colour.

TEST(MeasureTilt, ClipsAMirrorAndIsOnlyOfTheSample) {
  const Measurement flat = measured("perfect_mirror", "iso_2813/2014");
  const Measurement tilted = measured("perfect_mirror", "iso_2813/2014", {.tilt = degrees(0.45)});
  EXPECT_TRUE(
      is_close(tilted.find("20")->reading.gloss / flat.find("20")->reading.gloss, 0.5, 0.005));
  EXPECT_TRUE(
      is_close(tilted.find("60")->reading.gloss / flat.find("60")->reading.gloss, 1.0, 0.03));
}

TEST(MeasureTilt, OfASampleOnAWedgeIsAsIfAskedFor) {
  const Measurement wedge = measured("mirror_tilted_1_0deg", "iso_2813/2014");
  const Measurement asked = measured("perfect_mirror", "iso_2813/2014", {.tilt = degrees(1.0)});
  for (const GeometryResult& result : wedge.geometries) {
    EXPECT_EQ(result.reading.gloss, asked.find(result.id)->reading.gloss) << result.id;
  }
}

TEST(MeasureTilt, IsAddedToThatOfTheSample) {
  const Measurement flat = measured("perfect_mirror", "iso_2813/2014");
  const Measurement level =
      measured("mirror_tilted_1_0deg", "iso_2813/2014", {.tilt = degrees(-1.0)});
  for (const GeometryResult& result : flat.geometries) {
    EXPECT_EQ(result.reading.gloss, level.find(result.id)->reading.gloss) << result.id;
  }
}

/// What is left of the light on a mirror tilted towards the receptor: a share of cos(theta_i + t).
double share_of(const std::string& sample, const std::string& geometry, double tilt_deg) {
  const GeometryResult flat =
      *measured("perfect_mirror", "iso_2813/2014", {.geometries = {geometry}}).find(geometry);
  const GeometryResult tilted =
      *measured(sample, "iso_2813/2014", {.geometries = {geometry}}).find(geometry);
  return tilted.reading.gloss / flat.reading.gloss * std::cos(flat.theta_i.radians()) /
         std::cos((flat.theta_i + degrees(tilt_deg)).radians());
}

TEST(MeasureTilt, LeavesAllOfAMirrorsLightWithinTheClearanceOfTheReceptor) {
  constexpr double rounding = 1e-6;  // 1e-4 GU in 100 GU, twice
  for (const std::string geometry : {"20", "60", "85"}) {
    EXPECT_TRUE(is_close(share_of("mirror_tilted_0_2deg", geometry, 0.2), 1.0, rounding))
        << geometry;
  }
}

/// The share of cos i in the lower part of an image of 0.75 deg; angles in degrees.
double lower_part(double theta_i_deg, double kept_deg) {
  const auto up_to = [&](double from_axis_deg) {
    return std::sin(degrees(theta_i_deg + from_axis_deg).radians()) -
           std::sin(degrees(theta_i_deg - 0.375).radians());
  };
  return up_to(kept_deg - 0.375) / up_to(0.375);
}

// The image moves by 2 deg, from 1.625 deg on; the receptors reach 0.9, 2.2 and 2 deg.
TEST(MeasureTilt, LosesWhatTheReceptorClips) {
  constexpr double of_the_tangents = 1e-3;  // equal steps of them are not equal angles
  EXPECT_EQ(share_of("mirror_tilted_1_0deg", "20", 1.0), 0.0);
  EXPECT_TRUE(is_close(share_of("mirror_tilted_1_0deg", "60", 1.0), lower_part(61.0, 2.2 - 1.625),
                       of_the_tangents));
  EXPECT_TRUE(is_close(share_of("mirror_tilted_1_0deg", "85", 1.0), lower_part(86.0, 2.0 - 1.625),
                       of_the_tangents));
}

TEST(MeasureColour, OfAMirrorIsWhiteAndOfCopperIsReddish) {
  const ReflectedColour white =
      measured("perfect_mirror", "iso_2813/2014").find("60")->colour.value();
  EXPECT_TRUE(is_close(white.lab.L, 100.0, 1e-9));
  EXPECT_TRUE(is_close(white.lab.a, 0.0, 1e-9));
  EXPECT_TRUE(is_close(white.lab.b, 0.0, 1e-9));
  const Lab copper = measured("copper_smooth_johnson", "iso_2813/2014").find("20")->colour->lab;
  EXPECT_GT(copper.a, 5.0);
  EXPECT_GT(copper.b, 5.0);
}

TEST(MeasureColour, IsNothingWhereNoLightArrives) {
  EXPECT_EQ(measured("perfect_mirror", "iso_2813/2014", {.tilt = degrees(10)}).find("60")->colour,
            std::nullopt);
}

TEST(MeasureEvidence, IsCarriedFromTheStandard) {
  const Measurement measurement = measured("black_satin", "iso_2813/2014");
  EXPECT_TRUE(measurement.find("60")->evidence.is_informative());
}

}  // namespace
}  // namespace gonio
