#include "emulator/surface/sample_family.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "emulator/surface/models.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;

const WavelengthGrid three_wavelengths(nanometres(450), nanometres(100), 3);
const Vector3 omega_i(-std::sqrt(0.75), 0.0, 0.5);
const Vector3 near_mirror(std::sqrt(0.74), 0.1, 0.5);

/// A family whose file has `surface` for its surface: a flow map from column 11 of line 4.
SampleFamily family_of(const std::string& surface) {
  const test::TemporaryFolder folder;
  return SampleFamily::load(
      folder.file("mine.yaml",
                  "schema: gonio/sample/1\nid: mine\ntitle: Mine\nsurface: {" + surface + "}\n"),
      three_wavelengths);
}

/// All bits of f_r near the mirror direction and of the specular reflectance, as numbers.
void expect_same(const Surface& a, const Surface& b) {
  EXPECT_TRUE((a.brdf(omega_i, near_mirror) == b.brdf(omega_i, near_mirror)).all());
  EXPECT_TRUE((a.specular_reflectance(0.5) == b.specular_reflectance(0.5)).all());
}

struct Twin {
  std::string before;
  SampleDeviation deviation;
  std::string after;  ///< the surface that a file would state
};

class SampleFamilyTwin : public testing::TestWithParam<Twin> {};

TEST_P(SampleFamilyTwin, IsWhatAFileOfTheDeviatedParametersDescribes) {
  expect_same(family_of(GetParam().before).sample(GetParam().deviation).surface,
              family_of(GetParam().after).sample().surface);
}

// Powers of two, so that a deviation and the file's own number are the same bits.
const SampleDeviation rougher{.roughness = std::log(2.0)};
const SampleDeviation denser{.refractive_index = 0.25};
const SampleDeviation lighter{.diffuse_reflectance = 0.125};

INSTANTIATE_TEST_SUITE_P(
    EachModel, SampleFamilyTwin,
    testing::Values(
        Twin{"model: cook_torrance, rms_slope: 0.125, refractive_index: 1.5", rougher,
             "model: cook_torrance, rms_slope: 0.25, refractive_index: 1.5"},
        Twin{"model: ggx, alpha: 0.125, refractive_index: {n: 1.5, k: 1}", denser,
             "model: ggx, alpha: 0.125, refractive_index: {n: 1.75, k: 1}"},
        Twin{"model: ggx, alpha: 0.5, refractive_index: 1.5, specular: 0.5, diffuse: 0.25", lighter,
             "model: ggx, alpha: 0.5, refractive_index: 1.5, specular: 0.5, diffuse: 0.375"},
        Twin{"model: ward, alpha_x: 0.125, alpha_y: 0.25, specular: 0.5", rougher,
             "model: ward, alpha_x: 0.25, alpha_y: 0.5, specular: 0.5"},
        Twin{"model: coherent_roughness, rms_height: 64 nm, correlation_length: 10 um, "
             "refractive_index: 1.5",
             rougher,
             "model: coherent_roughness, rms_height: 128 nm, correlation_length: 10 um, "
             "refractive_index: 1.5"},
        Twin{"model: smooth, refractive_index: 1.5", denser,
             "model: smooth, refractive_index: 1.75"},
        Twin{"model: smooth, reflectance: 0.5", lighter, "model: smooth, reflectance: 0.5"},
        Twin{"model: lambertian, reflectance: 0.5", lighter,
             "model: lambertian, reflectance: 0.625"},
        Twin{"model: coated, base: 0.5, refractive_index: 1.5", lighter,
             "model: coated, base: 0.625, refractive_index: 1.5"},
        Twin{"model: coated, base: 0.5, refractive_index: 1.5, rms_slope: 0.125", rougher,
             "model: coated, base: 0.5, refractive_index: 1.5, rms_slope: 0.25"}));

TEST(SampleFamily, WithoutDeviationTakesTheNumbersOfTheFileAsTheyAre) {
  const Amplitudes amplitudes{.specular = 0.7, .diffuse = Eigen::ArrayXd::Constant(3, 0.3)};
  ASSERT_NE(1.0 - amplitudes.specular, 0.3);  // so that keeping it below that would change it
  expect_same(
      family_of("model: cook_torrance, rms_slope: 0.3, refractive_index: 1.3, specular: 0.7, "
                "diffuse: 0.3")
          .sample()
          .surface,
      cook_torrance(three_wavelengths, 0.3, Eigen::ArrayXcd::Constant(3, 1.3), amplitudes));
}

