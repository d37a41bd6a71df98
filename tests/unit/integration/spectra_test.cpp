#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/integration/glossmeter.hpp"

// All wavelengths of a spectrum come from one integration; each must be what an integration of it
// alone gives.

namespace gonio {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Eigen::Index;

const WavelengthGrid visible = WavelengthGrid::visible();

/// A metal that reddens and a glass that disperses, over the visible range.
ArrayXcd copper_like(const WavelengthGrid& grid) {
  const ArrayXd x = (grid.nanometres() - 380.0) / 400.0;
  ArrayXcd n_hat(grid.size());
  n_hat.real() = 1.2 - 1.0 * x;
  n_hat.imag() = 2.2 + 2.4 * x;
  return n_hat;
}
ArrayXd dispersive_glass(const WavelengthGrid& grid) {
  return 1.54 + 1e4 * grid.nanometres().square().inverse();
}
ArrayXd paint(const WavelengthGrid& grid) { return 0.2 + 1e-3 * (grid.nanometres() - 380.0); }

struct Model {
  std::string name;
  Surface (*make)(const WavelengthGrid& grid);
};

const std::vector<Model> models = {
    {"smooth", [](const WavelengthGrid& grid) { return smooth(grid, copper_like(grid)); }},
    {"lambertian", [](const WavelengthGrid& grid) { return lambertian(grid, paint(grid)); }},
    {"cook_torrance",
     [](const WavelengthGrid& grid) { return cook_torrance(grid, 0.1, copper_like(grid)); }},
    {"ggx", [](const WavelengthGrid& grid) { return ggx(grid, 0.05, copper_like(grid)); }},
    {"coherent_roughness",
     [](const WavelengthGrid& grid) {
       return coherent_roughness(grid, nanometres(80), micrometres(5), copper_like(grid));
     }},
    {"coated", [](const WavelengthGrid& grid) {
       return coated(grid, paint(grid), dispersive_glass(grid), 0.0);
     }}};

TEST(Spectrum, Of81WavelengthsEqualsThatOfOneAtATime) {
  constexpr double tolerance = 1e-14;  // [sr]
  constexpr double same = 1e-12;       // [sr]; the weighted sum alone is controlled
  for (const double theta : {20.0, 60.0}) {
    const MeasuringGeometry geometry = test::glossmeter(theta);
    for (const Model& model : models) {
      const ArrayXd weight = ArrayXd::Constant(visible.size(), 1.0 / double(visible.size()));
      const Flux all =
          ApertureIntegrator().reflected(model.make(visible), geometry, weight, tolerance);
      ASSERT_EQ(all.spectral.size(), visible.size());
      for (Index l = 0; l < visible.size(); l += 8) {
        const WavelengthGrid grid(nanometres(visible.nanometres()(l)), nanometres(1), 1);
        const double alone = test::flux_of(model.make(grid), geometry, tolerance);
        EXPECT_TRUE(test::is_close(all.spectral(l), alone, same))
            << model.name << " at " << theta << " deg and " << visible.nanometres()(l) << " nm";
      }
    }
  }
}

TEST(Spectrum, FollowsTheIndex) {
  const Flux flux = ApertureIntegrator().reflected(
      cook_torrance(visible, 0.1, copper_like(visible)), test::glossmeter(60.0),
      ArrayXd::Constant(visible.size(), 1.0 / double(visible.size())), 1e-9);
  EXPECT_GT(flux.spectral(80), 1.3 * flux.spectral(0));
  for (Index l = 1; l < visible.size(); ++l) {
    EXPECT_GT(flux.spectral(l), flux.spectral(l - 1)) << visible.nanometres()(l) << " nm";
  }
}

TEST(Spectrum, OfAWavelengthThatIsNotWeighedIsStillRight) {
  constexpr double tolerance = 1e-12;
  constexpr double unweighed = 1e-8;  // [sr]
  ArrayXd weight = ArrayXd::Zero(visible.size());
  weight(40) = 1.0;
  for (const Model& model : models) {
    const MeasuringGeometry geometry = test::glossmeter(60.0);
    const Flux flux =
        ApertureIntegrator().reflected(model.make(visible), geometry, weight, tolerance);
    for (const Index l : {0, 80}) {
      const WavelengthGrid grid(nanometres(visible.nanometres()(l)), nanometres(1), 1);
      EXPECT_TRUE(test::is_close(flux.spectral(l),
                                 test::flux_of(model.make(grid), geometry, tolerance), unweighed))
          << model.name << " at " << visible.nanometres()(l) << " nm";
    }
  }
}

TEST(Flux, OfTwoLobesIsTheSumOfTheirFluxes) {
  constexpr double tolerance = 1e-13;
  const Surface rough = cook_torrance(test::one_wavelength, 0.1, test::constant_index(1.567));
  const Surface white = lambertian(test::one_wavelength, ArrayXd::Constant(1, 0.8));
  const Surface glass = smooth(test::one_wavelength, test::constant_index(1.5));
  Surface sum = rough;
  sum.lobes.push_back(white.lobes.front());
  sum.interfaces.push_back(glass.interfaces.front());
  for (const double theta : {20.0, 60.0, 85.0}) {
    for (const MeasuringGeometry& geometry :
         {test::glossmeter(theta), test::collimated_glossmeter(theta)}) {
      const double parts = test::flux_of(rough, geometry, tolerance) +
                           test::flux_of(white, geometry, tolerance) +
                           test::flux_of(glass, geometry, tolerance);
      EXPECT_TRUE(test::is_close(test::flux_of(sum, geometry, tolerance), parts, 4.0 * tolerance))
          << theta;
    }
  }
}

TEST(Flux, OfAMixtureIsTheMixtureOfFluxes) {
  constexpr double tolerance = 1e-13;
  const Surface rough = cook_torrance(test::one_wavelength, 0.05, test::constant_index(1.567));
  const Surface glass = smooth(test::one_wavelength, test::constant_index(1.567));
  for (const double theta : {20.0, 60.0, 85.0}) {
    const MeasuringGeometry geometry = test::glossmeter(theta);
    const double expected = 0.3 * test::flux_of(rough, geometry, tolerance) +
                            0.7 * test::flux_of(glass, geometry, tolerance);
    EXPECT_TRUE(
        test::is_close(test::flux_of(mixture({rough, glass}, {0.3, 0.7}), geometry, tolerance),
                       expected, 4.0 * tolerance))
        << theta;
  }
}

TEST(Flux, OfASwappedGeometryIsTheSame) {
  // Helmholtz: the roles of source and receptor may change where both have an extent.
  constexpr double tolerance = 1e-13;
  for (const double theta : {20.0, 60.0, 85.0}) {
    const MeasuringGeometry forth = test::glossmeter(theta);
    const MeasuringGeometry back{forth.receptor, forth.source};
    for (const double m : {0.05, 0.2}) {
      const Surface rough = cook_torrance(test::one_wavelength, m, test::constant_index(1.567));
      EXPECT_TRUE(test::is_close(test::flux_of(rough, forth, tolerance),
                                 test::flux_of(rough, back, tolerance), 3.0 * tolerance))
          << theta << " deg, m = " << m;
    }
  }
}

}  // namespace
}  // namespace gonio
