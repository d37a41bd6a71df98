#include "emulator/instrument/uncertainty_statement.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/unit/instrument/instrument_file.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using Component = UncertaintyComponent;
using Shape = Distribution::Shape;
using test::error_of;
using test::instrument_text;
using test::load_text;

const std::vector<std::string> geometries{"20", "60", "85"};
constexpr double infinite = std::numeric_limits<double>::infinity();

UncertaintyStatement read(const std::string& text, UncertaintyStatement before = {}) {
  return read_uncertainty(YamlNode::parse(text, "u.yaml"), geometries, std::move(before));
}

Distribution stated(const std::string& text, Component component, const std::string& id = "60") {
  return read(text).components.at(component).at(id);
}

std::string error_in(const std::string& text) {
  return test::message_of([&] { (void)read(text); });
}

// What it accepts.

TEST(UncertaintyStatement, TakesAStandardUncertainty) {
  EXPECT_EQ(stated("reference_index: {standard_uncertainty: 0.0005}", Component::reference_index),
            (Distribution{.standard_uncertainty = 0.0005}));
  EXPECT_EQ(
      stated("drift: {standard_uncertainty: 0.002, degrees_of_freedom: 4.5}", Component::drift),
      (Distribution{.standard_uncertainty = 0.002, .degrees_of_freedom = 4.5}));
  EXPECT_EQ(stated("zero: {standard_uncertainty: 0 GU, distribution: normal}", Component::zero),
            (Distribution{.shape = Shape::normal, .standard_uncertainty = 0.0}));
}

TEST(UncertaintyStatement, DividesAnExpandedUncertaintyByItsFactor) {
  EXPECT_EQ(stated("reference_value: {expanded_uncertainty: 0.4 GU}", Component::reference_value),
            (Distribution{.standard_uncertainty = 0.2}));
  EXPECT_EQ(stated("reference_value: {expanded_uncertainty: 0.6 GU, coverage_factor: 2.5, "
                   "degrees_of_freedom: 6}",
                   Component::reference_value),
            (Distribution{.standard_uncertainty = 0.24, .degrees_of_freedom = 6.0}));
}

TEST(UncertaintyStatement, TakesHalfAWidthAsRectangularOrAsItSays) {
  EXPECT_EQ(stated("polarization: {half_width: 0.01}", Component::polarization),
            Distribution::bounded(Shape::rectangular, 0.01));
  const auto of_shape = [](const std::string& shape) {
    return stated("temperature: {half_width: 2 K, distribution: " + shape + "}",
                  Component::temperature);
  };
  EXPECT_EQ(of_shape("rectangular"), Distribution::bounded(Shape::rectangular, 2.0));
  EXPECT_EQ(of_shape("triangular"), Distribution::bounded(Shape::triangular, 2.0));
  EXPECT_EQ(of_shape("arcsine"), Distribution::bounded(Shape::arcsine, 2.0));
  EXPECT_EQ(of_shape("arcsine").degrees_of_freedom, infinite);
}

TEST(UncertaintyStatement, IsOfAllGeometriesOrOfThoseNamed) {
  const UncertaintyStatement statement = read(
      "zero: {standard_uncertainty: 0.1 GU}\n"
      "drift: {\"20\": {half_width: 0.001}, \"85\": {standard_uncertainty: 0.002}}\n");
  EXPECT_EQ(statement.components.size(), 2U);
  for (const std::string& id : geometries) {
    EXPECT_EQ(statement.components.at(Component::zero).at(id).standard_uncertainty, 0.1);
  }
  const auto& drift = statement.components.at(Component::drift);
  EXPECT_EQ(drift.size(), 2U);
  EXPECT_EQ(drift.at("20"), Distribution::bounded(Shape::rectangular, 0.001));
  EXPECT_EQ(drift.at("85"), (Distribution{.standard_uncertainty = 0.002}));
}

TEST(UncertaintyStatement, KnowsEveryComponentByItsNameAndUnit) {
  for (std::size_t i = 0; i < uncertainty_component_count; ++i) {
    const std::string unit = uncertainty_component_units[i];
    const std::string name = uncertainty_component_names[i];
    EXPECT_EQ(
        stated(name + ": {standard_uncertainty: 0.25" + (unit.empty() ? "" : " " + unit) + "}",
               Component(i))
            .standard_uncertainty,
        0.25)
        << name;
  }
}

