#include "emulator/instrument/glossmeter.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/optics/fresnel.hpp"
#include "emulator/optics/refractive_index.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::message_of;
using test::shipped;
using test::shipped_standard;
using test::TemporaryFolder;

constexpr double tolerance_gu = 1e-6;  // asked of the integrator
constexpr double accuracy_gu = 1e-3;   // of the check values, four decimals or rounded sums
const WavelengthGrid grid = WavelengthGrid::visible();

Glossmeter glossmeter(const Instrument& instrument, const Eigen::ArrayXcd& reference = {}) {
  return {instrument, grid, std::make_shared<ApertureIntegrator>(), reference};
}
Glossmeter nominal(const std::string& standard) {
  return glossmeter(nominal_instrument(shipped_standard(standard)));
}
Instrument instrument_of(const std::string& text) {
  const TemporaryFolder folder;
  return load_instrument(
      folder.file("mine.yaml", "schema: gonio/instrument/1\nid: mine\ntitle: Mine\n" + text),
      shipped());
}

Surface glass(double n) { return smooth(grid, Eigen::ArrayXcd::Constant(grid.size(), n)); }
Surface mirror() { return smooth(grid, 1.0); }
Surface white() { return lambertian(grid, Eigen::ArrayXd::Ones(grid.size())); }

double gloss(const Glossmeter& meter, const Surface& surface, const std::string& geometry,
             Angle tilt = {}) {
  return meter.read(surface, geometry, tolerance_gu, tilt).gloss;
}

// The scale.

TEST(Glossmeter, ReadsTheStandardsValueOfItsReference) {
  for (const char* id : {"iso_2813/2014", "astm_d523/14", "jis_k_5600_4_7/1999", "iso_7668/2018"}) {
    for (const GeometryLimits& geometry : shipped_standard(id).geometries) {
      EXPECT_TRUE(is_close(gloss(nominal(id), glass(1.567), geometry.id), 100.0, 1e-9))
          << id << " " << geometry.id;
    }
  }
}

TEST(Glossmeter, IsLinearInTheReflectanceOfAMirror) {
  const Glossmeter meter = nominal("iso_2813/2014");
  for (const char* id : {"20", "60", "85"}) {
    const double whole = gloss(meter, mirror(), id);
    EXPECT_TRUE(is_close(gloss(meter, smooth(grid, 0.25), id), 0.25 * whole, 1e-9)) << id;
    EXPECT_EQ(gloss(meter, smooth(grid, 0.0), id), 0.0) << id;
  }
}

// ASTM C346 is 1000 times the share of the incident flux. On the axis n = 1.540 reads 55.87 and
// n = 1.567 reads 59.71; its aperture sizes are known from memory only, so the source is a point.
TEST(Glossmeter, ReadsAThousandthOfTheIncidentFluxByC346) {
  constexpr double two_decimals = 0.0051;
  const Glossmeter meter = glossmeter(
      instrument_of("built_to: astm_c346/87\n"
                    "as_built: {\"45\": {source: {in_plane: 0 deg, perpendicular: 0 deg}}}\n"));
  EXPECT_TRUE(is_close(gloss(meter, glass(1.540), "45"), 55.87, two_decimals));
  EXPECT_TRUE(is_close(gloss(meter, glass(1.567), "45"), 59.71, two_decimals));
  EXPECT_TRUE(is_close(gloss(meter, mirror(), "45"), 1000.0, 1e-9));
  EXPECT_TRUE(is_close(gloss(nominal("astm_c346/87"), mirror(), "45"), 1000.0, 1e-9));
}

// By C584 n = 1.567 reads 100.06 at 60 deg. No aperture size is known; on the axis none matters.
TEST(Glossmeter, ReadsAThousandthOfTheIncidentFluxByC584) {
  const Glossmeter meter = glossmeter(
      instrument_of("built_to: astm_c584/81\n"
                    "as_built: {\"60\": {source: {in_plane: 0 deg, perpendicular: 0 deg},\n"
                    "                  receptor: {in_plane: 4 deg, perpendicular: 4 deg}}}\n"));
  EXPECT_TRUE(is_close(gloss(meter, glass(1.567), "60"), 100.06, 0.0051));
}

