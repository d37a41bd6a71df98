#include "emulator/integration/aperture.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "emulator/integration/flux.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/integration/gauss_rule.hpp"
#include "tests/unit/integration/glossmeter.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using std::numbers::pi;
using test::is_close;

constexpr double rounding = 1e-14;

TEST(Aperture, HasTheSolidAnglesOfTheReceptorsOfIso2813) {
  constexpr double printed = 0.5e-8 * (1 + 1e-6);  // eight decimals
  const std::array<double, 3> solid_angle{0.00197352, 0.01565067, 0.00730600};
  const std::array<double, 3> projected{0.00185412, 0.00780985, 0.00063634};
  for (std::size_t i = 0; i < 3; ++i) {
    const Aperture receptor = test::receptor_of(test::iso_receptors[i]);
    EXPECT_TRUE(is_close(receptor.solid_angle(), solid_angle[i], printed)) << i;
    EXPECT_TRUE(is_close(ApertureIntegrator().incident(receptor), projected[i], printed)) << i;
  }
}

TEST(Aperture, HasTheSolidAngleOfItsRectangleInTheTangentPlane) {
  const test::GaussRule rule(40);
  for (const double width_deg : {0.1, 1.8, 11.7, 60.0}) {
    for (const double height_deg : {0.3, 3.6, 45.0}) {
      const double u = std::tan(0.5 * degrees(width_deg).radians());
      const double v = std::tan(0.5 * degrees(height_deg).radians());
      const double expected = rule.integral(-u, u, [&](double x) {
        return rule.integral(-v, v, [&](double y) { return std::pow(1.0 + x * x + y * y, -1.5); });
      });
      const Aperture aperture =
          Aperture::rectangle(receptor_frame(degrees(60)), degrees(width_deg), degrees(height_deg));
      EXPECT_TRUE(test::is_close_relative(aperture.solid_angle(), expected, 1e-12))
          << width_deg << " x " << height_deg << " deg";
    }
  }
}

TEST(Aperture, HasTheSolidAngleOfACone) {
  for (const double diameter_deg : {0.01, 1.0, 4.7, 30.0, 120.0}) {
    const double sine = std::sin(0.25 * degrees(diameter_deg).radians());
    const Aperture cone = Aperture::circle(receptor_frame(degrees(20)), degrees(diameter_deg));
    EXPECT_TRUE(test::is_close_relative(cone.solid_angle(), 4.0 * pi * sine * sine, rounding))
        << diameter_deg;
  }
}

TEST(Aperture, HasTheWidthsOfTable1OfAstmD523) {
  // "2 tan(theta / 2)" beside "theta, deg" of the source and the receptors.
  struct Row {
    double theta_deg, width;
  };
  constexpr double printed = 0.5e-4 * (1 + 1e-6);
  for (const Row& row : {Row{0.75, 0.0131}, Row{2.5, 0.0436}, Row{1.8, 0.0314}, Row{3.6, 0.0629},
                         Row{4.4, 0.0768}, Row{11.7, 0.2049}, Row{4.0, 0.0698}, Row{6.0, 0.1048}}) {
    const Aperture aperture =
        Aperture::rectangle(receptor_frame(degrees(60)), degrees(row.theta_deg), degrees(1));
    EXPECT_TRUE(is_close(aperture.u_high() - aperture.u_low(), row.width, printed))
        << row.theta_deg;
  }
}

TEST(Aperture, ContainsWhatIsWithinItsEdges) {
  constexpr double inside = 0.999999;
  constexpr double outside = 1.000001;
  const Aperture rectangle =
      Aperture::rectangle(receptor_frame(degrees(60)), degrees(4.4), degrees(11.7));
  const Aperture circle = Aperture::circle(receptor_frame(degrees(60)), degrees(4.7));
  const Frame& frame = rectangle.frame();
  const double u = rectangle.u_high();
  const double v = rectangle.v_high();
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      EXPECT_TRUE(rectangle.contains(frame.direction(s * inside * u, t * inside * v)));
      EXPECT_FALSE(rectangle.contains(frame.direction(s * outside * u, t * inside * v)));
      EXPECT_FALSE(rectangle.contains(frame.direction(s * inside * u, t * outside * v)));
    }
  }
  for (int a = 0; a < 12; ++a) {
    const double along = circle.u_high() * std::cos(pi * a / 6.0);
    const double across = circle.u_high() * std::sin(pi * a / 6.0);
    EXPECT_TRUE(circle.contains(frame.direction(inside * along, inside * across))) << a;
    EXPECT_FALSE(circle.contains(frame.direction(outside * along, outside * across))) << a;
  }
}

TEST(Aperture, DoesNotContainTheOppositeDirection) {
  const Aperture aperture =
      Aperture::rectangle(receptor_frame(degrees(60)), degrees(4), degrees(4));
  EXPECT_TRUE(aperture.contains(aperture.frame().axis));
  EXPECT_FALSE(aperture.contains(-aperture.frame().axis));
}

TEST(Aperture, OpensTheInPlaneAngleInThePlaneOfMeasurement) {
  const Aperture aperture =
      Aperture::rectangle(receptor_frame(degrees(60)), degrees(4.4), degrees(11.7));
  const Vector3 far = aperture.frame().direction(aperture.u_high(), 0.0);
  EXPECT_TRUE(is_close(radians(std::atan2(far.x(), far.z())).degrees(), 62.2, 1e-12));
  const Vector3 side = aperture.frame().direction(0.0, aperture.v_high());
  EXPECT_TRUE(is_close(radians(std::asin(side.y())).degrees(), 5.85, 1e-12));
}

