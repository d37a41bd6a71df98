#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/integration/gauss_rule.hpp"
#include "tests/unit/integration/glossmeter.hpp"

// A smooth sample tilted by t turns the source image by 2 t in the plane of measurement. The edges
// of source and receptor across that plane stay planes through the y axis, so that what is clipped
// follows from angles in the plane alone.

namespace gonio {
namespace {

using test::is_close_relative;
using test::ReceptorSize;

constexpr double rounding = 1e-12;  // relative

MeasuringGeometry tilted(const MeasuringGeometry& geometry, double tilt_deg) {
  return {geometry.source.seen_by_tilted(degrees(tilt_deg)),
          geometry.receptor.seen_by_tilted(degrees(tilt_deg))};
}

/// Half of what the receptor is wider than the source image, as a tilt of the sample [deg].
double clearance_deg(const ReceptorSize& receptor) {
  return 0.5 * 0.5 * (receptor.in_plane_deg - test::source_in_plane_deg);
}

/// Flux that a mirror of reflectance rho(cos theta_i) sends from the part of the source image
/// between two angles from its axis in the plane of measurement [deg].
template <class Reflectance>
double flux_between(double theta_deg, double low_deg, double high_deg, Reflectance rho) {
  const test::GaussRule rule(30);
  const Frame frame = source_frame(degrees(theta_deg));
  const double half_v = std::tan(0.5 * degrees(test::source_perpendicular_deg).radians());
  return rule.integral(std::tan(degrees(low_deg).radians()), std::tan(degrees(high_deg).radians()),
                       [&](double u) {
                         return rule.integral(-half_v, half_v, [&](double v) {
                           const double c = frame.direction(u, v).z();
                           return rho(c) * c * std::pow(1.0 + u * u + v * v, -1.5);
                         });
                       });
}

TEST(TiltedMirror, KeepsItsWholeSignalUpToTheClearanceOfTheReceptor) {
  constexpr double tolerance = 1e-15;
  const Surface mirror = smooth(test::one_wavelength, 1.0);
  const std::vector<double> expected_clearance{0.2625, 0.9125, 0.8125};
  for (std::size_t i = 0; i < 3; ++i) {
    const ReceptorSize& receptor = test::iso_receptors[i];
    const double clearance = clearance_deg(receptor);
    EXPECT_DOUBLE_EQ(clearance, expected_clearance[i]);
    for (const double share : {-0.9999, -0.5, 0.0, 0.5, 0.9999}) {
      const auto geometry = tilted(test::glossmeter(receptor.theta_deg), share * clearance);
      EXPECT_TRUE(is_close_relative(test::flux_of(mirror, geometry, tolerance),
                                    ApertureIntegrator().incident(geometry.source), rounding))
          << receptor.theta_deg << " deg, tilt " << share * clearance << " deg";
    }
    for (const double share : {-1.01, 1.01}) {
      const auto geometry = tilted(test::glossmeter(receptor.theta_deg), share * clearance);
      EXPECT_LT(test::flux_of(mirror, geometry, tolerance),
                (1.0 - 1e-4) * ApertureIntegrator().incident(geometry.source))
          << receptor.theta_deg << " deg, tilt " << share * clearance << " deg";
    }
  }
}

TEST(TiltedGlass, LosesBeyondTheClearanceWhatTheReceptorClips) {
  constexpr double tolerance = 1e-15;
  const Surface glass = smooth(test::one_wavelength, test::constant_index(1.567));
  const auto rho = [](double c) { return fresnel_reflectance(c, 1.567); };
  for (const ReceptorSize& receptor : test::iso_receptors) {
    const double source_half = 0.5 * test::source_in_plane_deg;
    const double receptor_half = 0.5 * receptor.in_plane_deg;
    for (const double beyond_deg : {-0.1, 0.02, 0.1, 0.2, 0.3, 0.36}) {
      for (const double sign : {-1.0, 1.0}) {
        const double tilt = sign * (clearance_deg(receptor) + beyond_deg);
        // Seen from the tilted sample the source is at theta + t; its mirror image at theta + t
        // too, and the receptor at theta - t.
        const double low = std::max(-source_half, -2.0 * tilt - receptor_half);
        const double high = std::min(source_half, -2.0 * tilt + receptor_half);
        const double expected = flux_between(receptor.theta_deg + tilt, low, high, rho);
        const double got =
            test::flux_of(glass, tilted(test::glossmeter(receptor.theta_deg), tilt), tolerance);
        EXPECT_TRUE(is_close_relative(got, expected, 1e-10))
            << receptor.theta_deg << " deg, tilt " << tilt << " deg";
      }
    }
  }
}

TEST(TiltedGlass, IsDarkWhereTheImageMissesTheReceptor) {
  const Surface glass = smooth(test::one_wavelength, test::constant_index(1.567));
  for (const ReceptorSize& receptor : test::iso_receptors) {
    const double miss = clearance_deg(receptor) + 0.5 * test::source_in_plane_deg + 1e-3;
    for (const double sign : {-1.0, 1.0}) {
      const auto geometry = tilted(test::glossmeter(receptor.theta_deg), sign * miss);
      EXPECT_EQ(test::flux_of(glass, geometry, 1e-12), 0.0) << receptor.theta_deg;
    }
  }
}

TEST(TiltedGlass, LosesACollimatedBeamAtTheEdgeOfTheReceptor) {
  const Surface glass = smooth(test::one_wavelength, test::constant_index(1.567));
  for (const ReceptorSize& receptor : test::iso_receptors) {
    const auto flux = [&](double tilt_deg) {
      return test::flux_of(glass, tilted(test::collimated_glossmeter(receptor.theta_deg), tilt_deg),
                           1e-12);
    };
    const double edge = 0.25 * receptor.in_plane_deg;
    EXPECT_GT(flux(0.9999 * edge), 0.0) << receptor.theta_deg;
    EXPECT_EQ(flux(1.0001 * edge), 0.0) << receptor.theta_deg;
  }
}

TEST(MirrorInACircularReceptor, FillsTheOverlapOfBothCones) {
  // Small cones: the overlap of two circles in the plane, to the square of their radius.
  constexpr double source_deg = 0.04;
  constexpr double receptor_deg = 0.06;
  constexpr double flatness = 1e-5;
  const Surface mirror = smooth(test::one_wavelength, 1.0);
  const double a = 0.5 * source_deg;
  const double b = 0.5 * receptor_deg;
  for (const double distance : {0.005, 0.015, 0.03, 0.045}) {
    const Aperture source = Aperture::circle(source_frame(degrees(20)), degrees(source_deg));
    const Aperture receptor =
        Aperture::circle(receptor_frame(degrees(20 + distance)), degrees(receptor_deg));
    const double to_chord_a = (distance * distance + a * a - b * b) / (2.0 * distance);
    const double to_chord_b = distance - to_chord_a;
    const auto segment = [](double radius, double x) {
      x = std::clamp(x, -radius, radius);
      return radius * radius * std::acos(x / radius) - x * std::sqrt(radius * radius - x * x);
    };
    const double overlap = distance <= b - a ? a * a * std::acos(-1.0)
                                             : segment(a, to_chord_a) + segment(b, to_chord_b);
    const double expected =
        overlap * std::pow(degrees(1).radians(), 2) * std::cos(degrees(20).radians());
    // cos theta_i changes by 3e-4 over the source, and its mean over the overlap with it.
    EXPECT_TRUE(is_close_relative(test::flux_of(mirror, {source, receptor}, 1e-16), expected,
                                  flatness + 2e-4))
        << distance;
  }
}

}  // namespace
}  // namespace gonio
