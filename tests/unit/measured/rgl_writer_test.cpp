#include "emulator/measured/rgl_writer.hpp"

#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <numbers>
#include <random>

#include "emulator/measured/rgl_brdf.hpp"
#include "emulator/measured/tensor_file.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/brdf_at.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

using Formula = std::function<double(const Vector3& omega_i, const Vector3& omega_r, int channel)>;

/// A closed form as a measured BRDF.
class ClosedForm final : public MeasuredBrdf {
 public:
  ClosedForm(Formula f_r, std::vector<BrdfChannel> channels)
      : f_r_(std::move(f_r)), channels_(std::move(channels)) {}

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    for (Eigen::Index j = 0; j < omega_r.size(); ++j) {
      const Vector3 r(omega_r.x(j), omega_r.y(j), omega_r.z(j));
      for (int c = 0; c < int(channels_.size()); ++c) {
        f_r(j, c) = omega_i.z() > 0.0 && r.z() > 0.0 ? f_r_(omega_i, r, c) : 0.0;
      }
    }
  }
  [[nodiscard]] Angle step(Angle /*theta_i*/) const override { return degrees(0.01); }
  [[nodiscard]] Angle largest_theta() const override { return degrees(85.0); }

 private:
  Formula f_r_;
  std::vector<BrdfChannel> channels_;
};

std::vector<BrdfChannel> rgb() {
  using Band = BrdfChannel::Band;
  return {{.band = Band::red}, {.band = Band::green}, {.band = Band::blue}};
}

double lambert(const Vector3& /*omega_i*/, const Vector3& /*omega_r*/, int channel) {
  return (channel + 1) * 0.25 / pi;
}

/// A lobe of Cook and Torrance of rms slopes m_x, m_y (Beckmann's, times the square root of 2),
/// over a diffuse part of 5 % to 15 %.
Formula glossy(double slope_x, double slope_y) {
  return [=](const Vector3& omega_i, const Vector3& omega_r, int channel) {
    const Vector3 h = (omega_i + omega_r).normalized();
    const double cos_d = h.dot(omega_i);
    const double x = h.x() / h.z() / slope_x;
    const double y = h.y() / h.z() / slope_y;
    const double d =
        std::exp(-0.5 * (x * x + y * y)) / (2.0 * pi * slope_x * slope_y * std::pow(h.z(), 4));
    const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cos_d, 5);
    const double g =
        std::min({1.0, 2.0 * h.z() * omega_i.z() / cos_d, 2.0 * h.z() * omega_r.z() / cos_d});
    return 0.05 * (channel + 1) / pi + fresnel * d * g / (4.0 * omega_i.z() * omega_r.z());
  };
}

BrdfFile written(const MeasuredBrdf& source, const RglOptions& options = {}) {
  const TemporaryFolder folder;
  write_rgl(folder.path() / "written.bsdf", source, options);
  return read_rgl(folder.path() / "written.bsdf");
}

constexpr unsigned seed = 5;

/// The largest error relative to what is expected, of the channel G, up to theta_r = 75 deg: within
/// `half_angle_deg` of the normal for the half direction.
double worst_error(const MeasuredBrdf& got, const MeasuredBrdf& expected, double theta_i_deg,
                   double half_angle_deg) {
  constexpr int trials = 3000;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  double worst = 0.0;
  const double cos_limit = std::cos(degrees(75.0).radians());
  for (int i = 0; i < trials; ++i) {
    const Vector3 omega_i = direction(theta_i_deg, 180.0);
    const Vector3 m = direction(half_angle_deg * std::sqrt(part(random)), 360.0 * part(random));
    const Vector3 omega_r = 2.0 * m.dot(omega_i) * m - omega_i;
    if (m.dot(omega_i) <= 0.0 || omega_r.z() < cos_limit) {
      continue;
    }
    const double f_r = f_r_at(expected, omega_i, omega_r)(1);
    const double error = std::abs(f_r_at(got, omega_i, omega_r)(1) / f_r - 1.0);
    worst = std::max(worst, error);
  }
  return worst;
}

TEST(RglWriter, KeepsALambertianSurface) {
  // Most at theta_r = 75 deg, where what is stored, f_r cos(theta_r), falls to 0 within a few
  // nodes.
  constexpr double tolerance = 0.03;
  const ClosedForm source(lambert, rgb());
  const BrdfFile file = written(source, {.description = "grey"});
  EXPECT_EQ(file.description, "grey");
  EXPECT_EQ(file.brdf->channels(), source.channels());
  EXPECT_NEAR(file.brdf->largest_theta().degrees(), 85.0, 1e-4);
  for (const double theta_i_deg : {0.0, 20.0, 43.0, 60.0, 75.0}) {
    EXPECT_LT(worst_error(*file.brdf, source, theta_i_deg, 80.0), tolerance) << theta_i_deg;
  }
}