TEST(SampleFamily, KeepsDiffuseReflectanceWithinWhatSpecularLeaves) {
  const SampleFamily family =
      family_of("model: ggx, alpha: 0.5, refractive_index: 1.5, specular: 0.75, diffuse: 0.125");
  const auto with = [](const std::string& diffuse) {
    return family_of("model: ggx, alpha: 0.5, refractive_index: 1.5, specular: 0.75, diffuse: " +
                     diffuse)
        .sample()
        .surface;
  };
  expect_same(family.sample({.diffuse_reflectance = 0.5}).surface, with("0.25"));
  expect_same(family.sample({.diffuse_reflectance = -0.5}).surface, with("0"));
}

TEST(SampleFamily, TellsWhatMayVary) {
  const auto has = [](const std::string& surface) {
    std::string result;
    const SampleFamily family = family_of(surface);
    for (std::size_t i = 0; i < sample_parameter_count; ++i) {
      result += family.has(SampleParameter(i)) ? sample_parameter_names[i][0] : '-';
    }
    return result;
  };
  EXPECT_EQ(has("model: smooth, reflectance: 1"), "---");
  EXPECT_EQ(has("model: smooth, refractive_index: 1.5"), "-r-");
  EXPECT_EQ(has("model: lambertian, reflectance: 1"), "--d");
  EXPECT_EQ(has("model: ggx, alpha: 0.5, refractive_index: 1.5"), "rr-");
  EXPECT_EQ(has("model: ward, alpha_x: 0.5, alpha_y: 0.5, specular: 0.5, diffuse: 0"), "r-d");
  EXPECT_EQ(has("model: coated, base: 0.5, refractive_index: 1.5"), "-rd");
  EXPECT_EQ(has("model: coated, base: 0.5, refractive_index: 1.5, rms_slope: 0.1"), "rrd");
}

TEST(SampleFamily, RefusesADeviationBeyondTheModel) {
  const SampleFamily paint = family_of("model: ggx, alpha: 0.5, refractive_index: 1.5");
  const auto message = [&](const SampleDeviation& by) {
    return message_of([&] { (void)paint.sample(by); });
  };
  EXPECT_EQ(message({.roughness = 1.0}), "alpha must be in (0, 1], is 0.5 exp(1) = 1.35914");
  EXPECT_EQ(message({.refractive_index = -0.75}),
            "refractive_index must be > 1, is 1.5 + (-0.75) = 0.75");
  EXPECT_EQ(message({.roughness = std::numeric_limits<double>::quiet_NaN()}),
            "a deviation of roughness must be finite, is nan");
  EXPECT_THROW((void)paint.sample({.roughness = 1.0}), std::domain_error);
  const SampleFamily metal = family_of("model: ggx, alpha: 0.5, refractive_index: {n: 0.5, k: 3}");
  EXPECT_NO_THROW((void)metal.sample({.refractive_index = -0.25}));
  EXPECT_THROW((void)metal.sample({.refractive_index = -0.5}), std::domain_error);
}

TEST(SampleFamily, DeviatesAllLobesOfAMixture) {
  const test::TemporaryFolder folder;
  const auto load = [&](const std::string& alphas) {
    return SampleFamily::load(
        folder.file("mixed.yaml", "schema: gonio/sample/1\nid: mixed\ntitle: M\nlobes:\n" + alphas),
        three_wavelengths);
  };
  const SampleFamily before = load(
      "  - {weight: 0.5, model: ggx, alpha: 0.125, refractive_index: 1.5}\n"
      "  - {weight: 0.5, model: ggx, alpha: 0.25, refractive_index: 1.5}\n");
  const SampleFamily after = load(
      "  - {weight: 0.5, model: ggx, alpha: 0.25, refractive_index: 1.5}\n"
      "  - {weight: 0.5, model: ggx, alpha: 0.5, refractive_index: 1.5}\n");
  expect_same(before.sample(rougher).surface, after.sample().surface);
}

TEST(SampleFamily, OutlivesItsFiles) {
  const SampleFamily family = [] {
    const test::TemporaryFolder folder;
    (void)folder.file("r.csv", "300,0.25\n800,0.25\n");
    return SampleFamily::load(
        folder.file("s.yaml",
                    "schema: gonio/sample/1\nid: s\ntitle: S\nsurface: {model: "
                    "lambertian, reflectance: {file: r.csv}}\n"),
        three_wavelengths);
  }();
  expect_same(family.sample(lighter).surface,
              family_of("model: lambertian, reflectance: 0.375").sample().surface);
}

}  // namespace
}  // namespace gonio
