#include "emulator/measured/sampled_brdf.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "emulator/measured/brdf_reflectance.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/measured_fixture.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using std::numbers::pi;

constexpr double rounding = 1e-11;  // of angles, roots and powers

/// Samples one by one, angles in degrees.
class Samples {
 public:
  Samples& add(double theta_i, double phi_i, double theta_r, double phi_r, double f_r) {
    for (const double value : {theta_i, phi_i, theta_r, phi_r}) {
      numbers_.push_back(degrees(value).radians());
    }
    f_r_.push_back(f_r);
    return *this;
  }

  [[nodiscard]] BrdfSamples samples() const {
    BrdfSamples result;
    result.channels = {{.band = BrdfChannel::Band::luminance}};
    const Index n = Index(f_r_.size());
    const auto column = [&](Index i) {
      return ArrayXd::NullaryExpr(n, [&](Index row) { return numbers_[std::size_t(4 * row + i)]; })
          .eval();
    };
    result.theta_i = column(0);
    result.phi_i = column(1);
    result.theta_r = column(2);
    result.phi_r = column(3);
    result.f_r = Eigen::Map<const ArrayXd>(f_r_.data(), n);
    return result;
  }

 private:
  std::vector<double> numbers_, f_r_;
};

/// A lobe about the half vector, as microfacets make it: cos^n of its polar angle.
double lobe(const Vector3& omega_i, const Vector3& omega_r, double exponent) {
  return std::pow((omega_i + omega_r).normalized().z(), exponent);
}

/// That lobe at incidences 0 to 60 degrees in steps of 20, on a grid in steps of 2.5 and 10
/// degrees.
BrdfSamples lobe_on_grid(double exponent, double last_azimuth_deg) {
  Samples samples;
  for (double theta_i = 0.0; theta_i <= 60.0; theta_i += 20.0) {
    for (double theta_r = 0.0; theta_r <= 85.0; theta_r += 2.5) {
      for (double phi_r = 0.0; phi_r <= last_azimuth_deg; phi_r += 10.0) {
        samples.add(theta_i, 180.0, theta_r, phi_r,
                    lobe(direction_at(theta_i, 180.0), direction_at(theta_r, phi_r), exponent));
      }
    }
  }
  return samples.samples();
}

TEST(SampledBrdf, IsItsSamplesAndKeepsTheMirrorDirectionBetweenIncidences) {
  std::vector<std::string> warnings;
  const SampledBrdf brdf(lobe_on_grid(300.0, 180.0), warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  EXPECT_TRUE(is_close(in_plane(brdf, 40.0, 50.0)[0],
                       lobe(direction_at(40.0, 180.0), direction_at(50.0, 0.0), 300.0), rounding));
  for (const double theta_i : {0.0, 10.0, 33.0, 50.0, 60.0}) {
    const double nodes_beside = std::fmod(theta_i, 20.0) == 0.0 ? rounding : 0.07;
    EXPECT_TRUE(is_close(in_plane(brdf, theta_i, theta_i)[0], 1.0, nodes_beside)) << theta_i;
  }
  EXPECT_DOUBLE_EQ(brdf.largest_theta().degrees(), 60.0);
  EXPECT_NEAR(brdf.step(degrees(1.0)).degrees(), 2.5, 0.01);
  EXPECT_NEAR(brdf.step(degrees(60.0)).degrees(), 10.0 * std::sin(pi / 3.0), 0.01);
}

TEST(SampledBrdf, IsNearALobeBetweenAllNodes) {
  constexpr unsigned seed = 7;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0.0, 1.0);
  std::vector<std::string> warnings;
  const SampledBrdf brdf(lobe_on_grid(100.0, 180.0), warnings);  // 6.7 deg half width of h
  double square = 0.0;
  constexpr int n = 500;
  for (int i = 0; i < n; ++i) {
    const Vector3 omega_i = direction_at(60.0 * angle(random), 360.0 * angle(random));
    const Vector3 omega_r = direction_at(75.0 * angle(random), 360.0 * angle(random));
    const double error = value_of(brdf, omega_i, omega_r)[0] - lobe(omega_i, omega_r, 100.0);
    square += error * error;
  }
  EXPECT_LT(std::sqrt(square / n), 0.01);  // of the peak
}