TEST(UncertaintyStatement, TakesCorrelations) {
  const UncertaintyStatement statement = read(
      "correlations:\n"
      "  - {between: [theta_i, theta_r], coefficient: 0.5}\n"
      "  - {between: [zero, drift], coefficient: -1, geometry: \"85\"}\n");
  ASSERT_EQ(statement.correlations.size(), 2U);
  EXPECT_EQ(statement.correlations[0].a, "theta_i");
  EXPECT_EQ(statement.correlations[0].b, "theta_r");
  EXPECT_EQ(statement.correlations[0].coefficient, 0.5);
  EXPECT_EQ(statement.correlations[0].geometry, std::nullopt);
  EXPECT_EQ(statement.correlations[1].geometry, "85");
  EXPECT_EQ(statement.correlations[1].coefficient, -1.0);
  EXPECT_EQ(statement.correlations[1].mark.text(), "u.yaml:3:5: correlations[1]");
  EXPECT_EQ(statement.correlations_mark.text(), "u.yaml:2:3: correlations");
}

TEST(UncertaintyStatement, LeavesWhatIsNotStatedAsItWas) {
  const UncertaintyStatement before = read(
      "zero: {standard_uncertainty: 0.1 GU}\n"
      "drift: {standard_uncertainty: 0.001}\n"
      "correlations: [{between: [zero, drift], coefficient: 0.1}]\n");
  const UncertaintyStatement after =
      read("drift: {\"60\": {standard_uncertainty: 0.005}}\n", before);
  EXPECT_EQ(after.components.at(Component::zero), before.components.at(Component::zero));
  EXPECT_EQ(after.components.at(Component::drift).at("60").standard_uncertainty, 0.005);
  EXPECT_EQ(after.components.at(Component::drift).at("85").standard_uncertainty, 0.001);
  EXPECT_EQ(after.correlations.size(), 1U);
  EXPECT_EQ(read("correlations: [{between: [zero, theta_i], coefficient: 0.2}]\n", before)
                .correlations.at(0)
                .b,
            "theta_i");
}

TEST(UncertaintyStatement, IsPartOfAnInstrument) {
  EXPECT_FALSE(load_text(instrument_text("")).uncertainty.has_value());
  const Instrument mine =
      load_text(instrument_text("uncertainty:\n  zero: {standard_uncertainty: 0.1 GU}\n"));
  ASSERT_TRUE(mine.uncertainty.has_value());
  EXPECT_EQ(mine.uncertainty->components.at(Component::zero).at("85").standard_uncertainty, 0.1);
  EXPECT_EQ(mine.uncertainty->mark.line, 6);
  EXPECT_EQ(mine.uncertainty->mark.key, "uncertainty");
}

// What it refuses.

TEST(UncertaintyStatementErrors, OfFormsThatContradictEachOther) {
  EXPECT_EQ(error_in("zero: {distribution: normal}"),
            "u.yaml:1:7: zero: expected one of the keys standard_uncertainty, "
            "expanded_uncertainty, half_width, found 'none'");
  EXPECT_EQ(error_in("zero: {standard_uncertainty: 1 GU, half_width: 1 GU}"),
            "u.yaml:1:7: zero: expected one of the keys standard_uncertainty, "
            "expanded_uncertainty, half_width, found 'standard_uncertainty, half_width'");
  EXPECT_EQ(error_in("zero: {half_width: 1 GU, degrees_of_freedom: 3}"),
            "u.yaml:1:26: zero.degrees_of_freedom: expected one of the keys distribution, "
            "expanded_uncertainty, half_width, standard_uncertainty, found 'degrees_of_freedom'");
  EXPECT_EQ(error_in("zero: {standard_uncertainty: 1 GU, coverage_factor: 2}"),
            "u.yaml:1:36: zero.coverage_factor: expected one of the keys degrees_of_freedom, "
            "distribution, expanded_uncertainty, half_width, standard_uncertainty, found "
            "'coverage_factor'");
  EXPECT_EQ(error_in("zero: {standard_uncertainty: 1 GU, distribution: rectangular}"),
            "u.yaml:1:50: zero.distribution: expected one of normal, found 'rectangular'");
  EXPECT_EQ(error_in("zero: {half_width: 1 GU, distribution: normal}"),
            "u.yaml:1:40: zero.distribution: expected one of rectangular, triangular, arcsine, "
            "found 'normal'");
}

