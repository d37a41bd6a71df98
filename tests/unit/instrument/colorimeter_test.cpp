#include "emulator/instrument/colorimeter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "emulator/core/parallel_for.hpp"
#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/optics/fresnel.hpp"
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
using test::TemporaryFolder;

constexpr double asked = 1e-8;  // of the integrator
const WavelengthGrid grid(nanometres(400), nanometres(100), 4);

Instrument shipped_instrument(const std::string& id) {
  return load_instrument(shipped().find(Catalog::Kind::instrument, id), shipped());
}
Instrument instrument_of(const std::string& text) {
  const TemporaryFolder folder;
  return load_instrument(
      folder.file("mine.yaml", "schema: gonio/instrument/1\nid: mine\ntitle: Mine\n" + text),
      shipped());
}
Colorimeter colorimeter(const Instrument& instrument) {
  return {instrument, grid, std::make_shared<ApertureIntegrator>(),
          Eigen::ArrayXd::Constant(grid.size(), 1.0 / double(grid.size()))};
}
Eigen::ArrayXd spectrum(double a, double b, double c, double d) {
  return Eigen::Array4d(a, b, c, d);
}
const std::vector<std::string> colour_instruments{"colorimeter_45_0", "multi_angle_45",
                                                  "sphere_8_d"};

double mean_factor(const Colorimeter& meter, const Surface& surface, const std::string& geometry) {
  return meter.read(surface, geometry, asked).radiance_factor.mean();
}

TEST(Colorimeter, ReadsTheReflectanceOfALambertianSurfaceInEachGeometry) {
  constexpr double rounding = 1e-7;  // what was asked of numerator and denominator
  const Eigen::ArrayXd rho = spectrum(0.05, 0.3, 0.62, 1.0);
  for (const std::string& id : colour_instruments) {
    const Colorimeter meter = colorimeter(shipped_instrument(id));
    for (const std::string& geometry : meter.instrument().geometries) {
      const ColourReading reading = meter.read(lambertian(grid, rho), geometry, asked);
      EXPECT_LT((reading.radiance_factor - rho).abs().maxCoeff(), rounding)
          << id << " " << geometry;
      EXPECT_LE(reading.quadrature_error, 2.0 * asked) << id << " " << geometry;
    }
  }
}

TEST(Colorimeter, SeesNothingOfAMirrorAwayFromItsDirection) {
  const Surface mirror = smooth(grid, 1.0);
  for (const std::string id : {"colorimeter_45_0", "multi_angle_45"}) {
    const Colorimeter meter = colorimeter(shipped_instrument(id));
    for (const std::string& geometry : meter.instrument().geometries) {
      EXPECT_EQ(mean_factor(meter, mirror, geometry), 0.0) << id << " " << geometry;
    }
  }
  const Colorimeter sphere = colorimeter(shipped_instrument("sphere_8_d"));
  EXPECT_TRUE(is_close(mean_factor(sphere, mirror, "8_di"), 1.0, asked));
  EXPECT_TRUE(is_close(mean_factor(sphere, mirror, "8_de"), 0.0, asked));
}

// What a coat reflects at its interface is in the one reading and not in the other. The rest of the
// difference: under the coat light leaves less evenly than from a diffuser, so that the trap, of
// share sin^2(6 deg) = 0.011, loses up to a tenth more of it.
TEST(Sphere, DiffersByTheInterfaceWithAndWithoutTheSpecularPart) {
  constexpr double trap = 1.1e-3;
  const Eigen::ArrayXd n = Eigen::ArrayXd::Constant(grid.size(), 1.5);
  const Surface coat = coated(grid, spectrum(0.1, 0.3, 0.6, 0.9), n, 0.0);
  const Colorimeter meter = colorimeter(shipped_instrument("sphere_8_d"));
  const Eigen::ArrayXd included = meter.read(coat, "8_di", asked).radiance_factor;
  const Eigen::ArrayXd excluded = meter.read(coat, "8_de", asked).radiance_factor;
  const double interface = fresnel_reflectance(std::cos(degrees(8).radians()), 1.5);
  for (Eigen::Index l = 0; l < grid.size(); ++l) {
    EXPECT_TRUE(is_close(included(l) - excluded(l), interface, trap)) << l;
  }
}

