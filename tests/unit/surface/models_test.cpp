#include "emulator/surface/models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>

#include "emulator/optics/fresnel.hpp"
#include "tests/unit/csv_rows.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/surface/every_model.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXd;
using std::numbers::pi;
using test::constant_index;
using test::is_close;
using test::is_close_relative;
using test::one_wavelength;

constexpr double rounding = 1e-14;
const Eigen::ArrayXcd glass = constant_index(1.567);

ArrayXd one(double value) { return ArrayXd::Constant(1, value); }

/// A pair of directions off the plane of measurement, and not in the mirror direction.
const Vector3 omega_i = Vector3(-0.5, 0.2, 0.7).normalized();
const Vector3 omega_r = Vector3(0.4, -0.1, 0.8).normalized();

TEST(Lambertian, IsItsReflectanceOverPi) {
  EXPECT_TRUE(
      is_close(lambertian(one_wavelength, one(0.4)).brdf(omega_i, omega_r)(0), 0.4 / pi, rounding));
}

TEST(Smooth, HasTheGlossOfTheReferenceTableOfDielectrics) {
  // GU has three decimals, n no rounding.
  constexpr double printed = 0.0005 * (1 + 1e-6);
  const auto rows = test::csv_rows(GONIO_SOURCE_DIR "/fixtures/reference/fresnel_gloss_vs_n.csv");
  for (const auto& row : rows) {
    const Surface surface = smooth(one_wavelength, constant_index(row.number("n")));
    const Surface standard = smooth(one_wavelength, glass);
    for (const std::string angle : {"20", "45", "60", "75", "85"}) {
      const double c = std::cos(degrees(std::stod(angle)).radians());
      const double gloss =
          100.0 * surface.specular_reflectance(c)(0) / standard.specular_reflectance(c)(0);
      EXPECT_TRUE(is_close(gloss, row.number("GU" + angle), printed))
          << "n = " << row.text("n") << " at " << angle << " deg";
    }
  }
}

TEST(Smooth, ReflectsIntoTheMirrorDirectionAlone) {
  const Surface surface = smooth(one_wavelength, glass);
  EXPECT_EQ(surface.brdf(omega_i, omega_r)(0), 0.0);
  EXPECT_EQ(surface.specular_reflectance(0.5)(0), fresnel_reflectance(0.5, 1.567));
  EXPECT_EQ(smooth(one_wavelength, 0.93).specular_reflectance(0.5)(0), 0.93);
}

TEST(SpecularLobes, AreWeighedByTheirAmplitudes) {
  const Amplitudes half{.specular = 0.5, .diffuse = one(0.3)};
  const auto check = [&](const std::string& name, const Surface& full, const Surface& weighed) {
    EXPECT_TRUE(is_close_relative(weighed.brdf(omega_i, omega_r)(0),
                                  0.5 * full.brdf(omega_i, omega_r)(0) + 0.3 / pi, rounding))
        << name;
  };
  check("cook_torrance", cook_torrance(one_wavelength, 0.2, glass),
        cook_torrance(one_wavelength, 0.2, glass, half));
  check("ggx", ggx(one_wavelength, 0.2, glass), ggx(one_wavelength, 0.2, glass, half));
  check("ward", ward(one_wavelength, 0.2, 0.3, {}), ward(one_wavelength, 0.2, 0.3, half));
}

TEST(Mixture, IsTheWeightedSumByArea) {
  const Surface rough = cook_torrance(one_wavelength, 0.2, glass);
  const Surface coat = coated(one_wavelength, one(0.5), one(1.5), 0.0);
  const Surface both = mixture({rough, coat}, {0.25, 0.6});
  EXPECT_TRUE(is_close_relative(
      both.brdf(omega_i, omega_r)(0),
      0.25 * rough.brdf(omega_i, omega_r)(0) + 0.6 * coat.brdf(omega_i, omega_r)(0), rounding));
  EXPECT_TRUE(is_close_relative(both.specular_reflectance(0.5)(0),
                                0.6 * coat.specular_reflectance(0.5)(0), rounding));
}

/// The text of the std::domain_error that a model throws; another text for any other exception.
std::string domain_error(const std::function<Surface()>& make) {
  try {
    (void)make();
  } catch (const std::domain_error& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("not a domain_error: ") + error.what();
  }
  return "no error";
}