// TAPPI T480: glass of n = 1.540 reads 100, an ideal mirror 384.35 (384.4 in print).
TEST(Glossmeter, ReadsAMirrorAt384ByT480) {
  const Glossmeter meter = glossmeter(
      instrument_of("built_to: tappi_t480/om_15\n"
                    "as_built: {\"75\": {source: {in_plane: 0 deg, perpendicular: 0 deg},\n"
                    "                  receptor: {in_plane: 4 deg, perpendicular: 4 deg}}}\n"));
  EXPECT_TRUE(is_close(gloss(meter, glass(1.540), "75"), 100.0, 1e-9));
  EXPECT_TRUE(is_close(gloss(meter, mirror(), "75"), 384.35, 0.0051));
}

TEST(Glossmeter, HasARoundReceptorByT653) {
  const Glossmeter meter = glossmeter(
      instrument_of("built_to: tappi_t653/om_07\n"
                    "as_built: {\"20\": {source: {in_plane: 1 deg, perpendicular: 1 deg}}}\n"));
  EXPECT_TRUE(is_close(gloss(meter, glass(1.540), "20"), 100.0, 1e-9));
  EXPECT_GT(gloss(meter, white(), "20"), 0.0);
}

TEST(Glossmeter, ReadsADispersiveReferenceAt100WhenOneIsGiven) {
  const Eigen::ArrayXcd n_hat =
      RefractiveIndex::load(test::source_tree / "fixtures/nk/specs/ohara/optical/S-TIL26.yml")
          .sample(grid);
  const Instrument instrument = nominal_instrument(shipped_standard("iso_2813/2014"));
  const Glossmeter with_constant = glossmeter(instrument);
  const Glossmeter with_glass = glossmeter(instrument, n_hat);
  for (const char* id : {"20", "60", "85"}) {
    EXPECT_TRUE(is_close(gloss(with_glass, smooth(grid, n_hat), id), 100.0, 1e-9)) << id;
    EXPECT_LT(gloss(with_glass, glass(1.567), id), 100.0) << id;
    EXPECT_GT(gloss(with_constant, smooth(grid, n_hat), id), 100.0) << id;
  }
}

// The result.

TEST(GlossReading, HoldsTheReflectanceAtEachWavelengthAndItsLuminousMean) {
  const Glossmeter meter = nominal("iso_2813/2014");
  const GlossReading reading = meter.read(mirror(), "60", tolerance_gu);
  ASSERT_EQ(reading.reflectance.size(), grid.size());
  EXPECT_TRUE(is_close(reading.reflectance.minCoeff(), 1.0, 1e-12));
  EXPECT_TRUE(is_close(reading.reflectance.maxCoeff(), 1.0, 1e-12));
  EXPECT_TRUE(is_close(reading.luminous_reflectance, 1.0, 1e-12));
  EXPECT_TRUE(is_close(meter.weight().sum(), 1.0, 1e-12));
}

TEST(GlossReading, KeepsToTheToleranceAndSaysSo) {
  const Glossmeter meter = nominal("iso_2813/2014");
  const Surface satin =
      cook_torrance(grid, 0.05, Eigen::ArrayXcd::Constant(grid.size(), 1.567), Amplitudes{});
  const double exact = gloss(meter, satin, "60");
  for (const double tolerance : {1.0, 1e-2, 1e-4}) {
    const GlossReading reading = meter.read(satin, "60", tolerance);
    EXPECT_LE(reading.quadrature_error, tolerance);
    EXPECT_TRUE(is_close(reading.gloss, exact, tolerance));
  }
}

// Tilt. A tilt t moves the image of a mirror by 2 t; it is clipped when the image's edge passes the
// receptor's, at 0.26, 0.91 and 0.81 deg.

TEST(GlossmeterTilt, LosesNothingOfAMirrorWithinTheClearance) {
  const Glossmeter meter = nominal("iso_2813/2014");
  const auto of_level = [&](const char* id, double tilt_deg) {
    return gloss(meter, mirror(), id, degrees(tilt_deg)) / gloss(meter, mirror(), id);
  };
  // The tilted sample receives cos(theta_i +- t) of the flux: at most this much more or less.
  const auto flux_change = [](double theta_deg, double tilt_deg) {
    return std::cos(degrees(theta_deg - tilt_deg).radians()) /
           std::cos(degrees(theta_deg).radians());
  };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(is_close(of_level("20", sign * 0.25), flux_change(20, sign * 0.25), 2e-4) ||
                is_close(of_level("20", sign * 0.25), flux_change(20, -sign * 0.25), 2e-4));
    EXPECT_LT(of_level("20", sign * 0.35), 0.95);
    EXPECT_LT(of_level("60", sign * 1.10), 0.95);
    EXPECT_LT(of_level("85", sign * 1.00), 0.95);
    EXPECT_GT(of_level("60", sign * 0.90), 0.96);
    EXPECT_GT(of_level("85", sign * 0.80), 0.80);
  }
}