// Without the trap's loss, and with a beam without extent: Fresnel's reflectance itself.
TEST(Sphere, ReadsFresnelsReflectanceOfAGlass) {
  constexpr double rounding = 1e-9;
  const Instrument thin = instrument_of(
      "built_to: cie_15/2004\ngeometries: [\"8_di\"]\n"
      "as_built: {\"8_di\": {source: {diameter: 0 deg}}}\n");
  const Surface glass = smooth(grid, Eigen::ArrayXcd::Constant(grid.size(), 1.5));
  EXPECT_TRUE(is_close(mean_factor(colorimeter(thin), glass, "8_di"),
                       fresnel_reflectance(std::cos(degrees(8).radians()), 1.5), rounding));
}

// The reflectance of a beam is that of its axis to second order in its width.
TEST(Sphere, AveragesOverItsBeam) {
  constexpr double share = 2e-3;
  const Surface coat =
      coated(grid, spectrum(0.1, 0.3, 0.6, 0.9), Eigen::ArrayXd::Constant(grid.size(), 1.5), 0.0);
  const Colorimeter wide = colorimeter(shipped_instrument("sphere_8_d"));
  const Colorimeter thin =
      colorimeter(instrument_of("built_to: cie_15/2004\ngeometries: [\"8_di\"]\n"
                                "as_built: {\"8_di\": {source: {diameter: 0 deg}}}\n"));
  const double at_axis = mean_factor(thin, coat, "8_di");
  EXPECT_NE(mean_factor(wide, coat, "8_di"), at_axis);
  EXPECT_TRUE(is_close(mean_factor(wide, coat, "8_di"), at_axis, share * at_axis));
}

TEST(AspecularAngle, IsPositiveTowardsTheNormal) {
  constexpr double rounding = 1e-12;
  const Standard standard = test::shipped_standard("din_6175_2/2001");
  const auto at = [&](const std::string& id) {
    return aspecular_angle(standard.geometry(id))->degrees();
  };
  EXPECT_NEAR(at("45_as15"), 15.0, rounding);
  EXPECT_NEAR(at("45_as110"), 110.0, rounding);
  // 15 deg from the mirror direction of 45 deg towards the normal is 30 deg from it; 110 deg lies
  // on the side of the source.
  EXPECT_NEAR(standard.geometry("45_as15").receptor_angle().degrees(), 30.0, rounding);
  EXPECT_NEAR(standard.geometry("45_as45").receptor_angle().degrees(), 0.0, rounding);
  EXPECT_NEAR(standard.geometry("45_as110").receptor_angle().degrees(), -65.0, rounding);
  EXPECT_FALSE(aspecular_angle(test::shipped_standard("cie_15/2004").geometry("8_di")));
}

TEST(MultiAngle, SeesAGlossyLobeBrighterTheNearerToItsMirrorDirection) {
  const Surface paint =
      cook_torrance(grid, 0.25, Eigen::ArrayXcd::Constant(grid.size(), std::complex(1.4, 5.0)));
  const Colorimeter meter = colorimeter(shipped_instrument("multi_angle_45"));
  double last = std::numeric_limits<double>::infinity();
  for (const std::string& geometry : meter.instrument().geometries) {
    const double factor = mean_factor(meter, paint, geometry);
    EXPECT_LT(factor, last) << geometry;
    last = factor;
  }
}

TEST(Colorimeter, RefusesAGlossmeterAndAGlossmeterRefusesIt) {
  EXPECT_EQ(message_of([] { (void)colorimeter(shipped_instrument("triangle_gloss")); }),
            "expected an instrument that measures colour, found 'triangle_gloss', which measures "
            "gloss by iso_2813/2014: see gonio measure");
  for (const std::string& id : colour_instruments) {
    const Instrument instrument = shipped_instrument(id);
    EXPECT_EQ(message_of([&] {
                (void)Glossmeter(instrument, grid, std::make_shared<ApertureIntegrator>());
              }),
              "expected an instrument that measures gloss, found '" + id +
                  "', which measures colour by " + instrument.standard.id + ": see gonio colour");
  }
}

TEST(Colorimeter, NamesTheApertureThatIsNotKnown) {
  const Colorimeter meter = colorimeter(instrument_of("built_to: din_6175_2/2001\n"));
  EXPECT_THAT(message_of([&] { (void)mean_factor(meter, smooth(grid, 1.0), "45_as15"); }),
              testing::HasSubstr("source.diameter: expected a number, to measure in this geometry, "
                                 "found 'unknown'"));
  const Colorimeter sphere = colorimeter(instrument_of("built_to: cie_15/2004\n"));
  EXPECT_THAT(message_of([&] { (void)mean_factor(sphere, smooth(grid, 1.0), "8_de"); }),
              testing::HasSubstr("receptor.trap: expected a number"));
}

}  // namespace
}  // namespace gonio