TEST(UncertaintyStatementErrors, OfNumbersAndUnits) {
  EXPECT_EQ(error_in("zero: {standard_uncertainty: -0.1 GU}"),
            "u.yaml:1:30: zero.standard_uncertainty: expected a gloss value (GU) >= 0, found "
            "'-0.1 GU'");
  EXPECT_EQ(error_in("zero: {standard_uncertainty: 0.1}"),
            "u.yaml:1:30: zero.standard_uncertainty: expected a gloss value (GU) >= 0, found "
            "'0.1'");
  EXPECT_EQ(error_in("drift: {half_width: 0.1 GU}"),
            "u.yaml:1:21: drift.half_width: expected a number >= 0, found '0.1 GU'");
  EXPECT_EQ(error_in("temperature: {half_width: 2 degC}"),
            "u.yaml:1:27: temperature.half_width: expected a temperature difference (K) >= 0, "
            "found '2 degC'");
  EXPECT_EQ(error_in("drift: {expanded_uncertainty: 0.1, coverage_factor: 0}"),
            "u.yaml:1:53: drift.coverage_factor: expected a number > 0, found '0'");
  EXPECT_EQ(error_in("drift: {standard_uncertainty: 0.1, degrees_of_freedom: -2}"),
            "u.yaml:1:56: drift.degrees_of_freedom: expected a number > 0, found '-2'");
  EXPECT_EQ(error_in("drift: 0.1"),
            "u.yaml:1:8: drift: expected a map of keys and values, found '0.1'");
}

TEST(UncertaintyStatementErrors, OfNamesThatNobodyKnows) {
  EXPECT_EQ(error_in("stray_light: {half_width: 1 GU}"),
            "u.yaml:1:1: stray_light: expected one of the keys correlations, drift, linearity, "
            "polarization, reference_index, reference_value, repeatability, resolution, "
            "spectral_mismatch, temperature, zero, found 'stray_light'");
  EXPECT_EQ(error_in("zero: {\"45\": {half_width: 1 GU}}"),
            "u.yaml:1:14: zero.45: expected one of the geometries 20, 60, 85, found '45'");
  EXPECT_EQ(error_in("zero: {\"60\": {half_widht: 1 GU}}"),
            "u.yaml:1:14: zero.60: expected one of the keys standard_uncertainty, "
            "expanded_uncertainty, half_width, found 'none'");
  EXPECT_EQ(error_in("reference_index: {\"60\": {half_width: 0.001}}"),
            "u.yaml:1:18: reference_index: expected one uncertainty, since all geometries stand "
            "on one glass, found 'one by geometry'");
}

TEST(UncertaintyStatementErrors, OfCorrelations) {
  const auto error = [](const std::string& item) {
    return error_in("correlations: [" + item + "]");
  };
  EXPECT_EQ(error("{between: [zero, drift], coefficient: 1.1}"),
            "u.yaml:1:54: correlations[0].coefficient: expected a number in [-1, 1], found '1.1'");
  EXPECT_EQ(error("{between: [zero], coefficient: 1}"),
            "u.yaml:1:26: correlations[0].between: expected a list of two quantities, found '1'");
  EXPECT_EQ(error("{between: [zero, zero], coefficient: 1}"),
            "u.yaml:1:33: correlations[0].between[1]: expected another quantity than the first, "
            "found 'zero'");
  EXPECT_EQ(error("{between: [zero, lamp], coefficient: 1}"),
            "u.yaml:1:33: correlations[0].between[1]: expected one of theta_i, theta_r, "
            "source_in_plane, source_perpendicular, source_diameter, receptor_in_plane, "
            "receptor_perpendicular, receptor_diameter, polarization, spectral_mismatch, "
            "reference_index, reference_value, linearity, zero, drift, temperature, resolution, "
            "repeatability, found 'lamp'");
  EXPECT_EQ(error("{between: [zero, drift], coefficient: 1, geometry: \"45\"}"),
            "u.yaml:1:67: correlations[0].geometry: expected one of 20, 60, 85, found '45'");
  EXPECT_EQ(error("{between: [zero, drift]}"),
            "u.yaml:1:16: correlations[0].coefficient: expected the key 'coefficient', found "
            "'only between'");
  EXPECT_EQ(error(""),
            "u.yaml:1:15: correlations: expected a list of at least one item, found 'a list'");
}

TEST(UncertaintyStatementErrors, NameTheirPlaceInTheInstrumentsFile) {
  EXPECT_EQ(error_of(instrument_text("uncertainty:\n  zero: {half_width: -1 GU}\n")),
            ":6:22: uncertainty.zero.half_width: expected a gloss value (GU) >= 0, found "
            "'-1 GU'");
  EXPECT_EQ(error_of(instrument_text("geometries: [\"60\"]\n"
                                     "uncertainty:\n"
                                     "  zero: {\"85\": {half_width: 1 GU}}\n")),
            ":7:16: uncertainty.zero.85: expected one of the geometries 60, found '85'");
}

}  // namespace
}  // namespace gonio
