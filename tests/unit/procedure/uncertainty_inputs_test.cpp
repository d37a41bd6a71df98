#include "emulator/procedure/uncertainty_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/expect_close.hpp"
#include "tests/unit/instrument/instrument_file.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using Component = UncertaintyComponent;
using Shape = Distribution::Shape;
using test::instrument_text;
using test::is_close;
using test::load_text;

constexpr double rounding = 1e-15;
const std::vector<std::string> all{"20", "60", "85"};

/// All that has to be stated; lines 5 to 13.
const std::string setup = "setup_uncertainty: {angles: 0.02 deg, apertures: 0.04 deg}\n";
const std::string components =
    "uncertainty:\n"
    "  polarization: {half_width: 0.01}\n"
    "  spectral_mismatch: {half_width: 0.02}\n"
    "  reference_index: {standard_uncertainty: 0.0005}\n"
    "  reference_value: {expanded_uncertainty: 0.4 GU}\n"
    "  linearity: {half_width: 0.0005}\n"
    "  zero: {standard_uncertainty: 0.05 GU}\n"
    "  drift: {standard_uncertainty: 0.001}\n"
    "  temperature: {half_width: 2 K, distribution: arcsine}\n";

Instrument mine(const std::string& more = {}) {
  return load_text(instrument_text(setup + components + more));
}

const InputQuantity& component_of(const UncertaintyInputs& inputs, std::size_t geometry,
                                  Component component) {
  return inputs.set.inputs()[inputs.geometries[geometry].component_index[std::size_t(component)]];
}

/// @return  the message without what stands before line and column.
std::string error_of(const Instrument& instrument,
                     const std::vector<std::string>& geometries = all) {
  const std::string message =
      test::message_of([&] { (void)uncertainty_inputs(instrument, geometries); });
  const std::string file = "mine.yaml";
  const auto at = message.find(file);
  return at == std::string::npos ? message : message.substr(at + file.size());
}

// What there is.

TEST(UncertaintyInputs, AreTheSetUpAndTheComponentsOfEachGeometry) {
  const UncertaintyInputs inputs = uncertainty_inputs(mine(), {"60", "85"});
  ASSERT_EQ(inputs.geometries.size(), 2U);
  EXPECT_EQ(inputs.geometries[0].geometry, "60");
  EXPECT_EQ(inputs.geometries[1].geometry, "85");
  EXPECT_EQ(inputs.geometries[0].setup,
            (std::vector{SetupQuantity::theta_i, SetupQuantity::theta_r,
                         SetupQuantity::source_in_plane, SetupQuantity::source_perpendicular,
                         SetupQuantity::receptor_in_plane, SetupQuantity::receptor_perpendicular}));
  // Both share the index of the glass.
  EXPECT_EQ(inputs.set.size(), 2 * (6 + uncertainty_component_count) - 1);
  for (std::size_t g = 0; g < 2; ++g) {
    for (std::size_t i = 0; i < uncertainty_component_count; ++i) {
      const std::string name = uncertainty_component_names[i];
      EXPECT_EQ(component_of(inputs, g, Component(i)).id,
                name == "reference_index" ? name : inputs.geometries[g].geometry + "/" + name);
    }
  }
  EXPECT_EQ(inputs.geometries[0].component_index[std::size_t(Component::reference_index)],
            inputs.geometries[1].component_index[std::size_t(Component::reference_index)]);
}

TEST(UncertaintyInputs, OfTheSetUpAreInDegreesWithHalfTheirExpandedUncertainty) {
  const Instrument instrument =
      mine("as_built:\n  \"60\": {theta_i: {value: 60.04 deg, expanded_uncertainty: 0.01 deg}}\n");
  const UncertaintyInputs inputs = uncertainty_inputs(instrument, {"60"});
  const auto at = [&](std::size_t i) {
    return inputs.set.inputs()[inputs.geometries[0].setup_index[i]];
  };
  EXPECT_EQ(at(0).id, "60/theta_i");
  EXPECT_EQ(at(0).estimate, 60.04);
  EXPECT_TRUE(is_close(at(0).distribution.standard_uncertainty, 0.005, rounding));
  EXPECT_EQ(at(0).distribution.shape, Shape::normal);
  EXPECT_EQ(at(0).distribution.degrees_of_freedom, std::numeric_limits<double>::infinity());
  EXPECT_EQ(at(1).id, "60/theta_r");
  EXPECT_EQ(at(1).estimate, 60.0);
  EXPECT_TRUE(is_close(at(1).distribution.standard_uncertainty, 0.01, rounding));
  EXPECT_EQ(at(4).id, "60/receptor_in_plane");
  EXPECT_TRUE(is_close(at(4).distribution.standard_uncertainty, 0.02, rounding));
}

