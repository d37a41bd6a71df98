#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "emulator/surface/rotated_brdf.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/temporary_folder.hpp"

// The model `measured` of sample files, and the shipped ones.

namespace gonio {
namespace {

constexpr const char* shipped_ids[] = {"satin_film_measured", "wall_paint_measured",
                                       "paper_measured"};

TEST(MeasuredSamples, ReflectNoMoreThanAllLight) {
  constexpr double tolerance = 1e-3;
  const Eigen::ArrayXd weight =
      Eigen::ArrayXd::Constant(test::visible.size(), 1.0 / double(test::visible.size()));
  for (const char* id : shipped_ids) {
    const Surface surface = test::shipped_sample(id).surface;
    for (const double theta_deg : {0.0, 30.0, 60.0}) {
      const Flux flux = ApertureIntegrator().hemispherical(
          surface, source_frame(degrees(theta_deg)).axis, weight, tolerance);
      EXPECT_LE((weight * flux.spectral).sum(), 1.0 + flux.error) << id << " at " << theta_deg;
      EXPECT_GT((weight * flux.spectral).sum(), 0.0) << id << " at " << theta_deg;
    }
  }
}

TEST(MeasuredSamples, NameTheFileThatIsNoBrdf) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "no.bsdf") << "nothing\n";
  const std::string message = test::message_of([&] {
    static_cast<void>(
        test::sample_of(folder.path() / "mine.yaml", "{model: measured, file: no.bsdf}"));
  });
  EXPECT_THAT(message, testing::HasSubstr("no.bsdf"));
}

TEST(RotatedBrdf, OfAnIsotropicSampleIsThatSample) {
  constexpr double rounding = 1e-5;  // of tables in single precision, relative
  const Surface surface = test::shipped_sample("paper_measured").surface;
  Surface turned = surface;
  turned.measured[0].brdf = std::make_shared<RotatedBrdf>(surface.measured[0].brdf, degrees(30));
  const Vector3 omega_i = source_frame(degrees(45)).axis;
  const Vector3 omega_r = receptor_frame(degrees(20)).axis;
  const double expected = surface.brdf(omega_i, omega_r)(0);
  EXPECT_TRUE(test::is_close_relative(turned.brdf(omega_i, omega_r)(0), expected, rounding));
}

}  // namespace
}  // namespace gonio