TEST(Models, RefuseAWidthOutsideItsRange) {
  const WavelengthGrid& grid = one_wavelength;
  EXPECT_EQ(domain_error([&] { return cook_torrance(grid, 0.0, glass); }),
            "rms_slope must be > 0, is 0");
  EXPECT_EQ(domain_error([&] { return cook_torrance(grid, -0.1, glass); }),
            "rms_slope must be > 0, is -0.1");
  EXPECT_EQ(domain_error([&] { return cook_torrance(grid, std::nan(""), glass); }),
            "rms_slope must be > 0, is nan");
  EXPECT_EQ(domain_error([&] { return ggx(grid, 0.0, glass); }), "alpha must be in (0, 1], is 0");
  EXPECT_EQ(domain_error([&] { return ggx(grid, 1.5, glass); }), "alpha must be in (0, 1], is 1.5");
  EXPECT_EQ(domain_error([&] { return ward(grid, 0.0, 0.1, {}); }), "alpha_x must be > 0, is 0");
  EXPECT_EQ(domain_error([&] { return ward(grid, 0.1, -2.0, {}); }), "alpha_y must be > 0, is -2");
  EXPECT_EQ(domain_error([&] { return coated(grid, one(0.5), one(1.5), -0.1); }),
            "rms_slope must be >= 0, is -0.1");
}

TEST(Models, RefuseALengthOutsideItsRange) {
  const auto make = [](double sigma_nm, double length_nm) {
    return domain_error([=] {
      return coherent_roughness(one_wavelength, nanometres(sigma_nm), nanometres(length_nm), glass);
    });
  };
  EXPECT_EQ(make(-1.0, 100.0), "rms_height must be >= 0 nm, is -1");
  EXPECT_EQ(make(10.0, 0.0), "correlation_length must be > 0 nm, is 0");
  EXPECT_EQ(make(std::nan(""), 100.0), "rms_height must be >= 0 nm, is nan");
}

TEST(Models, RefuseAReflectanceOutside0To1) {
  const std::string text = "reflectance must be in [0, 1] at all wavelengths, is ";
  EXPECT_EQ(domain_error([&] { return lambertian(one_wavelength, one(1.1)); }), text + "1.1");
  EXPECT_EQ(domain_error([&] { return lambertian(one_wavelength, one(-0.1)); }), text + "-0.1");
  EXPECT_EQ(domain_error([&] { return smooth(one_wavelength, 1.5); }), text + "1.5");
  EXPECT_EQ(domain_error([&] { return coated(one_wavelength, one(2.0), one(1.5), 0.0); }),
            text + "2");
  EXPECT_EQ(domain_error([&] { return coated(one_wavelength, one(0.5), one(1.0), 0.0); }),
            "refractive_index must be > 1, is 1");
}

TEST(Models, RefuseAmplitudesThatSumToMoreThanOne) {
  const auto make = [&](double specular, double diffuse) {
    return domain_error([=] {
      return cook_torrance(one_wavelength, 0.1, glass,
                           {.specular = specular, .diffuse = one(diffuse)});
    });
  };
  EXPECT_EQ(make(0.75, 0.5), "k_d + k_s must be <= 1, is 1.25");
  EXPECT_EQ(make(1.5, 0.0), "k_s must be in [0, 1], is 1.5");
  EXPECT_EQ(make(-0.5, 0.0), "k_s must be in [0, 1], is -0.5");
  EXPECT_EQ(make(0.75, 0.25), "no error");
  EXPECT_EQ(make(0.1 + 0.2, 0.7), "no error") << "rounding of the sum is allowed for";
}

TEST(Mixture, RefusesWeightsThatAreNoShares) {
  const Surface white = lambertian(one_wavelength, one(1.0));
  EXPECT_EQ(domain_error([&] {
              return mixture({white, white}, {0.75, 0.5});
            }),
            "the sum of weights must be <= 1, is 1.25");
  EXPECT_EQ(domain_error([&] { return mixture({white}, {-0.5}); }),
            "a weight must be >= 0, is -0.5");
  EXPECT_THROW((void)mixture({white, white}, {0.5}), std::invalid_argument);
  EXPECT_THROW((void)mixture({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace gonio