TEST(UncertaintyInputs, OfComponentsAreAsStatedAboutWhatTheFileSays) {
  const Instrument instrument = mine(
      "polarization: {\"60\": 0.03}\n"
      "behaviour: {full_scale: {\"20\": 2000 GU, \"60\": 1000 GU, \"85\": 160 GU}, "
      "linearity: 0.0004}\n");
  const UncertaintyInputs inputs = uncertainty_inputs(instrument, all);
  EXPECT_EQ(component_of(inputs, 0, Component::polarization).estimate, 0.0);
  EXPECT_EQ(component_of(inputs, 1, Component::polarization).estimate, 0.03);
  EXPECT_EQ(component_of(inputs, 2, Component::linearity).estimate, 0.0004);
  EXPECT_EQ(component_of(inputs, 1, Component::reference_value).estimate, 0.0);
  EXPECT_EQ(component_of(inputs, 1, Component::reference_value).distribution,
            (Distribution{.standard_uncertainty = 0.2}));
  EXPECT_EQ(component_of(inputs, 1, Component::temperature).distribution,
            Distribution::bounded(Shape::arcsine, 2.0));
}

TEST(UncertaintyInputs, TakeResolutionAndRepeatabilityFromTheBehaviourIfTheyAreNotStated) {
  const std::string behaviour = "repeatability: 0.2 GU\nbehaviour: {resolution: 1 GU}\n";
  const UncertaintyInputs usual = uncertainty_inputs(mine(behaviour), {"60"});
  EXPECT_EQ(component_of(usual, 0, Component::repeatability).distribution,
            (Distribution{.standard_uncertainty = 0.2}));
  EXPECT_EQ(component_of(usual, 0, Component::resolution).distribution,
            Distribution::bounded(Shape::rectangular, 0.5));
  const UncertaintyInputs stated = uncertainty_inputs(
      mine("  repeatability: {standard_uncertainty: 0.3 GU, degrees_of_freedom: 9}\n"
           "  resolution: {half_width: 0.1 GU}\n" +
           behaviour),
      {"60"});
  EXPECT_EQ(component_of(stated, 0, Component::repeatability).distribution,
            (Distribution{.standard_uncertainty = 0.3, .degrees_of_freedom = 9.0}));
  EXPECT_EQ(component_of(stated, 0, Component::resolution).distribution,
            Distribution::bounded(Shape::rectangular, 0.1));
}

TEST(UncertaintyInputs, AreCorrelatedAsStated) {
  const UncertaintyInputs inputs = uncertainty_inputs(
      mine("  correlations:\n"
           "    - {between: [theta_i, theta_r], coefficient: 0.5}\n"
           "    - {between: [theta_r, theta_i], coefficient: -0.2, geometry: \"85\"}\n"
           "    - {between: [zero, reference_index], coefficient: 0.1, geometry: \"20\"}\n"),
      {"60", "85"});
  const auto between = [&](std::size_t geometry) {
    const auto& at = inputs.geometries[geometry].setup_index;
    return inputs.set.correlation()(Eigen::Index(at[0]), Eigen::Index(at[1]));
  };
  EXPECT_EQ(between(0), 0.5);
  EXPECT_EQ(between(1), -0.2);
  // Nothing else is, the geometry that was not asked for included.
  const auto n = double(inputs.set.size());
  EXPECT_TRUE(is_close(inputs.set.correlation().sum(), n + 2.0 * (0.5 - 0.2), 1e-12));
}

TEST(UncertaintyInputs, OfShippedInstrumentsAreComplete) {
  for (const char* id : {"triangle_gloss", "pocket_gloss_60"}) {
    const Instrument instrument =
        load_instrument(test::shipped().find(Catalog::Kind::instrument, id), test::shipped());
    const UncertaintyInputs inputs = uncertainty_inputs(instrument, instrument.geometries);
    for (const InputQuantity& input : inputs.set.inputs()) {
      EXPECT_GT(input.distribution.standard_uncertainty, 0.0) << id << ' ' << input.id;
    }
    EXPECT_GT(inputs.set.smallest_eigenvalue(), 0.1) << id;
  }
}

