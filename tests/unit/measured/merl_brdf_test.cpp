#include "emulator/measured/merl_brdf.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>

#include "emulator/core/input_error.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/brdf_at.hpp"
#include "tests/unit/measured/largest_allocation.hpp"
#include "tests/unit/measured/merl_file.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::span<const std::byte> as_span(const std::string& bytes) {
  return std::as_bytes(std::span(bytes.data(), bytes.size()));
}

BrdfFile parsed(const std::string& bytes) { return parse_merl(as_span(bytes), "m.binary"); }
std::string refusal(const std::string& bytes) {
  return message_of([&] { (void)parsed(bytes); });
}

double lambert(double /*theta_h*/, double /*theta_d*/, double /*phi_d*/, int channel) {
  return (0.2 + 0.3 * channel) / pi;
}

/// A lobe of Beckmann's over a diffuse part, with Schlick's reflectance and a factor that depends
/// on all three angles as shadowing does.
double lobe(double theta_h, double theta_d, double phi_d, int channel) {
  constexpr double m = 0.2;
  const double tan_h = std::tan(theta_h) / m;
  const double cos_h = std::cos(theta_h);
  const double beckmann = std::exp(-tan_h * tan_h) / (m * m * std::pow(cos_h, 4));
  const double schlick = 0.04 + 0.96 * std::pow(1.0 - std::cos(theta_d), 5);
  const double across = std::sin(theta_d) * std::sin(theta_h) * std::cos(phi_d);
  const double cosines = std::pow(std::cos(theta_d) * cos_h, 2) - across * across;
  return 0.1 * (channel + 1) / pi + beckmann * schlick / (1.0 + std::max(cosines, 0.0));
}

/// The lobe at a pair of directions, by way of the definition of the angles.
double lobe_at(const Vector3& omega_i, const Vector3& omega_r, int channel) {
  const Vector3 h = (omega_i + omega_r).normalized();
  const double theta_h = std::acos(h.z());
  const double phi_h = std::atan2(h.y(), h.x());
  const Eigen::AngleAxisd turn = Eigen::AngleAxisd(-theta_h, Vector3::UnitY());
  const Vector3 d = turn * (Eigen::AngleAxisd(-phi_h, Vector3::UnitZ()) * omega_i);
  return lobe(theta_h, std::acos(d.z()), std::atan2(d.y(), d.x()), channel);
}

/// The file in its real size, on a disk.
const BrdfFile& full_size_lobe() {
  static const TemporaryFolder folder;
  static const BrdfFile file = read_merl(folder.file("lobe.binary", merl_bytes(lobe)));
  return file;
}

constexpr int pairs = 2000;
constexpr unsigned seed = 11;

/// Random pairs of directions up to 75 deg.
template <class Use>
void for_pairs(const Use& use) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> theta_deg(0.0, 75.0);
  std::uniform_real_distribution<double> phi_deg(-180.0, 180.0);
  for (int i = 0; i < pairs; ++i) {
    const Vector3 omega_i = direction(theta_deg(random), phi_deg(random));
    use(omega_i, direction(theta_deg(random), phi_deg(random)));
  }
}

TEST(MerlBrdf, GivesALambertianSurfaceBack) {
  constexpr double rounding = 1e-6;  // numbers are held as floats
  const BrdfFile file = parsed(merl_bytes(lambert, {6, 6, 12}));
  EXPECT_EQ(file.format, BrdfFormat::merl);
  EXPECT_THAT(file.warnings, IsEmpty());
  for_pairs([&](const Vector3& omega_i, const Vector3& omega_r) {
    const Eigen::ArrayXd f_r = f_r_at(*file.brdf, omega_i, omega_r);
    for (int c = 0; c < 3; ++c) {
      ASSERT_TRUE(is_close_relative(f_r(c), lambert(0, 0, 0, c), rounding));
    }
  });
}

TEST(MerlBrdf, GivesALobeBackWithinTheErrorOfItsTable) {
  // Linear interpolation errs by h^2 f'' / 8: most in theta_h, 0.8 deg wide where the lobe of slope
  // 0.2 falls off, with f'' of up to (2 tan / m^2)^2 f = 600 f, and at grazing theta_d.
  constexpr double tolerance = 0.02;
  constexpr double mean_tolerance = 0.002;
  double sum = 0.0;
  for_pairs([&](const Vector3& omega_i, const Vector3& omega_r) {
    const Eigen::ArrayXd f_r = f_r_at(*full_size_lobe().brdf, omega_i, omega_r);
    for (int c = 0; c < 3; ++c) {
      const double expected = lobe_at(omega_i, omega_r, c);
      ASSERT_TRUE(is_close_relative(f_r(c), expected, tolerance));
      sum += std::abs(f_r(c) / expected - 1.0) / (3.0 * pairs);
    }
  });
  EXPECT_LT(sum, mean_tolerance);
}

