#include "emulator/measured/incidence_frame.hpp"

#include <gtest/gtest.h>

#include "emulator/measured/bracket.hpp"
#include "tests/unit/measured/measured_fixture.hpp"

namespace gonio::test {
namespace {

constexpr double rounding = 1e-14;

TEST(IncidenceFrame, HasLightFromAzimuthPi) {
  for (const double phi : {180.0, 250.0, 0.0, 90.0}) {
    const Vector3 omega_i = direction_at(35.0, phi);
    const IncidenceFrame frame(omega_i);
    const Vector3 local = frame.local(omega_i.x(), omega_i.y(), omega_i.z());
    EXPECT_LT((local - local_incidence(degrees(35.0).radians())).norm(), rounding) << phi;
    EXPECT_NEAR(frame.rotation(), in_one_turn(degrees(phi - 180.0).radians()), rounding) << phi;
  }
  EXPECT_EQ(IncidenceFrame({0, 0, 1}).rotation(), 0.0);
}

TEST(IncidenceFrame, MovesALobeWithItsMirrorDirection) {
  const double theta_i = degrees(40.0).radians(), other = degrees(55.0).radians();
  const Vector3 moved = moved_with_lobe(mirrored(local_incidence(theta_i)), theta_i, other);
  EXPECT_LT((moved - mirrored(local_incidence(other))).norm(), rounding);
  const Vector3 omega_r = direction_at(20.0, 70.0);
  EXPECT_LT((moved_with_lobe(omega_r, theta_i, theta_i) - omega_r).norm(), rounding);
}

}  // namespace
}  // namespace gonio::test
