#include "emulator/goniometry/validation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/optics/fresnel.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

using testing::HasSubstr;

Catalog catalog() { return Catalog({GONIO_SOURCE_DIR}); }

constexpr double index_of_refraction = 1.5;

const std::string plan_text = R"(schema: gonio/validation/1
id: made
title: Made for a test
source: nobody
instrument: paper_setup
patches: 64
convergence: [32, 64]
materials:
  - id: glass
    title: Glass
    rms_slope: 0.05
    printed_percent: {"60": 5}
    refractive_indices: [{author: nobody, index: 1.5}]
)";

ValidationPlan plan_of(const std::string& text) {
  const TemporaryFolder folder;
  return load_validation_plan(folder.file("plan.yaml", text), catalog());
}

/// What is wrong with the plan once `part` is replaced.
std::string error_with(const std::string& part, const std::string& by) {
  std::string text = plan_text;
  text.replace(text.find(part), part.size(), by);
  return message_of([&] { (void)plan_of(text); });
}

TEST(SpectralDeviation, IsNoneFromItself) {
  const Eigen::ArrayXd r = Eigen::ArrayXd::LinSpaced(5, 0.2, 0.6);
  const SpectralDeviation deviation = spectral_deviation(r, r);
  EXPECT_EQ(deviation.ratio, 1.0);
  EXPECT_EQ(deviation.relative_rmse, 0.0);
  EXPECT_EQ(deviation.shape_rmse, 0.0);
}

TEST(SpectralDeviation, OfAFactorIsNoneInShape) {
  const Eigen::ArrayXd r = Eigen::ArrayXd::Constant(5, 0.5);
  const SpectralDeviation deviation = spectral_deviation(1.5 * r, r);
  EXPECT_DOUBLE_EQ(deviation.ratio, 1.5);
  EXPECT_DOUBLE_EQ(deviation.relative_rmse, 0.5);
  EXPECT_NEAR(deviation.shape_rmse, 0.0, 1e-15);
}

/// r = (1, 3), v = (2, 2): differences of 1 from a mean of 2; the best factor is 8 / 8.
TEST(SpectralDeviation, EqualsItsClosedForm) {
  const SpectralDeviation deviation =
      spectral_deviation(Eigen::Array2d(2.0, 2.0), Eigen::Array2d(1.0, 3.0));
  EXPECT_DOUBLE_EQ(deviation.ratio, 1.0);
  EXPECT_DOUBLE_EQ(deviation.relative_rmse, 0.5);
  EXPECT_DOUBLE_EQ(deviation.shape_rmse, 0.5);
}

TEST(SpectralDeviation, HasSpectraOfOneLength) {
  EXPECT_THROW((void)spectral_deviation(Eigen::Array2d(1, 1), Eigen::Array3d(1, 1, 1)),
               std::invalid_argument);
  EXPECT_THROW((void)spectral_deviation(Eigen::Array2d(1, 1), Eigen::Array2d(0, 0)),
               std::invalid_argument);
}

struct ValidationOfGlass : testing::Test {
  static void SetUpTestSuite() {
    result = validate(plan, [](std::size_t done, std::size_t total) {
      last = done;
      all = total;
    });
  }
  static const ValidationGeometry& geometry(std::size_t g) {
    return result.materials.at(0).authors.at(0).geometries.at(g);
  }
  static const SimulatedSpectrum& spectrum(std::size_t g, ValidationModel model,
                                           ValidationIntegrator integrator) {
    for (const SimulatedSpectrum& spectrum : geometry(g).simulated) {
      if (spectrum.model == model && spectrum.integrator == integrator) {
        return spectrum;
      }
    }
    throw std::logic_error("no such spectrum");
  }
  inline static ValidationPlan plan = plan_of(plan_text);
  inline static ValidationResult result;
  inline static std::size_t last = 0, all = 0;
};

TEST_F(ValidationOfGlass, HoldsAllGeometriesOfTheInstrument) {
  EXPECT_THAT(result.geometries, testing::ElementsAre("20", "60", "85"));
  EXPECT_EQ(last, all);
  EXPECT_GT(all, 0u);
}

TEST_F(ValidationOfGlass, ComparesWithFresnelsReflectance) {
  for (std::size_t g = 0; g < 3; ++g) {
    const double theta = plan.instrument.angle_of_incidence(result.geometries[g]).radians();
    const double rho = fresnel_reflectance(std::cos(theta), index_of_refraction);
    EXPECT_NEAR(geometry(g).exact.minCoeff(), rho, 1e-15);
    EXPECT_NEAR(geometry(g).exact.maxCoeff(), rho, 1e-15);
  }
}