TEST(MerlBrdf, IsReciprocal) {
  constexpr double rounding = 1e-5;
  for_pairs([&](const Vector3& omega_i, const Vector3& omega_r) {
    const MeasuredBrdf& brdf = *full_size_lobe().brdf;
    ASSERT_TRUE(is_close_relative(f_r_at(brdf, omega_i, omega_r)(1),
                                  f_r_at(brdf, omega_r, omega_i)(1), rounding));
  });
}

TEST(MerlBrdf, IsNothingBelowTheSurface) {
  const BrdfFile file = parsed(merl_bytes(lambert, {6, 6, 12}));
  EXPECT_EQ(f_r_at(*file.brdf, direction(91, 180), direction(10, 0)).maxCoeff(), 0.0);
  EXPECT_EQ(f_r_at(*file.brdf, direction(10, 180), direction(91, 0)).maxCoeff(), 0.0);
}

TEST(MerlBrdf, FillsGapsFromTheirNeighbours) {
  const auto with_gap = [](double theta_h, double theta_d, double phi_d, int channel) {
    const bool is_gap = theta_d > 1.0 && theta_h > 0.1 && channel == 1;
    return is_gap ? -1.0 : lambert(theta_h, theta_d, phi_d, channel);
  };
  const BrdfFile file = parsed(merl_bytes(with_gap, {6, 6, 12}));
  // theta_h from node 2 on and theta_d from node 4 on, all azimuths
  EXPECT_THAT(file.warnings, ElementsAre(HasSubstr("96 of 1296 numbers are negative")));
  for_pairs([&](const Vector3& omega_i, const Vector3& omega_r) {
    ASSERT_TRUE(is_close_relative(f_r_at(*file.brdf, omega_i, omega_r)(1), 0.5 / pi, 1e-6));
  });
}

TEST(MerlBrdf, TellsItsStep) {
  EXPECT_NEAR(full_size_lobe().brdf->step(degrees(60)).degrees(), 2.0 / 90.0, 1e-12);
  EXPECT_NEAR(full_size_lobe().brdf->largest_theta().degrees(), 89.0, 1e-12);
}

TEST(MerlFile, IsFoundByItsContent) {
  const std::string bytes = merl_bytes(lambert, {2, 3, 4});
  EXPECT_TRUE(is_merl(as_span(bytes), bytes.size()));
  EXPECT_FALSE(is_merl(as_span(bytes), bytes.size() + 1));
  EXPECT_FALSE(is_merl(as_span(bytes).first(11), bytes.size()));
  const std::array<std::int32_t, 3> counts{90, 90, 180};
  EXPECT_TRUE(is_merl(std::as_bytes(std::span(counts)), 100)) << "cut off";
  const std::array<std::int32_t, 3> lie{1 << 30, 1 << 30, 1 << 30};
  EXPECT_FALSE(is_merl(std::as_bytes(std::span(lie)), 100));
}

TEST(MerlFile, IsRefusedAtEveryOtherLength) {
  const std::string bytes = merl_bytes(lambert, {2, 2, 2});
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW((void)parsed(bytes.substr(0, length)), InputError) << length;
  }
  EXPECT_EQ(refusal(bytes.substr(0, 7)),
            "m.binary: byte 4: number of theta_d: expected 4 bytes, "
            "found '3 bytes up to the end of the file'");
  EXPECT_EQ(refusal(bytes.substr(0, 100)),
            "m.binary: byte 100: end of the file: expected 204 bytes, for 2 x 2 x 2 nodes, "
            "found '100 bytes'");
  EXPECT_THAT(refusal(bytes + "x"),
              "m.binary: byte 204: end of the file: expected 204 bytes, for 2 x 2 x 2 nodes, "
              "found '205 bytes'");
}

TEST(MerlFile, IsRefusedIfItsCountsLie) {
  for (const std::int32_t lie : {0, -1, 3, 10000, 1 << 30, std::numeric_limits<std::int32_t>::max(),
                                 std::numeric_limits<std::int32_t>::min()}) {
    for (const std::size_t at : {0U, 4U, 8U}) {
      std::string bytes = merl_bytes(lambert, {2, 2, 2});
      std::memcpy(bytes.data() + at, &lie, sizeof lie);
      const LargestAllocation largest;
      EXPECT_THAT(refusal(bytes), HasSubstr("expected ")) << lie << " at " << at;
      EXPECT_LT(largest.bytes(), 4096U);
    }
  }
}

TEST(MerlFile, IsRefusedForNumbersThatAreNone) {
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    std::string bytes = merl_bytes(lambert, {2, 2, 2});
    std::memcpy(bytes.data() + 12 + 5 * 8, &wrong, sizeof wrong);
    EXPECT_THAT(refusal(bytes), HasSubstr("m.binary: byte 52: value: expected a BRDF up to"));
  }
  const auto nothing = [](double, double, double, int channel) {
    return channel == 2 ? -1.0 : 1.0;
  };
  EXPECT_EQ(refusal(merl_bytes(nothing, {2, 2, 2})),
            "m.binary: byte 140: values: expected at least one that is not negative, found 'none'");
}

}  // namespace
}  // namespace gonio::test
