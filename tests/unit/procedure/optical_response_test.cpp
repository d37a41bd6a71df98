#include "emulator/procedure/optical_response.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/procedure/responses.hpp"

namespace gonio {
namespace {

using Eigen::ArrayXcd;
using Eigen::Index;
using Eigen::VectorXd;
using test::few_wavelengths;
using test::glass_reflectance;
using test::is_close;
using test::nominal_iso_2813;
using test::nominal_with;
using test::rungs;
using test::shipped_instrument;
using test::shipped_standard;
using test::three_angles;
using test::tolerance_gu;
using testing::ElementsAre;

Sample rough_glass(double rms_slope) {
  return {
      .file = {},
      .id = "rough",
      .surface = cook_torrance(few_wavelengths, rms_slope, ArrayXcd::Constant(3, {1.567, 0.0}))};
}

TEST(OpticalResponse, HasTheParametersOfTheInstrumentAsBuiltAndOfTheStandard) {
  Instrument instrument = shipped_instrument("triangle_gloss");
  instrument.polarization["60"] = 0.02;
  const std::vector<Sample> mirror = rungs({"ideal_mirror"});
  const OpticalResponse response(instrument, "60", mirror, tolerance_gu);
  EXPECT_THAT(response.quantities(),
              ElementsAre(SetupQuantity::theta_i, SetupQuantity::theta_r,
                          SetupQuantity::source_in_plane, SetupQuantity::source_perpendicular,
                          SetupQuantity::receptor_in_plane, SetupQuantity::receptor_perpendicular));
  ASSERT_EQ(response.size(), 8);
  const VectorXd built{{60.04, 59.97, 0.80, 2.4, 4.43, 11.62, 0.02, 0.0}};
  const VectorXd by_standard{{60, 60, 0.75, 2.5, 4.4, 11.7, 0, 0}};
  EXPECT_LT((response.as_built() - built).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((response.nominal() - by_standard).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(OpticalResponse, ReadsWhatTheGlossmeterReads) {
  Instrument instrument = shipped_instrument("triangle_gloss");
  instrument.polarization["85"] = -0.03;
  const std::vector<Sample> ladder = effect_ladder(few_wavelengths);
  for (const std::string& geometry : three_angles) {
    const OpticalResponse response(instrument, geometry, ladder, tolerance_gu);
    const VectorXd gloss_gu = response(response.as_built());
    const Glossmeter meter(instrument, few_wavelengths, std::make_shared<ApertureIntegrator>());
    for (std::size_t s = 0; s < ladder.size(); ++s) {
      const double expected = meter.read(ladder[s].surface, geometry, tolerance_gu).gloss;
      EXPECT_TRUE(is_close(gloss_gu(Index(s)), expected, 2 * tolerance_gu)) << ladder[s].id;
    }
  }
}

TEST(OpticalResponse, ByTheStandardIsTheNominalInstrument) {
  const std::vector<Sample> ladder = rungs({"red_paint_m150", "glass_m050", "copper_m065"});
  const OpticalResponse built(shipped_instrument("triangle_gloss"), "60", ladder, tolerance_gu);
  const OpticalResponse expected(nominal_iso_2813(), "60", ladder, tolerance_gu);
  const VectorXd error =
      built.with_standard_spectra(built.nominal()) - expected(expected.nominal());
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 2 * tolerance_gu);
  // The lamp makes a red sample read otherwise.
  EXPECT_GT(std::abs(built(built.nominal())(0) - expected(expected.nominal())(0)), 1e-3);
}

TEST(OpticalResponse, ReadsTheReferenceWhereTheStandardDoes) {
  Instrument instrument = nominal_instrument(shipped_standard("iso_13803/2014"));
  const std::string relative = instrument.standard.geometries.back().id;
  ASSERT_EQ(instrument.standard.geometry(relative).relative_to, "20");
  instrument = with_quantity(instrument, relative, SetupQuantity::receptor_perpendicular,
                             {.value = degrees(5.4)});
  const std::vector<Sample> rough = rungs({"glass_m050"});
  const OpticalResponse response(instrument, relative, rough, tolerance_gu);
  VectorXd parameters = response.as_built();
  const double before = response(parameters)(0);
  // Were the tile read through the same polarised light, it would take part of this back.
  constexpr double P = 0.1;
  parameters(response.size() - 2) = P;
  const double diattenuation =
      fresnel_difference(std::cos(degrees(20).radians()), ArrayXcd::Constant(1, {1.567, 0.0}))(0) /
      glass_reflectance(20, 1.567);
  constexpr double of_facets = 0.02;  // the angle of incidence on them is not 20 deg
  EXPECT_TRUE(is_close(response(parameters)(0) / before - 1.0, P * diattenuation, of_facets * P));
}

TEST(OpticalResponse, OfOneSampleIsThatRow) {
  const std::vector<Sample> ladder = rungs({"white_diffuser", "glass_m050", "copper_m065"});
  const OpticalResponse response(shipped_instrument("triangle_gloss"), "60", ladder, tolerance_gu);
  const OpticalResponse one = response.of_sample(1);
  ASSERT_EQ(one(one.as_built()).size(), 1);
  EXPECT_EQ(one(one.as_built())(0), response(response.as_built())(1));
}

TEST(OpticalResponse, WithAnotherToleranceIsAsGoodAsThat) {
  constexpr double coarse_gu = 0.1;
  const std::vector<Sample> rough = rungs({"glass_m020", "copper_m065"});
  const OpticalResponse response(shipped_instrument("triangle_gloss"), "85", rough, tolerance_gu);
  const VectorXd coarse = response.with_tolerance(coarse_gu)(response.as_built());
  const double error = (coarse - response(response.as_built())).cwiseAbs().maxCoeff();
  EXPECT_GT(error, 2 * tolerance_gu);
  EXPECT_LT(error, coarse_gu);
}

TEST(OpticalResponse, TakesAnOpeningWithSwappedEdgesForTheSame) {
  const std::vector<Sample> rough = rungs({"glass_m050"});
  const OpticalResponse response(nominal_iso_2813(), "60", rough, tolerance_gu);
  const VectorXd open = nominal_with(response, {{SetupQuantity::source_in_plane, 0.3}});
  const VectorXd swapped = nominal_with(response, {{SetupQuantity::source_in_plane, -0.3}});
  EXPECT_EQ(response(open), response(swapped));
}

TEST(OpticalResponse, RefusesParametersOutsideTheirRange) {
  const std::vector<Sample> mirror = rungs({"ideal_mirror"});
  const OpticalResponse response(nominal_iso_2813(), "60", mirror, tolerance_gu);
  for (const auto& [quantity, value] :
       std::vector<std::pair<SetupQuantity, double>>{{SetupQuantity::theta_i, 90.0},
                                                     {SetupQuantity::theta_r, -90.0},
                                                     {SetupQuantity::theta_i, std::nan("")},
                                                     {SetupQuantity::receptor_in_plane, 121.0}}) {
    EXPECT_THROW((void)response(nominal_with(response, {{quantity, value}})), std::domain_error);
  }
  VectorXd parameters = response.nominal();
  parameters(response.size() - 2) = 1.01;
  EXPECT_THROW((void)response(parameters), std::domain_error);
  parameters = response.nominal();
  parameters(response.size() - 1) = 1.0;  // no weight left at 450 nm
  EXPECT_THROW((void)response(parameters), std::domain_error);
  EXPECT_THROW((void)response(VectorXd::Zero(3)), std::domain_error);
  EXPECT_THROW((void)response.jacobian(response.nominal(), -VectorXd::Ones(8)), std::domain_error);
}

TEST(OpticalResponse, NeedsSamplesAGeometryAndAllSizes) {
  const std::vector<Sample> none, mirror = rungs({"ideal_mirror"});
  EXPECT_THROW((void)OpticalResponse(nominal_iso_2813(), "60", none, tolerance_gu),
               std::invalid_argument);
  EXPECT_THROW((void)OpticalResponse(nominal_iso_2813(), "61", mirror, tolerance_gu),
               std::invalid_argument);
  const Instrument paper = nominal_instrument(shipped_standard("tappi_t480/om_15"));
  EXPECT_THROW((void)OpticalResponse(paper, "75", mirror, tolerance_gu), InputError);
}

// Figures published for lobes in apertures at both ends of their tolerances.
TEST(OpticalResponse, OfLobesGivesTheFiguresKnown) {
  constexpr double rounding_gu = 0.0051;
  struct Known {
    std::string geometry;
    double rms_slope;
    SetupQuantity in_plane, perpendicular;
    std::vector<std::array<double, 3>> rows;  // both sizes in deg, and gloss
  };
  const auto receptor = SetupQuantity::receptor_in_plane;
  const auto receptor_p = SetupQuantity::receptor_perpendicular;
  const auto source = SetupQuantity::source_in_plane;
  const auto source_p = SetupQuantity::source_perpendicular;
  const std::vector<Known> all{
      {"60",
       0.03,
       receptor,
       receptor_p,
       {{4.3, 11.5, 62.20}, {4.4, 11.7, 63.30}, {4.5, 11.9, 64.38}}},
      {"60",
       0.05,
       receptor,
       receptor_p,
       {{4.3, 11.5, 40.13}, {4.4, 11.7, 41.02}, {4.5, 11.9, 41.90}}},
      {"60",
       0.10,
       receptor,
       receptor_p,
       {{4.3, 11.5, 17.57}, {4.4, 11.7, 18.13}, {4.5, 11.9, 18.68}}},
      {"20", 0.01, source, source_p, {{0.5, 2.0, 68.40}, {0.75, 2.5, 65.65}, {1.0, 3.0, 62.09}}},
      {"20", 0.02, source, source_p, {{0.5, 2.0, 30.66}, {0.75, 2.5, 29.80}, {1.0, 3.0, 28.77}}}};
  for (const Known& known : all) {
    const std::vector<Sample> rough{rough_glass(known.rms_slope)};
    const OpticalResponse response(nominal_iso_2813(), known.geometry, rough, tolerance_gu);
    for (const auto& [in_plane, perpendicular, gloss_gu] : known.rows) {
      const VectorXd parameters = nominal_with(
          response, {{known.in_plane, in_plane}, {known.perpendicular, perpendicular}});
      EXPECT_TRUE(is_close(response(parameters)(0), gloss_gu, rounding_gu))
          << known.geometry << ", slope " << known.rms_slope;
    }
  }
}

// Figures for a step of 0.1 deg of incidence.
TEST(OpticalResponse, OfIncidenceGivesTheFiguresKnown) {
  constexpr double rounding_gu = 0.0006;  // and what the source, which has a size, averages over
  const std::vector<double> of_paint{0.001, 0.043, 0.025}, of_a_mirror{0.012, 0.50, 0.92};
  const std::vector<Sample> smooth = rungs({"paint_smooth", "ideal_mirror"});
  for (std::size_t g = 0; g < three_angles.size(); ++g) {
    const OpticalResponse response(nominal_iso_2813(), three_angles[g], smooth, tolerance_gu);
    const VectorXd before = response(response.nominal());
    const VectorXd change =
        response(
            nominal_with(response, {{SetupQuantity::theta_i, std::stod(three_angles[g]) + 0.1}})) -
        before;
    EXPECT_TRUE(is_close(std::abs(change(0)), of_paint[g], rounding_gu)) << three_angles[g];
    EXPECT_TRUE(is_close(-100.0 * change(1) / before(1), of_a_mirror[g], 10 * rounding_gu))
        << three_angles[g];
  }
}

}  // namespace
}  // namespace gonio
