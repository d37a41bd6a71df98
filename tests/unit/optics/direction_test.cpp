#include "emulator/optics/direction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace gonio {
namespace {

constexpr double rounding = 1e-15;
const std::vector<double> angles_deg = {-90.0, -20.0, 0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 90.0};

void expect_same(const Vector3& got, const Vector3& expected) {
  EXPECT_LT((got - expected).norm(), 2.0 * rounding)
      << got.transpose() << " instead of " << expected.transpose();
}

TEST(Frame, HasThreeUnitVectorsAtRightAngles) {
  for (const double angle : angles_deg) {
    for (const Frame& frame : {source_frame(degrees(angle)), receptor_frame(degrees(angle)),
                               receptor_frame(degrees(angle)).turned_about_y(degrees(7))}) {
      EXPECT_NEAR(frame.axis.norm(), 1.0, rounding);
      EXPECT_NEAR(frame.u.norm(), 1.0, rounding);
      EXPECT_NEAR(frame.v.norm(), 1.0, rounding);
      EXPECT_NEAR(frame.axis.dot(frame.u), 0.0, rounding);
      EXPECT_NEAR(frame.axis.dot(frame.v), 0.0, rounding);
      EXPECT_NEAR(frame.u.dot(frame.v), 0.0, rounding);
    }
  }
}

TEST(Frame, LooksToTheSourceAtNegativeAndTheReceptorAtPositiveX) {
  for (const double angle : angles_deg) {
    const double s = std::sin(degrees(angle).radians());
    const double c = std::cos(degrees(angle).radians());
    expect_same(source_frame(degrees(angle)).axis, {-s, 0.0, c});
    expect_same(receptor_frame(degrees(angle)).axis, {s, 0.0, c});
  }
}

TEST(Frame, GrowsInThetaAlongU) {
  for (const double angle : {20.0, 60.0, 85.0}) {
    for (const double step : {-0.1, 0.05}) {
      const double expected = degrees(angle).radians() + std::atan(step);
      const Vector3 source = source_frame(degrees(angle)).direction(step, 0.0);
      const Vector3 receptor = receptor_frame(degrees(angle)).direction(step, 0.0);
      EXPECT_NEAR(std::atan2(-source.x(), source.z()), expected, rounding);
      EXPECT_NEAR(std::atan2(receptor.x(), receptor.z()), expected, rounding);
    }
  }
}

TEST(Frame, GivesTheDirectionThroughAPointOfItsTangentPlane) {
  const Frame frame = receptor_frame(degrees(60));
  expect_same(frame.direction(0.0, 0.0), frame.axis);
  const Vector3 omega = frame.direction(0.3, -0.4);
  EXPECT_NEAR(omega.norm(), 1.0, rounding);
  EXPECT_NEAR(omega.dot(frame.u) / omega.dot(frame.axis), 0.3, rounding);
  EXPECT_NEAR(omega.dot(frame.v) / omega.dot(frame.axis), -0.4, rounding);
}

TEST(Frame, TurnsFromZTowardsX) {
  expect_same(receptor_frame(degrees(20)).turned_about_y(degrees(5)).axis,
              receptor_frame(degrees(25)).axis);
  expect_same(source_frame(degrees(20)).turned_about_y(degrees(5)).axis,
              source_frame(degrees(15)).axis);
}

TEST(Mirrored, SwapsSourceAndReceptor) {
  for (const double angle : angles_deg) {
    expect_same(mirrored(source_frame(degrees(angle)).axis), receptor_frame(degrees(angle)).axis);
  }
}

TEST(Mirrored, IsItsOwnInverseAndKeepsTheNormal) {
  const Vector3 omega = Vector3(0.3, -0.5, 0.2).normalized();
  EXPECT_EQ(mirrored(mirrored(omega)), omega);
  EXPECT_EQ(mirrored(Vector3(0, 0, 1)), Vector3(0, 0, 1));
}

TEST(Mirrored, HasTheNormalHalfWayToItsOriginal) {
  const Vector3 omega = Vector3(0.3, -0.5, 0.2).normalized();
  expect_same((omega + mirrored(omega)).normalized(), Vector3::UnitZ());
}

TEST(Mirrored, ActsOnAFrameDirectionByDirection) {
  const Frame frame = source_frame(degrees(60));
  for (const double u : {-0.2, 0.0, 0.1}) {
    for (const double v : {-0.1, 0.3}) {
      expect_same(mirrored(frame).direction(u, v), mirrored(frame.direction(u, v)));
    }
  }
}

TEST(DirectionBatch, HasOneLengthForAllItsComponents) {
  DirectionBatch batch;
  batch.resize(7);
  EXPECT_EQ(batch.size(), 7);
  EXPECT_EQ(batch.y.size(), 7);
  EXPECT_EQ(batch.z.size(), 7);
}

}  // namespace
}  // namespace gonio
