#include "emulator/goniometry/goniometer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace gonio {
namespace {

constexpr double rounding = 1e-14;

TEST(FrameTowards, IsThatOfTheReceptorInThePlaneOfMeasurement) {
  for (const double theta_deg : {0.0, 20.0, 85.0}) {
    const Frame frame = frame_towards(degrees(theta_deg), degrees(0));
    const Frame expected = receptor_frame(degrees(theta_deg));
    EXPECT_EQ(frame.axis, expected.axis);
    EXPECT_EQ(frame.u, expected.u);
    EXPECT_EQ(frame.v, expected.v);
    EXPECT_EQ(frame_towards(degrees(theta_deg), degrees(180)).axis,
              source_frame(degrees(theta_deg)).axis);
  }
}

TEST(FrameTowards, IsRightAngledAtAnyAzimuth) {
  const Frame frame = frame_towards(degrees(37), degrees(-124));
  EXPECT_NEAR(frame.axis.cross(frame.u).dot(frame.v), 1.0, rounding);
  EXPECT_NEAR(frame.axis.norm(), 1.0, rounding);
  EXPECT_NEAR(frame.u.dot(frame.v), 0.0, rounding);
  EXPECT_LT(frame.u.z(), 0.0);
}

TEST(ScanPosition, SeesASampleThatTurnsUnderBothArms) {
  const ScanPosition position{.theta_i = degrees(30),
                              .theta_r = degrees(45),
                              .phi_r = degrees(10),
                              .rotation = degrees(25)};
  EXPECT_NEAR(position.azimuth_i().degrees(), 155.0, 1e-9);
  EXPECT_NEAR(position.azimuth_r().degrees(), 345.0, 1e-9);
}

TEST(ScanPosition, PastTheNormalIsTheOtherSideOfIt) {
  const ScanPosition past{.theta_i = degrees(30), .theta_r = degrees(-45)};
  const ScanPosition other{.theta_i = degrees(30), .theta_r = degrees(45), .phi_r = degrees(180)};
  EXPECT_EQ(past.azimuth_r(), other.azimuth_r());
  EXPECT_NEAR(past.between_heads().degrees(), 15.0, 1e-9);
  EXPECT_NEAR(other.between_heads().degrees(), 15.0, 1e-9);
}

TEST(Exchanged, PutsEachArmWhereTheOtherWas) {
  for (const double theta_r_deg : {50.0, -50.0}) {
    for (const double phi_deg : {0.0, 33.0, -120.0}) {
      for (const double rotation_deg : {0.0, 70.0}) {
        const ScanPosition position{.theta_i = degrees(20),
                                    .theta_r = degrees(theta_r_deg),
                                    .phi_r = degrees(phi_deg),
                                    .rotation = degrees(rotation_deg)};
        const ScanOpening opening{.in_plane = degrees(2), .perpendicular = degrees(2)};
        const MeasuringGeometry before = scan_geometry(position, opening, opening);
        const MeasuringGeometry after = scan_geometry(exchanged(position), opening, opening);
        EXPECT_LT((before.source.frame().axis - after.receptor.frame().axis).norm(), 1e-9);
        EXPECT_LT((before.receptor.frame().axis - after.source.frame().axis).norm(), 1e-9);
      }
    }
  }
}

TEST(ScanGeometry, IsSymmetricInThePlaneOfMeasurementAlone) {
  const ScanOpening opening{.in_plane = degrees(4.7), .perpendicular = degrees(4.7)};
  ScanPosition position{.theta_i = degrees(60), .theta_r = degrees(-30)};
  EXPECT_TRUE(scan_geometry(position, opening, opening).source.is_symmetric());
  EXPECT_TRUE(scan_geometry(position, opening, opening).receptor.is_symmetric());
  position.phi_r = degrees(5);
  EXPECT_FALSE(scan_geometry(position, opening, opening).receptor.is_symmetric());
}

}  // namespace
}  // namespace gonio