/// Over the 4.7 deg of the source, reflectance bends away from that on its axis.
TEST_F(ValidationOfGlass, FindsASmoothSurfaceNearlyExact) {
  constexpr double bend = 2.5e-3;  // relative, at 60 deg
  const auto& at_60 = spectrum(1, ValidationModel::smooth, ValidationIntegrator::aperture);
  EXPECT_LT(at_60.deviation.relative_rmse, bend);
  EXPECT_GT(at_60.deviation.relative_rmse, 0.0);
}

TEST_F(ValidationOfGlass, SeesFourTimesAsMuchAsPrinted) {
  constexpr double integration = 1e-4;  // relative: 1e-3 GU each
  for (std::size_t g = 0; g < 3; ++g) {
    for (const auto integrator : {ValidationIntegrator::aperture, ValidationIntegrator::patches}) {
      const double conserving =
          spectrum(g, ValidationModel::energy_conserving, integrator).deviation.ratio;
      EXPECT_TRUE(
          is_close_relative(spectrum(g, ValidationModel::as_printed, integrator).deviation.ratio,
                            4.0 * conserving, integration));
      EXPECT_LT(conserving, 1.0);
    }
  }
}

TEST_F(ValidationOfGlass, FindsTheSlopeThatReadsTheExactReflectance) {
  constexpr double integration = 1e-4;
  const Glossmeter glossmeter(plan.instrument, result.grid, std::make_shared<ApertureIntegrator>());
  const Eigen::ArrayXcd n_hat = Eigen::ArrayXcd::Constant(result.grid.size(), index_of_refraction);
  for (std::size_t g = 0; g < 3; ++g) {
    const Surface surface = cook_torrance(result.grid, geometry(g).matching_slope.value(), n_hat,
                                          {}, Normalization::as_printed);
    EXPECT_TRUE(
        is_close_relative(glossmeter.read(surface, result.geometries[g], 1e-4).reflectance.mean(),
                          geometry(g).exact.mean(), integration));
  }
}

TEST_F(ValidationOfGlass, SeesThePatchMethodConverge) {
  const std::vector<ConvergencePoint>& points = result.materials.at(0).convergence;
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1].resolution, 64);
  const auto& at_60 =
      spectrum(1, ValidationModel::energy_conserving, ValidationIntegrator::patches);
  const auto& exact =
      spectrum(1, ValidationModel::energy_conserving, ValidationIntegrator::aperture);
  constexpr double integration = 1e-4;
  EXPECT_NEAR(points[1].difference.at(1), at_60.deviation.ratio / exact.deviation.ratio - 1.0,
              integration);
}

TEST(ValidationConvergence, HasNoAnswerWithoutAPatch) {
  std::string text = plan_text;
  text.replace(text.find("[32, 64]"), 8, "[4]");
  const ValidationResult result = validate(plan_of(text));
  EXPECT_TRUE(std::isnan(result.materials.at(0).convergence.at(0).difference.at(0)));
}

TEST(ValidationPlan, TellsWhatIsWrong) {
  EXPECT_THAT(error_with("patches: 64", "patches: 66"),
              HasSubstr("plan.yaml:6:10: patches: expected a multiple of 4, found '66'"));
  EXPECT_THAT(error_with("[32, 64]", "[64, 32]"),
              HasSubstr("expected a resolution above the 64 before it, found '32'"));
  EXPECT_THAT(error_with("{\"60\": 5}", "{\"45\": 5}"),
              HasSubstr("expected a geometry of paper_setup, found '45'"));
  EXPECT_THAT(error_with("rms_slope: 0.05", "rms_slope: 0"), HasSubstr("rms_slope"));
  EXPECT_THAT(error_with("title: Glass", "titel: Glass"), HasSubstr("title"));
  EXPECT_THAT(error_with("instrument: paper_setup", "instrument: nobody"), HasSubstr("nobody"));
}

TEST(ValidationPlan, OfThePaperShips) {
  const ValidationPlan plan =
      load_validation_plan(catalog().fixture("validation/mihalik.yaml"), catalog());
  EXPECT_EQ(plan.patches, 256);
  EXPECT_EQ(plan.materials.at(0).rms_slope, 0.065);
  EXPECT_EQ(plan.materials.at(1).printed_percent.at("85"), 21.65);
}

}  // namespace
}  // namespace gonio::test