TEST(Aperture, IsAsWideAsItsFarthestDirection) {
  const Aperture rectangle =
      Aperture::rectangle(receptor_frame(degrees(20)), degrees(10), degrees(24));
  const Vector3 corner = rectangle.frame().direction(rectangle.u_high(), rectangle.v_high());
  EXPECT_TRUE(is_close(std::cos(rectangle.radius().radians()), corner.dot(rectangle.frame().axis),
                       rounding));
  EXPECT_TRUE(is_close(Aperture::circle(receptor_frame(degrees(20)), degrees(7)).radius().degrees(),
                       3.5, 1e-12));
}

TEST(Aperture, IsDegenerateWithoutExtent) {
  const Frame frame = source_frame(degrees(60));
  EXPECT_TRUE(Aperture::rectangle(frame, degrees(0), degrees(2.5)).is_degenerate());
  EXPECT_TRUE(Aperture::rectangle(frame, degrees(0.75), degrees(0)).is_degenerate());
  EXPECT_TRUE(Aperture::circle(frame, degrees(0)).is_degenerate());
  EXPECT_TRUE(collimated(frame.axis).is_degenerate());
  EXPECT_EQ(collimated(frame.axis).solid_angle(), 0.0);
  EXPECT_EQ(collimated(frame.axis).frame().axis, frame.axis);
  EXPECT_FALSE(Aperture::rectangle(frame, degrees(0.75), degrees(2.5)).is_degenerate());
}

TEST(Aperture, SeenInTheMirrorHoldsTheMirroredDirections) {
  const Aperture source = test::source_image(60.0);
  const Aperture image = source.mirrored();
  EXPECT_EQ(image.solid_angle(), source.solid_angle());
  for (const double u : {-0.99, 0.3, 1.01}) {
    for (const double v : {-1.01, 0.5, 0.99}) {
      const Vector3 omega = source.frame().direction(u * source.u_high(), v * source.v_high());
      EXPECT_EQ(image.contains(mirrored(omega)), source.contains(omega)) << u << ", " << v;
    }
  }
}

TEST(Aperture, SeenByATiltedSampleTurnsAgainstIt) {
  const auto polar_deg = [](const Aperture& aperture) {
    const Vector3& axis = aperture.frame().axis;
    return radians(std::atan2(axis.x(), axis.z())).degrees();
  };
  const MeasuringGeometry geometry = test::glossmeter(60.0);
  EXPECT_TRUE(is_close(polar_deg(geometry.receptor.seen_by_tilted(degrees(0.3))), 59.7, 1e-12));
  EXPECT_TRUE(is_close(polar_deg(geometry.source.seen_by_tilted(degrees(0.3))), -60.3, 1e-12));
}

TEST(Aperture, RefusesAnOpeningOutsideItsRange) {
  const Frame frame = source_frame(degrees(60));
  for (const double bad : {-0.1, 120.1, std::nan("")}) {
    EXPECT_EQ(test::message_of([&] { (void)Aperture::rectangle(frame, degrees(bad), degrees(1)); }),
              "Aperture: an opening must be in [0, 120] deg, is " + std::to_string(bad));
    EXPECT_THROW((void)Aperture::rectangle(frame, degrees(1), degrees(bad)), std::domain_error);
    EXPECT_THROW((void)Aperture::circle(frame, degrees(bad)), std::domain_error);
  }
}

TEST(HemicubeFaces, CoverTheHemisphereOnce) {
  double sum = 0.0;
  for (const Aperture& face : hemicube_faces()) {
    sum += face.solid_angle();
  }
  EXPECT_TRUE(is_close(sum, 2.0 * pi, rounding));
  for (const double theta : {1.0, 20.0, 44.0, 60.0, 89.0}) {
    for (const double phi : {3.0, 50.0, 100.0, 190.0, 300.0}) {
      const double s = std::sin(degrees(theta).radians());
      const Vector3 omega(s * std::cos(degrees(phi).radians()),
                          s * std::sin(degrees(phi).radians()), std::cos(degrees(theta).radians()));
      int faces = 0;
      for (const Aperture& face : hemicube_faces()) {
        faces += face.contains(omega) ? 1 : 0;
      }
      EXPECT_EQ(faces, 1) << theta << ", " << phi;
    }
  }
}

TEST(HalfAngleRange, HoldsEveryPairOfDirections) {
  for (const double theta : {20.0, 60.0, 85.0}) {
    const MeasuringGeometry geometry = test::glossmeter(theta);
    const CosineRange range = half_angle_range(geometry);
    const auto corner = [](const Aperture& aperture, double u, double v) {
      return aperture.frame().direction(u * aperture.u_high(), v * aperture.v_high());
    };
    for (const double s : {-1.0, 0.0, 1.0}) {
      for (const double t : {-1.0, 0.0, 1.0}) {
        const Vector3 i = corner(geometry.source, s, t);
        for (const double u : {-1.0, 0.0, 1.0}) {
          const Vector3 r = corner(geometry.receptor, u, t);
          const double c = std::sqrt(0.5 * (1.0 + i.dot(r)));
          EXPECT_GE(c, range.low) << theta;
          EXPECT_LE(c, range.high) << theta;
        }
      }
    }
    EXPECT_GE(range.low, 0.0);
    EXPECT_LE(range.high, 1.0);
  }
}

}  // namespace
}  // namespace gonio