TEST(GlossmeterTilt, LosesAllOfAMirrorWhenTheImageHasLeftTheReceptor) {
  const Glossmeter meter = nominal("iso_2813/2014");
  EXPECT_EQ(gloss(meter, mirror(), "20", degrees(0.65)), 0.0);
  EXPECT_EQ(gloss(meter, mirror(), "60", degrees(1.30)), 0.0);
  EXPECT_EQ(gloss(meter, mirror(), "60", degrees(-1.30)), 0.0);
  EXPECT_GT(gloss(meter, mirror(), "20", degrees(0.55)), 0.0);
}

TEST(GlossmeterTilt, HalvesAMirrorWhenTheImageIsHalfOut) {
  const Glossmeter meter = nominal("iso_2813/2014");
  const double half = gloss(meter, mirror(), "20", degrees(0.45)) / gloss(meter, mirror(), "20");
  EXPECT_TRUE(is_close(half, 0.5, 0.005));
}

TEST(GlossmeterTilt, HardlyTouchesADiffuser) {
  const Glossmeter meter = nominal("iso_2813/2014");
  const double level = gloss(meter, white(), "20");
  EXPECT_TRUE(test::is_close_relative(gloss(meter, white(), "20", degrees(0.5)), level, 1e-3));
}

// What cannot be measured.

TEST(GlossmeterErrors, OfAReceptorThatSeesNoLightNameTheInstrumentsPlace) {
  const TemporaryFolder folder;
  const auto file =
      folder.file("mine.yaml",
                  "schema: gonio/instrument/1\nid: mine\ntitle: Mine\n"
                  "built_to: iso_2813/2014\nas_built:\n  \"60\": {theta_r: 30 deg}\n");
  const Glossmeter meter = glossmeter(load_instrument(file, shipped()));
  EXPECT_EQ(message_of([&] { (void)meter.read(mirror(), "60", tolerance_gu); }),
            file.string() +
                ":6:9: as_built.60: expected a receptor that the image of the source reaches, "
                "found 'no light in it'");
  EXPECT_TRUE(is_close(gloss(meter, glass(1.567), "20"), 100.0, 1e-9));
}

TEST(GlossmeterErrors, OfASourceThatIsDarkWhereTheReceptorResponds) {
  const TemporaryFolder folder;
  const auto lamp = folder.file("lamp.csv", "nm,power\n380,0\n780,0\n");
  const Instrument instrument =
      instrument_of("built_to: iso_2813/2014\nsource_spectrum: {file: '" + lamp.string() + "'}\n");
  EXPECT_THAT(message_of([&] { (void)glossmeter(instrument); }),
              testing::HasSubstr("expected power where the receptor responds, nowhere below 0"));
}

TEST(GlossmeterErrors, OfASourceBelowZero) {
  const TemporaryFolder folder;
  const auto lamp = folder.file("lamp.csv", "nm,power\n380,-1\n500,1\n780,1\n");
  const Instrument instrument =
      instrument_of("built_to: iso_2813/2014\nsource_spectrum: {file: '" + lamp.string() + "'}\n");
  EXPECT_THROW((void)glossmeter(instrument), InputError);
}

TEST(GlossmeterErrors, OfASpectrumThatDoesNotCoverTheWavelengths) {
  const Instrument instrument = nominal_instrument(shipped_standard("iso_2813/2014"));
  const WavelengthGrid infrared(nanometres(1000), nanometres(5), 3);
  EXPECT_THROW((void)Glossmeter(instrument, infrared, std::make_shared<ApertureIntegrator>()),
               InputError);
}

// Polarisation.

Instrument polarised_iso_2813(double P) {
  return instrument_of(fmt::format("built_to: iso_2813/2014\npolarization: {}\n", P));
}
/// With a point for a source, closed forms hold to the integrator's tolerance.
Instrument polarised_collimated(double P) {
  Instrument instrument =
      load_instrument(shipped().find(Catalog::Kind::instrument, "collimated_iso_2813"), shipped());
  for (const std::string& id : instrument.geometries) {
    instrument.polarization[id] = P;
  }
  return instrument;
}

/// R_s, R_p of a smooth glass as an instrument of polarisation P weighs them.
double weighed(double n, const std::string& geometry, double P) {
  const PolarisedReflectance R =
      fresnel_polarised(std::cos(degrees(std::stod(geometry)).radians()), n);
  return 0.5 * ((1.0 + P) * R.s + (1.0 - P) * R.p);
}