// What is missing.

TEST(UncertaintyInputErrors, NameTheFirstComponentThatIsNotStated) {
  EXPECT_EQ(error_of(load_text(instrument_text(setup))),
            ": uncertainty.polarization: expected an uncertainty for the geometry '20', found "
            "nothing");
  std::string without_zero = components;
  without_zero.erase(without_zero.find("  zero"),
                     without_zero.find("  drift") - without_zero.find("  zero"));
  EXPECT_EQ(error_of(load_text(instrument_text(setup + without_zero))),
            ":7:3: uncertainty.zero: expected an uncertainty in GU for the geometry '20', found "
            "nothing");
  EXPECT_EQ(error_of(load_text(instrument_text(setup + without_zero +
                                               "  zero: {\"20\": {half_width: 0.1 GU}}\n"))),
            ":7:3: uncertainty.zero.60: expected an uncertainty in GU for the geometry '60', "
            "found nothing");
}

TEST(UncertaintyInputErrors, NameTheQuantityOfTheSetUpThatIsNotStated) {
  EXPECT_EQ(error_of(load_text(instrument_text(components))),
            ": as_built.20.theta_i: expected its expanded_uncertainty, or the key "
            "'setup_uncertainty' for all, found nothing");
  EXPECT_EQ(error_of(load_text(instrument_text("setup_uncertainty: {angles: 0.01 deg}\n"
                                               "as_built:\n"
                                               "  \"60\": {theta_i: 60.02 deg}\n" +
                                               components)),
                     {"60"}),
            ":7:9: as_built.60.source.in_plane: expected its expanded_uncertainty, or the key "
            "'setup_uncertainty' for all, found nothing");
}

TEST(UncertaintyInputErrors, OfAnInstrumentWithoutAFileNameTheInstrument) {
  EXPECT_EQ(error_of(nominal_instrument(test::shipped_standard("iso_2813/2014"))),
            "nominal: uncertainty.polarization: expected an uncertainty for the geometry '20', "
            "found nothing");
}

// Correlations that cannot be.

TEST(UncertaintyInputErrors, OfCorrelationsThatContradictEachOther) {
  EXPECT_EQ(error_of(mine("  correlations:\n"
                          "    - {between: [theta_i, theta_r], coefficient: -0.9}\n"
                          "    - {between: [theta_i, zero], coefficient: -0.9}\n"
                          "    - {between: [zero, theta_r], coefficient: -0.9}\n")),
            ":16:5: uncertainty.correlations: expected correlations that can hold together (a "
            "positive definite matrix), found 'the eigenvalue -0.8'");
}

TEST(UncertaintyInputErrors, OfCorrelationsOfWhatIsNotNormal) {
  EXPECT_EQ(error_of(mine("  correlations: [{between: [zero, linearity], coefficient: 0.1}]\n")),
            ":15:18: uncertainty.correlations[0]: expected normal quantities without "
            "degrees_of_freedom, found '20/linearity'");
  EXPECT_EQ(
      error_of(mine("  repeatability: {standard_uncertainty: 1 GU, degrees_of_freedom: 4}\n"
                    "  correlations: [{between: [repeatability, zero], coefficient: 0.1}]\n")),
      ":16:18: uncertainty.correlations[0]: expected normal quantities without "
      "degrees_of_freedom, found '20/repeatability'");
}

TEST(UncertaintyInputErrors, OfCorrelationsOfWhatIsNotThere) {
  EXPECT_EQ(error_of(mine("  correlations: [{between: [zero, source_diameter], coefficient: 0.1, "
                          "geometry: \"60\"}]\n"),
                     {"20"}),
            ":15:18: uncertainty.correlations[0]: expected two quantities of the geometry '60', "
            "found 'zero, source_diameter'");
  EXPECT_EQ(
      error_of(mine("  correlations: [{between: [source_diameter, zero], coefficient: 0.1}]\n")),
      ":15:18: uncertainty.correlations[0]: expected two quantities of one geometry, found "
      "'source_diameter, zero'");
}

TEST(UncertaintyInputErrors, OfACallerNameTheGeometry) {
  EXPECT_THROW((void)uncertainty_inputs(mine(), {"45"}), std::invalid_argument);
  EXPECT_EQ(error_of(mine(), {"45"}), "uncertainty_inputs: mine has no geometry '45'");
}

}  // namespace
}  // namespace gonio
