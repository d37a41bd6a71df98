#include "emulator/procedure/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>

#include "emulator/instrument/setup.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/laboratory.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::message_of;
using test::shipped_sample;
using test::shipped_standard;

const WavelengthGrid grid(nanometres(400), nanometres(50), 8);

/// A slit as wide as the source image of ISO 2813.
ProfileSetup iso_setup() {
  ProfileSetup setup;
  setup.source_in_plane = degrees(0.75);
  return setup;
}

Profile profile_of(const Surface& surface, const ProfileSetup& setup, Angle tilt = {}) {
  const ProfileScale scale = profile_scale(shipped_standard("iso_2813/2014"), grid);
  return measure_profile(surface, setup, scale.weight, ApertureIntegrator(), tilt);
}

Surface coat(double rms_slope) {
  return cook_torrance(grid, rms_slope, Eigen::ArrayXcd::Constant(grid.size(), 1.5));
}

TEST(MeasureProfile, AddsUpToTheGlossOfTheReceptor) {
  constexpr double share = 1e-3;
  const Standard standard = shipped_standard("iso_2813/2014");
  const Glossmeter meter(nominal_instrument(standard), grid,
                         std::make_shared<ApertureIntegrator>());
  const Profile reference = profile_of(profile_scale(standard, grid).reference, iso_setup());
  for (const double rms_slope : {0.005, 0.02, 0.1}) {
    const Surface surface = coat(rms_slope);
    const ProfileQuantity gloss = profile_gloss(profile_of(surface, iso_setup()), reference,
                                                standard, standard.geometry("20"));
    const double expected = meter.read(surface, "20", 1e-6).gloss;
    EXPECT_TRUE(is_close(gloss.value.value(), expected, share * expected)) << rms_slope;
    EXPECT_EQ(gloss.id, "gloss_20");
  }
}

TEST(MeasureProfile, OfAMirrorIsTheImageOfTheSlit) {
  constexpr double rounding = 1e-9;
  const Profile profile = profile_of(smooth(grid, 1.0), ProfileSetup());
  const double edge = degrees(0.01).radians();
  EXPECT_EQ(profile.flux.size(), 512);
  EXPECT_NEAR(profile.flux.sum(), 1.0, rounding);
  const double all = profile.between(-3.0 * edge, 3.0 * edge);
  EXPECT_NEAR(all, 1.0, rounding);
  EXPECT_NEAR(profile.flux(255), profile.flux(256), 1e-4);
}

// A mirror turned towards the receptor turns the image away from the normal, by twice as much.
TEST(MeasureProfile, OfATiltedMirrorIsShiftedByTwiceTheTilt) {
  constexpr double rounding = 1e-9;
  const Profile profile = profile_of(smooth(grid, 1.0), ProfileSetup(), degrees(0.5));
  const double half = degrees(0.05).radians();
  const double shift = degrees(1.0).radians();
  EXPECT_NEAR(profile.between(shift - half, shift + half), 1.0, rounding);
  EXPECT_EQ(profile.between(-half, half), 0.0);
}

TEST(MeasureProfile, BecomesWiderWithTheSlopes) {
  double last = 1.0;
  for (const double rms_slope : {0.002, 0.005, 0.01, 0.03}) {
    const Profile profile = profile_of(coat(rms_slope), ProfileSetup());
    const double half = degrees(0.3).radians();
    const double share = profile.between(-half, half) / profile.flux.sum();
    EXPECT_LT(share, last) << rms_slope;
    last = share;
  }
}

TEST(MeasureProfile, RefusesARowBeyondTheHorizonOrOfTooManyElements) {
  ProfileSetup setup;
  setup.theta_i = degrees(85);
  EXPECT_EQ(message_of([&] { (void)profile_of(coat(0.1), setup); }),
            "profile: expected a row that ends before 90 deg, found one up to 92.25 deg");
  setup = {};
  setup.step = degrees(1e-5);
  EXPECT_THROW((void)profile_of(coat(0.1), setup), std::domain_error);
  setup.step = degrees(20);
  EXPECT_THROW((void)profile_of(coat(0.1), setup), std::domain_error);
}

TEST(ProfileBetween, TakesSharesOfElementsThatAreCut) {
  Profile profile{.edge_rad = Eigen::ArrayXd::LinSpaced(4, -1.5, 1.5),
                  .flux = (Eigen::ArrayXd(3) << 1.0, 2.0, 4.0).finished()};
  EXPECT_DOUBLE_EQ(profile.between(-1.5, 1.5), 7.0);
  EXPECT_DOUBLE_EQ(profile.between(-1.0, 0.0), 0.5 + 1.0);
  EXPECT_DOUBLE_EQ(profile.between(1.0, 9.0), 2.0);
  EXPECT_DOUBLE_EQ(profile.between(0.1, 0.2), 0.2);
  EXPECT_TRUE(profile.covers(-1.5, 1.5));
  EXPECT_FALSE(profile.covers(-1.6, 1.5));
}

TEST(ProfileScale, NeedsAReferenceGlass) {
  EXPECT_EQ(message_of([] { (void)profile_scale(shipped_standard("astm_c346/87"), grid); }),
            "expected a standard with a reference glass, found 'astm_c346/87'");
}

}  // namespace
}  // namespace gonio
