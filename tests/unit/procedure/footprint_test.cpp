#include "emulator/procedure/footprint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "emulator/instrument/setup.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/laboratory.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::shipped_standard;

/// Angles go through a tangent and back.
constexpr double rounding_deg = 1e-9;

const WavelengthGrid few_wavelengths(nanometres(500), nanometres(50), 3);

Sample sample_of(Surface surface) {
  return {.file = {}, .id = "mine", .title = "Mine", .surface = std::move(surface)};
}

Sample semi_gloss() {
  return sample_of(
      cook_torrance(few_wavelengths, 0.03, Eigen::ArrayXcd::Constant(few_wavelengths.size(), 1.5)));
}

Sample white() {
  return sample_of(lambertian(few_wavelengths, Eigen::ArrayXd::Ones(few_wavelengths.size())));
}

Instrument nominal() { return nominal_instrument(shipped_standard("iso_2813/2014")); }

const FootprintOutline& outline(const Footprint& footprint, const std::string& title) {
  const auto found = std::ranges::find(footprint.outlines, title, &FootprintOutline::title);
  if (found == footprint.outlines.end()) {
    throw std::invalid_argument("no outline " + title);
  }
  return *found;
}

testing::AssertionResult spans(const std::vector<double>& angles_deg, double low, double high) {
  const auto [least, most] = std::ranges::minmax(angles_deg);
  const auto result = is_close(least, low, rounding_deg);
  return result ? is_close(most, high, rounding_deg) : result;
}

TEST(FootprintOutlines, HaveTheSizesOfTheStandard) {
  struct Sizes {
    std::string geometry;
    double in_plane_deg, perpendicular_deg;
  };
  for (const Sizes& receptor :
       {Sizes{"20", 1.8, 3.6}, Sizes{"60", 4.4, 11.7}, Sizes{"85", 4.0, 6.0}}) {
    const Footprint seen = footprint(nominal(), receptor.geometry, white());
    ASSERT_EQ(seen.outlines.size(), 4u);
    for (const std::string by : {"as built", "by the standard"}) {
      const FootprintOutline& edge = outline(seen, "receptor " + by);
      EXPECT_TRUE(
          spans(edge.in_plane_deg, -0.5 * receptor.in_plane_deg, 0.5 * receptor.in_plane_deg));
      EXPECT_TRUE(spans(edge.perpendicular_deg, -0.5 * receptor.perpendicular_deg,
                        0.5 * receptor.perpendicular_deg));
      const FootprintOutline& image = outline(seen, "source image " + by);
      EXPECT_TRUE(spans(image.in_plane_deg, -0.375, 0.375));
      EXPECT_TRUE(spans(image.perpendicular_deg, -1.25, 1.25));
    }
  }
}

TEST(FootprintOutlines, AreClosed) {
  const Footprint seen = footprint(nominal(), "60", white());
  for (const FootprintOutline& line : seen.outlines) {
    ASSERT_EQ(line.in_plane_deg.size(), 5u);
    ASSERT_EQ(line.perpendicular_deg.size(), 5u);
    EXPECT_EQ(line.in_plane_deg.front(), line.in_plane_deg.back());
    EXPECT_EQ(line.perpendicular_deg.front(), line.perpendicular_deg.back());
  }
}

TEST(FootprintOutlines, MoveWithTheReceptorAndWithTheImageOfTheSource) {
  Instrument off = with_quantity(nominal(), "60", SetupQuantity::theta_r, {degrees(60.2)});
  off = with_quantity(off, "20", SetupQuantity::theta_i, {degrees(19.7)});
  const Footprint at_60 = footprint(off, "60", white());
  EXPECT_TRUE(spans(outline(at_60, "receptor as built").in_plane_deg, -2.0, 2.4));
  EXPECT_TRUE(spans(outline(at_60, "receptor by the standard").in_plane_deg, -2.2, 2.2));
  EXPECT_TRUE(spans(outline(at_60, "source image as built").in_plane_deg, -0.375, 0.375));
  const Footprint at_20 = footprint(off, "20", white());
  EXPECT_TRUE(spans(outline(at_20, "receptor as built").in_plane_deg, -0.9, 0.9));
  EXPECT_TRUE(spans(outline(at_20, "source image as built").in_plane_deg, -0.675, 0.075));
}

TEST(FootprintOutlines, DrawACircleAsAPolygonOfItsDiameter) {
  Instrument round = nominal();
  round.as_built["60"].receptor.diameter = AngleAsBuilt{degrees(4.7)};
  const FootprintOutline edge = outline(footprint(round, "60", white()), "receptor as built");
  EXPECT_TRUE(spans(edge.in_plane_deg, -2.35, 2.35));
  EXPECT_TRUE(spans(edge.perpendicular_deg, -2.35, 2.35));
  const double radius = std::tan(degrees(2.35).radians());
  for (std::size_t i = 0; i < edge.in_plane_deg.size(); ++i) {
    const double u = std::tan(degrees(edge.in_plane_deg[i]).radians());
    const double v = std::tan(degrees(edge.perpendicular_deg[i]).radians());
    EXPECT_TRUE(is_close(std::hypot(u, v), radius, 1e-12));
  }
}