TEST(RglWriter, ResolvesLobesOfAnyWidth) {
  // Narrow ones, within 3 rms slopes: at incidences that were written, and between them, where
  // Schlick's reflectance is interpolated linearly over 2.5 deg or 5 deg.
  constexpr double tolerance = 0.005;
  constexpr double tolerance_between = 0.02;
  // Wider ones reach theta_r = 75 deg, as the Lambertian surface does.
  constexpr double tolerance_wide = 0.06;
  for (const double slope : {0.02, 0.05, 0.1, 0.3}) {
    const ClosedForm source(glossy(slope, slope), rgb());
    const BrdfFile file = written(source);
    const MeasuredBrdf& brdf = *file.brdf;
    const double reach_deg = 3.0 * slope * 180.0 / pi;
    for (const double theta_i_deg : {0.0, 20.0, 45.0, 57.5, 60.0}) {
      EXPECT_LT(worst_error(brdf, source, theta_i_deg, reach_deg),
                slope < 0.1 ? tolerance : tolerance_wide)
          << slope << " " << theta_i_deg;
    }
    for (const double theta_i_deg : {22.5, 58.75, 61.25}) {
      EXPECT_LT(worst_error(brdf, source, theta_i_deg, reach_deg),
                slope < 0.1 ? tolerance_between : tolerance_wide)
          << slope << " " << theta_i_deg;
    }
    EXPECT_LT(brdf.step(degrees(60)).degrees(), 0.5 * slope * 180.0 / pi) << slope;
  }
}

TEST(RglWriter, KeepsWhatWasMeasured) {
  // The satin film of the database, by its reflectance: what the grids lose is at their own steps.
  constexpr double tolerance = 0.005;
  const BrdfFile source =
      read_rgl(std::filesystem::path(GONIO_SOURCE_DIR) / "fixtures/brdf/satin_rosaline_rgb.bsdf");
  const BrdfFile file = written(*source.brdf);
  for (const double theta_i_deg : {0.0, 20.0, 45.0, 60.0}) {
    const Eigen::ArrayXd rho = rho_of(*file.brdf, direction(theta_i_deg, 180.0), 180);
    const Eigen::ArrayXd expected = rho_of(*source.brdf, direction(theta_i_deg, 180.0), 180);
    for (Eigen::Index c = 0; c < 3; ++c) {
      EXPECT_TRUE(is_close_relative(rho(c), expected(c), tolerance)) << theta_i_deg;
    }
  }
}

TEST(RglWriter, KeepsAnisotropy) {
  constexpr double tolerance = 0.05;
  const ClosedForm source(glossy(0.1, 0.3), rgb());
  RglOptions options{.theta_i = {degrees(0), degrees(30), degrees(60)}, .size = 48};
  for (int phi_deg = -180; phi_deg <= 180; phi_deg += 30) {
    options.phi_i.push_back(degrees(phi_deg));
  }
  const BrdfFile file = written(source, options);
  for (const double phi_deg : {-180.0, -30.0, 60.0, 90.0, 180.0}) {
    for (const double turn_deg : {150.0, 180.0, 200.0}) {
      const Vector3 omega_i = direction(30, phi_deg);
      const Vector3 omega_r = direction(40, phi_deg + turn_deg);
      EXPECT_TRUE(is_close_relative(f_r_at(*file.brdf, omega_i, omega_r)(1),
                                    f_r_at(source, omega_i, omega_r)(1), tolerance))
          << phi_deg << " " << turn_deg;
    }
  }
}

TEST(RglWriter, WritesWavelengthsAsSpectra) {
  constexpr double tolerance = 1e-3;
  std::vector<BrdfChannel> channels;
  for (const double nm : {400.0, 550.0, 700.0, 701.5}) {
    channels.push_back({.band = BrdfChannel::Band::wavelength, .wavelength = nanometres(nm)});
  }
  const BrdfFile file = written(ClosedForm(lambert, channels), {.size = 16});
  EXPECT_EQ(file.brdf->channels(), channels);
  const Eigen::ArrayXd f_r = f_r_at(*file.brdf, direction(0, 0), direction(0, 0));
  for (int c = 0; c < 4; ++c) {
    EXPECT_TRUE(is_close_relative(f_r(c), lambert({}, {}, c), tolerance));
  }
}