TEST(SampledBrdf, MirrorsTheSideThatWasNotMeasured) {
  std::vector<std::string> warnings;
  const SampledBrdf half(lobe_on_grid(50.0, 180.0), warnings);
  const SampledBrdf whole(lobe_on_grid(50.0, 350.0), warnings);
  for (const double phi : {5.0, 75.0, 175.0, 185.0, 300.0, 355.0}) {
    const Vector3 omega_i = direction_at(25.0, 180.0), omega_r = direction_at(35.0, phi);
    EXPECT_TRUE(is_close(value_of(half, omega_i, omega_r)[0], value_of(whole, omega_i, omega_r)[0],
                         rounding))
        << phi;
  }
}

TEST(SampledBrdf, TakesNegativeAnglesAndAnyAzimuthOfIncidence) {
  Samples turned;
  for (double theta_i = 0.0; theta_i <= 60.0; theta_i += 20.0) {
    for (double theta_r = -85.0; theta_r <= 85.0; theta_r += 2.5) {
      for (double phi_r = 0.0; phi_r < 180.0; phi_r += 10.0) {  // half circles through the normal
        turned.add(theta_i, -140.0, theta_r, phi_r + 40.0 - 360.0,
                   lobe(direction_at(theta_i, 180.0), direction_at(theta_r, phi_r), 80.0));
      }
    }
  }
  std::vector<std::string> warnings;
  const SampledBrdf brdf(turned.samples(), warnings);
  const SampledBrdf straight(lobe_on_grid(80.0, 350.0), warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  for (const double phi : {0.0, 15.0, 100.0, 185.0, 300.0}) {
    const Vector3 omega_i = direction_at(35.0, 180.0), omega_r = direction_at(31.0, phi);
    EXPECT_TRUE(is_close(value_of(brdf, omega_i, omega_r)[0],
                         value_of(straight, omega_i, omega_r)[0], 1e-9))
        << phi;
  }
}

TEST(SampledBrdf, TurnsWithTheSampleIfItWasTurned) {
  Samples samples;
  for (const double phi_i : {0.0, 90.0, 180.0, 270.0}) {
    for (const double theta_r : {0.0, 30.0, 60.0}) {
      for (const double phi_r : {0.0, 120.0, 240.0}) {
        samples.add(45.0, phi_i, theta_r, phi_i + phi_r, 1.0 + phi_i);
      }
    }
  }
  std::vector<std::string> warnings;
  const SampledBrdf brdf(samples.samples(), warnings);
  EXPECT_TRUE(
      is_close(value_of(brdf, direction_at(45.0, 90.0), direction_at(20.0, 10.0))[0], 91.0, 1e-9));
  EXPECT_TRUE(is_close(value_of(brdf, direction_at(45.0, 270.0), direction_at(20.0, 10.0))[0],
                       271.0, 1e-9));
}

TEST(SampledBrdf, OfThePlaneOfIncidenceIsFilledInRoundTheMirrorDirection) {
  Samples samples;
  for (const double theta_i : {0.0, 30.0, 60.0}) {
    for (double theta_r = -80.0; theta_r <= 80.0; theta_r += 2.0) {
      const double to_mirror = std::abs(theta_r - theta_i) * pi / 180.0;
      samples.add(theta_i, 180.0, theta_r, 0.0, std::pow(2.0 - to_mirror / pi, 4.0));
    }
  }
  std::vector<std::string> warnings;
  const SampledBrdf brdf(samples.samples(), warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "measured in the plane of incidence only: filled in round the mirror direction");
  EXPECT_TRUE(is_close(in_plane(brdf, 30.0, 30.0)[0], 16.0, rounding));
  EXPECT_TRUE(is_close(in_plane(brdf, 45.0, 25.0)[0], std::pow(2.0 - 1.0 / 9.0, 4.0), 1e-9));
  const Vector3 beside = Vector3(std::sin(pi / 6.0), 0.2, std::cos(pi / 6.0)).normalized();
  EXPECT_TRUE(is_close(value_of(brdf, direction_at(30.0, 180.0), beside)[0],
                       std::pow(2.0 - std::atan(0.2) / pi, 4.0), 1e-9));
}

TEST(SampledBrdf, OfScatteredDirectionsIsNearThem) {
  constexpr unsigned seed = 11;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Samples samples;
  for (int i = 0; i < 4000; ++i) {
    const double theta_i = 60.0 * unit(random), theta_r = 85.0 * std::sqrt(unit(random));
    const double phi_r = 360.0 * unit(random);
    samples.add(theta_i, 180.0, theta_r, phi_r,
                lobe(direction_at(theta_i, 180.0), direction_at(theta_r, phi_r), 10.0));
  }
  std::vector<std::string> warnings;
  const SampledBrdf brdf(samples.samples(), warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "directions are on no grid: the nearest ones are weighted by their distance");
  constexpr double between_neighbours = 0.08;  // of the peak, 8 deg from one to the next
  for (const double theta_i : {10.0, 30.0, 50.0}) {
    for (const double theta_r : {-40.0, 0.0, 30.0, 60.0}) {
      EXPECT_TRUE(is_close(in_plane(brdf, theta_i, theta_r)[0],
                           lobe(direction_at(theta_i, 180.0), direction_at(theta_r, 0.0), 10.0),
                           between_neighbours));
    }
  }
  EXPECT_GT(brdf.step(degrees(30.0)).degrees(), 1.0);
  EXPECT_LT(brdf.step(degrees(30.0)).degrees(), 30.0);
}

TEST(SampledBrdf, TellsOfHolesAndOfWhatWasMeasuredTwice) {
  Samples samples;
  for (const double theta_r : {0.0, 20.0, 40.0, 60.0}) {
    for (const double phi_r : {0.0, 60.0, 120.0, 180.0}) {
      if (theta_r != 40.0 || phi_r != 180.0) {  // the source stands there
        samples.add(40.0, 180.0, theta_r, phi_r, 2.0);
      }
    }
  }
  samples.add(40.0, 180.0, 60.0, 60.0, 4.0);
  samples.add(40.0, 180.0, 60.0, 120.0, -1.0);
  std::vector<std::string> warnings;
  const SampledBrdf brdf(samples.samples(), warnings);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings[0], "1 of 17 values are negative: 0 stands for them");
  EXPECT_EQ(warnings[1], "2 of 17 samples were measured before: their mean stands");
  EXPECT_EQ(warnings[2],
            "1 directions of the grid were not measured: filled in from those next to them");
  EXPECT_TRUE(is_close(in_plane(brdf, 40.0, -40.0)[0], 2.0, rounding));
  EXPECT_TRUE(is_close(value_of(brdf, direction_at(40, 180), direction_at(60, 60))[0], 3.0, 1e-9));
}

