#include "emulator/measured/brdf_reflectance.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "emulator/measured/brdf_file.hpp"
#include "tests/unit/csv_rows.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/measured/measured_fixture.hpp"

namespace gonio::test {
namespace {

using std::numbers::pi;

/// f_r = c cos^n of the angle to the mirror direction; n = 0 is Lambertian.
class PhongLobe : public MeasuredBrdf {
 public:
  explicit PhongLobe(double exponent) : exponent_(exponent) {}
  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    const Vector3 mirror = mirrored(omega_i);
    f_r.col(0) = (omega_r.x * mirror.x() + omega_r.y * mirror.y() + omega_r.z * mirror.z())
                     .max(0.0)
                     .pow(exponent_) *
                 (exponent_ + 2.0) / (2.0 * pi);
  }
  [[nodiscard]] Angle step(Angle) const override { return degrees(1.0); }
  [[nodiscard]] Angle largest_theta() const override { return degrees(90.0); }

 private:
  double exponent_;
  std::vector<BrdfChannel> channels_{{.band = BrdfChannel::Band::luminance}};
};

TEST(DirectionalHemisphericalReflectance, IsOneOfAWhiteLambertianSurface) {
  constexpr double rule = 2e-4;
  for (const double theta_i : {0.0, 45.0, 80.0}) {
    EXPECT_TRUE(is_close(
        directional_hemispherical_reflectance(PhongLobe(0.0), degrees(theta_i), degrees(30.0))[0],
        1.0, rule))
        << theta_i;
  }
}

TEST(DirectionalHemisphericalReflectance, IsOneOfLobesOfAnyWidthAtNormalIncidence) {
  constexpr double rule = 1e-3;
  for (const double exponent : {1.0, 10.0, 1e3, 1e4}) {  // to 0.7 deg half width
    EXPECT_TRUE(is_close(
        directional_hemispherical_reflectance(PhongLobe(exponent), degrees(0.0))[0], 1.0, rule))
        << exponent;
  }
}

TEST(DirectionalHemisphericalReflectance, OfTablesIsNearThatOfTheMaterial) {
  constexpr double coarse_tables = 0.03;
  for (const CsvRow& row : csv_rows(brdf_fixtures + "rgl_reference_albedo.csv")) {
    const double theta_i = row.number("theta_i_deg");
    const std::string file = row.text("file");
    const std::string material = file.substr(0, file.find("_rgb"));
    if (material == "paper_white" || theta_i == 75.0) {  // there is no table of it; see below
      continue;
    }
    const BrdfFile astm = load_brdf(brdf_fixtures + material + ".astm");
    EXPECT_TRUE(
        is_close_relative(directional_hemispherical_reflectance(*astm.brdf, degrees(theta_i))[1],
                          row.number("rho_G"), coarse_tables))
        << file << " " << theta_i;
  }
}

TEST(DirectionalHemisphericalReflectance, ShowsATableThatIsTooCoarseForItsLobe) {
  const BrdfFile astm = load_brdf(brdf_fixtures + "satin_rosaline.astm");  // 15 deg in azimuth
  EXPECT_GT(directional_hemispherical_reflectance(*astm.brdf, degrees(75.0))[1], 1.1);
}

}  // namespace
}  // namespace gonio::test