TEST(RglWriter, WritesLuminanceAndXyzAsRgb) {
  constexpr double tolerance = 1e-3;
  using Band = BrdfChannel::Band;
  const auto rgb_of = [](const Formula& formula, std::vector<BrdfChannel> channels) {
    const BrdfFile file = written(ClosedForm(formula, std::move(channels)), {.size = 16});
    EXPECT_EQ(file.brdf->channels(), rgb());
    return f_r_at(*file.brdf, direction(0, 0), direction(0, 0));
  };
  // X, Y, Z of the white point D65 are R = G = B = 1.
  const auto white = [](const Vector3&, const Vector3&, int channel) {
    return std::array{0.9505, 1.0, 1.0891}.at(std::size_t(channel));
  };
  const Eigen::ArrayXd from_xyz =
      rgb_of(white, {{.band = Band::x}, {.band = Band::y}, {.band = Band::z}});
  const Eigen::ArrayXd from_luminance = rgb_of(lambert, {{.band = Band::luminance}});
  for (Eigen::Index c = 0; c < 3; ++c) {
    EXPECT_TRUE(is_close_relative(from_xyz(c), 1.0, tolerance));
    EXPECT_TRUE(is_close_relative(from_luminance(c), 0.25 / pi, tolerance));
  }
}

/// What rgl-epfl/brdf-loader asks of a file, in the same words as far as there are any.
TEST(RglWriter, WritesWhatTheReaderOfTheDatabaseExpects) {
  const TemporaryFolder folder;
  write_rgl(folder.path() / "m.bsdf", ClosedForm(lambert, rgb()), {.size = 16});
  const BinaryFile bytes(folder.path() / "m.bsdf");
  const TensorFile file(bytes.bytes(), "m.bsdf");
  const std::size_t n = file.field("theta_i", TensorType::f32, {std::nullopt}).count;
  EXPECT_EQ(n, 9U + 17U);
  EXPECT_EQ(file.field("phi_i", TensorType::f32, {1}).count, 1U);
  EXPECT_NO_THROW((void)file.field("version", TensorType::u32, {2}));
  EXPECT_NO_THROW((void)file.field("description", TensorType::u8, {std::nullopt}));
  EXPECT_NO_THROW((void)file.field("ndf", TensorType::f32, {std::nullopt, std::nullopt}));
  EXPECT_NO_THROW((void)file.field("sigma", TensorType::f32, {std::nullopt, std::nullopt}));
  EXPECT_NO_THROW((void)file.field("vndf", TensorType::f32, {1, n, std::nullopt, std::nullopt}));
  EXPECT_NO_THROW((void)file.field("rgb", TensorType::f32, {1, n, 3, 16, 16}));
  EXPECT_NO_THROW((void)file.field("jacobian", TensorType::u8, {1}));
  EXPECT_NO_THROW((void)file.field("valid", TensorType::u8, {16 * 16}));
  // It draws directions by the luminance, so nowhere may that be 0.
  EXPECT_NO_THROW((void)file.floats("luminance", {1, n, 16, 16}, {1e-7F, 1e7F}));
}

TEST(RglWriter, KeepsASurfaceThatReflectsNothing) {
  const auto black = [](const Vector3&, const Vector3&, int) { return 0.0; };
  const BrdfFile file = written(ClosedForm(black, rgb()), {.size = 8});
  EXPECT_EQ(f_r_at(*file.brdf, direction(30, 180), direction(30, 0)).maxCoeff(), 0.0);
}

TEST(RglWriter, RefusesOptionsThatCannotBe) {
  const auto refusal = [](const RglOptions& options, std::vector<BrdfChannel> channels = rgb()) {
    return message_of([&] { (void)written(ClosedForm(lambert, std::move(channels)), options); });
  };
  EXPECT_THAT(refusal({.size = 7}), HasSubstr("expected a grid of 8 to 1024, found 7"));
  const std::string theta = "theta_i must ascend from 0 deg to at most 90 deg";
  EXPECT_THAT(refusal({.theta_i = {degrees(10), degrees(20)}}), HasSubstr(theta));
  EXPECT_THAT(refusal({.theta_i = {degrees(0), degrees(0)}}), HasSubstr(theta));
  EXPECT_THAT(refusal({.theta_i = {degrees(0), degrees(91)}}), HasSubstr(theta));
  EXPECT_THAT(refusal({.phi_i = {degrees(0), degrees(90), degrees(180)}}),
              HasSubstr("phi_i must ascend from -180 deg to 180 deg"));
  EXPECT_THAT(refusal({}, {{.band = BrdfChannel::Band::red}}),
              HasSubstr("expected R, G, B or X, Y, Z or Luminance or wavelengths, found R"));
}

}  // namespace
}  // namespace gonio::test