constexpr std::array polarisations{-1.0, -0.3, 0.01, 0.5, 1.0};

TEST(PolarisedGlossmeter, StillReadsTheStandardsValueOfItsReference) {
  for (const double P : polarisations) {
    for (const char* id : {"20", "60", "85"}) {
      EXPECT_TRUE(is_close(gloss(glossmeter(polarised_iso_2813(P)), glass(1.567), id), 100.0, 1e-9))
          << id << ", P = " << P;
    }
  }
}

TEST(PolarisedGlossmeter, ReadsSmoothGlassByFresnelsFormulas) {
  for (const double P : polarisations) {
    const Glossmeter meter = glossmeter(polarised_collimated(P));
    for (const char* id : {"20", "60", "85"}) {
      const double expected = 100.0 * weighed(1.5, id, P) / weighed(1.567, id, P);
      EXPECT_TRUE(is_close(gloss(meter, glass(1.5), id), expected, 1e-9 * expected))
          << id << ", P = " << P;
      const double of_mirror = 100.0 / weighed(1.567, id, P);
      EXPECT_TRUE(is_close(gloss(meter, mirror(), id), of_mirror, 1e-9 * of_mirror))
          << id << ", P = " << P;
    }
  }
}

// (R_s - R_p) / (R_s + R_p) of glass of n = 1.567 is 0.162, 0.991 and 0.210: what is not polarised
// by reflection reads less by that share of P.
TEST(PolarisedGlossmeter, ReadsLessByTheDiattenuationOfTheTile) {
  constexpr double of_the_source = 0.002;  // over which the tile's is averaged; and three decimals
  constexpr double P = 0.01;
  const Glossmeter meter = glossmeter(polarised_iso_2813(P));
  const std::vector<std::pair<std::string, double>> known{
      {"20", 0.162}, {"60", 0.991}, {"85", 0.210}};
  for (const auto& [id, diattenuation] : known) {
    for (const Surface& surface : {mirror(), white()}) {
      const double share =
          gloss(nominal("iso_2813/2014"), surface, id) / gloss(meter, surface, id) - 1.0;
      EXPECT_TRUE(is_close(share / P, diattenuation, of_the_source)) << id;
    }
  }
}

TEST(PolarisedGlossmeter, OfNoPolarizationReadsTheSameToTheLastBit) {
  const Glossmeter plain = nominal("iso_2813/2014");
  const Glossmeter zero = glossmeter(polarised_iso_2813(0.0));
  const Surface paint = cook_torrance(grid, 0.05, Eigen::ArrayXcd::Constant(grid.size(), 1.5));
  for (const char* id : {"20", "60", "85"}) {
    EXPECT_EQ(gloss(zero, paint, id), gloss(plain, paint, id)) << id;
    EXPECT_EQ(gloss(zero, glass(1.5), id), gloss(plain, glass(1.5), id)) << id;
  }
}

// A lobe much narrower than the receptor reads as the smooth surface does.
TEST(PolarisedGlossmeter, SeesTheFacetsOfALobe) {
  constexpr double of_the_tails = 0.01;  // relative: what misses the receptor
  const Glossmeter meter = glossmeter(polarised_collimated(0.5));
  const Surface paint = cook_torrance(grid, 0.003, Eigen::ArrayXcd::Constant(grid.size(), 1.5));
  for (const char* id : {"20", "60"}) {
    const double smooth_paint = gloss(meter, glass(1.5), id);
    EXPECT_TRUE(is_close(gloss(meter, paint, id), smooth_paint, of_the_tails * smooth_paint)) << id;
  }
}

TEST(PolarisedGlossmeter, ReadsItsReferenceInTheGeometryOfTheReference) {
  const std::string openings =
      "{source: {diameter: 0.5 deg}, receptor: {in_plane: 1 deg, perpendicular: 1 deg}}";
  Instrument haze = instrument_of("built_to: astm_e430/11\nas_built:\n  \"20\": " + openings +
                                  "\n  \"20_r18_1\": " + openings + "\n");
  const double unpolarised = gloss(glossmeter(haze), white(), "20_r18_1");
  haze.polarization["20_r18_1"] = 0.5;
  EXPECT_EQ(gloss(glossmeter(haze), white(), "20_r18_1"), unpolarised);
  haze.polarization["20"] = 0.5;
  EXPECT_TRUE(is_close(unpolarised / gloss(glossmeter(haze), white(), "20_r18_1"),
                       1.0 + 0.5 * 0.162, 5e-4));  // by the diattenuation of the tile at 20 deg
}

}  // namespace
}  // namespace gonio
