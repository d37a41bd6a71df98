#include "emulator/quality/batch_product.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/quality/batch_text.hpp"

namespace gonio {
namespace {

using test::batch_error;
using test::batch_with;

const std::string spread = "{roughness: {panels: 0.01}, diffuse_reflectance: {lots: 0.001}}";

Product product_with(const std::string& from, const std::string& to) {
  return batch_with(from, to).product.value();
}

TEST(ReadProduct, ReadsSpreadsByParameter) {
  const Product product = product_with(
      spread,
      "{refractive_index: {lots: 0.0005, panels: 0.0002, within_panel: 0.0001}, "
      "roughness: {lots: {half_width: 0.02}, panels: {half_width: 0.03, distribution: arcsine}}}");
  const ParameterSpread& index = product.spread[1];
  EXPECT_EQ(index.lots, (Distribution{.standard_uncertainty = 0.0005}));
  EXPECT_EQ(index.panels, (Distribution{.standard_uncertainty = 0.0002}));
  EXPECT_EQ(index.within_panel, 0.0001);
  const ParameterSpread& roughness = product.spread[0];
  EXPECT_EQ(roughness.lots, Distribution::bounded(Distribution::Shape::rectangular, 0.02));
  EXPECT_EQ(roughness.panels, Distribution::bounded(Distribution::Shape::arcsine, 0.03));
  EXPECT_EQ(product.spread[2].total(), 0.0);
}

TEST(ParameterSpread, AddsInQuadrature) {
  const ParameterSpread all{
      .lots = {.standard_uncertainty = 2.0},
      .panels = Distribution::bounded(Distribution::Shape::rectangular, 3.0 * std::sqrt(3.0)),
      .within_panel = 6.0};
  EXPECT_DOUBLE_EQ(all.total(), 7.0);
}

TEST(ReadProduct, ReadsOffsetsAndLengths) {
  const Product product = product_with(
      "  spread",
      "  offset: {roughness: 0.03, refractive_index: -0.01}\n"
      "  correlation_length: 20 mm\n  panel: {length: 300 mm, width: 50 mm}\n  spread");
  EXPECT_EQ(product.offset, (ProductDeviation{0.03, -0.01, 0.0}));
  EXPECT_EQ(product.correlation_length_mm, 20.0);
  EXPECT_EQ(product.panel_length_mm, 300.0);
  EXPECT_EQ(product.panel_width_mm, 50.0);
  EXPECT_EQ(product.mark.line, 6);
}

TEST(ReadProduct, LeavesTheRestAtItsDefaults) {
  const Product product = product_with("  spread: " + spread + "\n", "");
  EXPECT_EQ(product.offset, ProductDeviation{});
  for (const ParameterSpread& one : product.spread) {
    EXPECT_EQ(one.total(), 0.0);
  }
  EXPECT_FALSE(product.correlation_length_mm);
  EXPECT_EQ(product.panel_length_mm, 150.0);
  EXPECT_EQ(product.panel_width_mm, 100.0);
}

TEST(ReadProduct, ReadsCorrelations) {
  const Product product = product_with(
      "specification",
      "  correlations: [{between: [diffuse_reflectance, roughness], coefficient: -0.3}]\n"
      "specification");
  ASSERT_EQ(product.correlations.size(), 1u);
  EXPECT_EQ(product.correlations[0].a, 2u);
  EXPECT_EQ(product.correlations[0].b, 0u);
  EXPECT_EQ(product.correlations[0].coefficient, -0.3);
}

TEST(ReadProduct, RefusesSpreadsThatAreNone) {
  EXPECT_EQ(batch_error("panels: 0.01", "panels: -0.01"),
            "7:32: product.spread.roughness.panels: expected a number >= 0, found '-0.01'");
  EXPECT_EQ(batch_error("panels: 0.01", "within_panel: {half_width: 0.01}"),
            "7:38: product.spread.roughness.within_panel: expected a number >= 0, found 'a map'");
  EXPECT_EQ(batch_error("panels: 0.01", "panels: {half_width: 0.01, distribution: normal}"),
            "7:65: product.spread.roughness.panels.distribution: expected one of rectangular, "
            "triangular, arcsine, found 'normal'");
  EXPECT_EQ(batch_error("roughness: {p", "gloss: {p"),
            "7:12: product.spread.gloss: expected one of the keys diffuse_reflectance, "
            "refractive_index, roughness, found 'gloss'");
}

/// Of a list that stands in line 8, from column 17.
std::string correlation_error(const std::string& list, const std::string& spreads = spread) {
  const std::string text = test::replaced(test::batch_text, spread, spreads);
  return batch_error(
      test::replaced(text, "specification", "  correlations: " + list + "\nspecification"));
}

TEST(ReadProduct, RefusesCorrelationsThatMeanNothing) {
  EXPECT_EQ(correlation_error("[{between: [roughness], coefficient: 0.3}]"),
            "8:28: product.correlations[0].between: expected a list of two parameters, found '1'");
  EXPECT_EQ(correlation_error("[{between: [roughness, gloss], coefficient: 0.3}]"),
            "8:40: product.correlations[0].between[1]: expected one of roughness, "
            "refractive_index, diffuse_reflectance, found 'gloss'");
  EXPECT_EQ(correlation_error("[{between: [roughness, roughness], coefficient: 0.3}]"),
            "8:40: product.correlations[0].between[1]: expected another parameter, found "
            "'roughness'");
  EXPECT_EQ(correlation_error("[{between: [roughness, diffuse_reflectance], coefficient: 1.5}]"),
            "8:75: product.correlations[0].coefficient: expected a number in [-1, 1], found '1.5'");
  EXPECT_EQ(correlation_error("[{between: [roughness, refractive_index], coefficient: 0.3}]"),
            "8:40: product.correlations[0].between[1]: expected a parameter that varies, found "
            "'refractive_index'");
  EXPECT_EQ(correlation_error(
                "[{between: [roughness, diffuse_reflectance], coefficient: 0.3}]",
                "{roughness: {panels: {half_width: 0.01}}, diffuse_reflectance: {lots: 0.001}}"),
            "8:29: product.correlations[0].between[0]: expected a parameter whose spread is normal "
            "in lots and panels, found 'roughness'");
  EXPECT_EQ(correlation_error("[{between: [roughness, diffuse_reflectance], coefficient: 0.3}, "
                              "{between: [diffuse_reflectance, roughness], coefficient: 0.3}]"),
            "8:81: product.correlations[1]: expected each pair once, found 'diffuse_reflectance "
            "and roughness a second time'");
}

TEST(ReadProduct, RefusesCorrelationsThatContradictEachOther) {
  EXPECT_EQ(correlation_error("[{between: [roughness, diffuse_reflectance], coefficient: 1}]"),
            "8:17: product.correlations: expected a correlation matrix that is positive definite, "
            "found 'a smallest eigenvalue of 0'");
  const std::string all =
      "{roughness: {panels: 1}, refractive_index: {panels: 1}, diffuse_reflectance: {panels: 1}}";
  const std::string contradiction =
      "[{between: [roughness, diffuse_reflectance], coefficient: 0.9}, "
      "{between: [roughness, refractive_index], coefficient: 0.9}, "
      "{between: [diffuse_reflectance, refractive_index], coefficient: -0.9}]";
  EXPECT_EQ(correlation_error(contradiction, all),
            "8:17: product.correlations: expected a correlation matrix that is positive definite, "
            "found 'a smallest eigenvalue of -0.8'");
}

TEST(ReadProduct, RefusesPanelsOfNoSize) {
  const auto error = [](const std::string& panel) {
    return batch_error("specification", "  panel: " + panel + "\nspecification");
  };
  EXPECT_EQ(error("{length: 0 mm, width: 10 mm}"),
            "8:19: product.panel.length: expected a length (nm, um, mm) > 0, found '0 mm'");
  EXPECT_EQ(error("{length: 10 mm, width: 20000 mm}"),
            "8:33: product.panel.width: expected a length of at most 10000 mm, found '20000 mm'");
  EXPECT_EQ(error("{length: 10 mm}"),
            "8:10: product.panel.width: expected the key 'width', found 'only length'");
}

}  // namespace
}  // namespace gonio