TEST(SampledBrdf, SortsChannels) {
  BrdfSamples samples = Samples().add(0, 180, 0, 0, 1).samples();
  samples.channels = {{.band = BrdfChannel::Band::wavelength, .wavelength = nanometres(700.0)},
                      {.band = BrdfChannel::Band::wavelength, .wavelength = nanometres(400.0)}};
  samples.f_r = Eigen::Array2d(7.0, 4.0).transpose();
  std::vector<std::string> warnings;
  const SampledBrdf brdf(samples, warnings);
  EXPECT_EQ(brdf.channels()[0].wavelength, nanometres(400.0));
  EXPECT_TRUE(is_close(in_plane(brdf, 10.0, 10.0)[0], 4.0, rounding));
}

TEST(SampledBrdf, RefusesSamplesThatAreNone) {
  std::vector<std::string> warnings;
  EXPECT_EQ(message_of([&] { (void)SampledBrdf(BrdfSamples{}, warnings); }),
            "expected angles and f_r of the same samples, found 0 by 0 f_r of 0 samples and 0 "
            "channels");
  BrdfSamples samples = Samples().add(0, 180, 0, 0, NAN).samples();
  EXPECT_EQ(message_of([&] { (void)SampledBrdf(samples, warnings); }),
            "expected finite angles and f_r");
}

}  // namespace
}  // namespace gonio::test
