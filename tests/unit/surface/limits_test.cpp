#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/surface/every_model.hpp"

// A rough surface tends to a smooth one as its slopes vanish, in a glossmeter too.

namespace gonio {
namespace {

using test::constant_index;
using test::is_close;
using test::one_wavelength;

struct Model {
  std::string name;
  std::function<Surface(double width)> make;
};

const std::vector<Model> models = {
    {"cook_torrance",
     [](double m) { return cook_torrance(one_wavelength, m, constant_index(1.567)); }},
    {"ggx height_correlated",
     [](double alpha) { return ggx(one_wavelength, alpha, constant_index(1.567)); }},
    {"ggx separable",
     [](double alpha) {
       return ggx(one_wavelength, alpha, constant_index(1.567), {}, Masking::separable);
     }},
    {"coated", [](double m) {
       return coated(one_wavelength, Eigen::ArrayXd::Zero(1), Eigen::ArrayXd::Constant(1, 1.567),
                     m);
     }}};

TEST(SmoothLimit, IsReachedWithTheSquareOfTheWidth) {
  // GGX's tail past the nearest edge of the receptor holds (width / 0.0023)^2; its masking at 85
  // deg and the change of Fresnel's reflectance over the lobe go with the square too.
  constexpr double per_width2_gu = 100.0 * 4e5;
  for (const Model& model : models) {
    for (const double theta : {20.0, 60.0, 85.0}) {
      double before = 0.0;
      for (const double width : {1e-3, 1e-4, 1e-5}) {
        const double gloss =
            test::gloss_gu(model.make(width), test::collimated_glossmeter(theta), 1e-7);
        const double error = std::abs(gloss - 100.0);
        EXPECT_TRUE(is_close(gloss, 100.0, per_width2_gu * width * width + 1e-7))
            << model.name << " of width " << width << " at " << theta << " deg";
        if (before > 1e-4) {
          EXPECT_LT(error, 0.02 * before)
              << model.name << " at " << theta << " deg: a tenth of the "
              << "width leaves more than a hundredth of the error";
        }
        before = error;
      }
    }
  }
}

TEST(SmoothLimit, IsReachedOverASourceImage) {
  constexpr double limit_gu = 1e-2;  // GGX of 1e-5 loses 2e-3 at 20 deg past the receptor's edge
  for (const Model& model : models) {
    for (const double theta : {20.0, 60.0, 85.0}) {
      const double gloss = test::gloss_gu(model.make(1e-5), test::glossmeter(theta), 1e-4);
      EXPECT_TRUE(is_close(gloss, 100.0, limit_gu)) << model.name << " at " << theta << " deg";
    }
  }
}

TEST(RoughLimit, IsDarkInTheMirrorDirection) {
  // A lobe over the whole hemisphere leaves in the receptor what a diffuser would: its solid angle.
  for (const double theta : {20.0, 60.0}) {
    const double diffuse = test::gloss_gu(lambertian(one_wavelength, Eigen::ArrayXd::Ones(1)),
                                          test::glossmeter(theta));
    for (const Model& model : models) {
      const double gloss = test::gloss_gu(model.make(1.0), test::glossmeter(theta));
      EXPECT_LT(gloss, diffuse) << model.name << " at " << theta << " deg";
      EXPECT_GT(gloss, 1e-3 * diffuse) << model.name << " at " << theta << " deg";
    }
  }
}

TEST(Gloss, FallsWithTheWidthOfTheLobe) {
  for (const Model& model : models) {
    for (const double theta : {20.0, 60.0}) {
      double before = 100.0;  // narrower lobes may gain: Fresnel's reflectance is convex
      for (const double width : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
        const double gloss = test::gloss_gu(model.make(width), test::glossmeter(theta), 1e-5);
        EXPECT_LT(gloss, before) << model.name << " of width " << width << " at " << theta;
        before = gloss;
      }
    }
  }
}

}  // namespace
}  // namespace gonio