TEST(FootprintOutlines, AreOnlyThoseAsBuiltWhereTheStandardLeavesASizeUnknown) {
  Instrument paper = nominal_instrument(shipped_standard("tappi_t480/om_15"));
  ASSERT_THROW((void)footprint(paper, "75", white()), InputError);
  paper.as_built["75"].receptor.diameter = AngleAsBuilt{degrees(5)};
  paper.as_built["75"].source.diameter = AngleAsBuilt{degrees(1)};
  EXPECT_EQ(footprint(paper, "75", white()).outlines.size(), 2u);
}

TEST(FootprintRadiance, FillsAWindowRoundAllOutlines) {
  const Footprint seen = footprint(nominal(), "20", white());
  EXPECT_EQ(seen.in_plane_deg.size(), 61u);
  EXPECT_EQ(seen.perpendicular_deg.size(), 41u);
  EXPECT_EQ(seen.radiance.size(), 61u * 41u);
  EXPECT_TRUE(spans(seen.in_plane_deg, -1.125, 1.125));
  EXPECT_TRUE(spans(seen.perpendicular_deg, -2.25, 2.25));
}

TEST(FootprintRadiance, HasItsMaximumOneNearTheMirrorDirection) {
  const Footprint seen = footprint(nominal(), "20", semi_gloss());
  const auto peak = std::ranges::max_element(seen.radiance);
  EXPECT_EQ(*peak, 1.0);
  const auto at = std::size_t(peak - seen.radiance.begin());
  const double step_deg = seen.in_plane_deg[1] - seen.in_plane_deg[0];
  EXPECT_LE(std::abs(seen.in_plane_deg[at % 61]), 2.0 * step_deg);
  EXPECT_EQ(seen.perpendicular_deg[at / 61], 0.0);
}

TEST(FootprintRadiance, IsTheSameOnBothSidesOfThePlaneOfMeasurement) {
  constexpr double tolerance = 2e-4;  // twice what the integrator is asked for
  for (const std::string geometry : {"20", "60", "85"}) {
    const Footprint seen = footprint(nominal(), geometry, semi_gloss());
    for (std::size_t row = 0; row < 41; ++row) {
      for (std::size_t column = 0; column < 61; ++column) {
        EXPECT_TRUE(is_close(seen.radiance[row * 61 + column],
                             seen.radiance[(40 - row) * 61 + column], tolerance));
      }
    }
  }
}

TEST(FootprintRadiance, OfAWhiteDiffuserIsTheCosineOfTheDirection) {
  constexpr double tolerance = 2e-4;  // twice what the integrator is asked for
  const Footprint seen = footprint(nominal(), "85", white());
  const auto cosine = [&](std::size_t at) {
    const double u = std::tan(degrees(seen.in_plane_deg[at % 61]).radians());
    const double v = std::tan(degrees(seen.perpendicular_deg[at / 61]).radians());
    const double theta = degrees(85).radians();
    return std::max(0.0, (std::cos(theta) - u * std::sin(theta)) / std::hypot(1.0, u, v));
  };
  const double most = cosine(20 * 61);
  for (std::size_t at = 0; at < seen.radiance.size(); ++at) {
    EXPECT_TRUE(is_close(seen.radiance[at], cosine(at) / most, tolerance)) << at;
  }
}

TEST(FootprintRadiance, OfAPointSourceIsTheBrdfTimesTheCosine) {
  constexpr double tolerance = 2e-4;  // twice what the integrator is asked for
  Instrument collimated_one =
      with_quantity(nominal(), "60", SetupQuantity::source_in_plane, {degrees(0)});
  collimated_one =
      with_quantity(collimated_one, "60", SetupQuantity::source_perpendicular, {degrees(0)});
  const Sample sample = semi_gloss();
  const Footprint seen = footprint(collimated_one, "60", sample);
  const Frame plane = receptor_frame(degrees(60));
  std::vector<double> expected;
  for (const double v_deg : seen.perpendicular_deg) {
    for (const double u_deg : seen.in_plane_deg) {
      const Vector3 omega_r =
          plane.direction(std::tan(degrees(u_deg).radians()), std::tan(degrees(v_deg).radians()));
      expected.push_back(sample.surface.brdf(source_frame(degrees(60)).axis, omega_r)(0) *
                         omega_r.z());
    }
  }
  const double most = std::ranges::max(expected);
  for (std::size_t at = 0; at < expected.size(); ++at) {
    EXPECT_TRUE(is_close(seen.radiance[at], expected[at] / most, tolerance)) << at;
  }
}

TEST(FootprintRadiance, MovesByTwiceTheTiltOfTheSample) {
  Sample sample = semi_gloss();
  const Footprint flat = footprint(nominal(), "20", sample);
  const double step_deg = flat.in_plane_deg[1] - flat.in_plane_deg[0];
  sample.tilt = degrees(5.0 * step_deg);
  const Footprint tilted = footprint(nominal(), "20", sample);
  const auto peak_column = [](const Footprint& seen) {
    return (std::ranges::max_element(seen.radiance) - seen.radiance.begin()) % 61;
  };
  EXPECT_NEAR(double(peak_column(tilted) - peak_column(flat)), 10.0, 1.0);
}

TEST(Footprint, NeedsALobeAndAGeometryThatTheInstrumentHas) {
  EXPECT_THROW((void)footprint(nominal(), "60", sample_of(smooth(few_wavelengths, 1.0))),
               std::invalid_argument);
  EXPECT_THROW((void)footprint(nominal(), "45", white()), std::out_of_range);
}

}  // namespace
}  // namespace gonio
