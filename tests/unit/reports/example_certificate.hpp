#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "reports/certificate_report.hpp"

// A certificate made up for the tests of its writers: every verdict, every shape of distribution,
// inputs of one geometry and of all, a surrogate and none, estimates from readings. Its numbers are
// nobody's.

namespace gonio::test {

inline const std::string certificate_numbers = "standards/iso_2813/2014/standard.yaml";

/// To a thousandth, which every processor writes alike.
inline double thousandths(double value) { return std::round(1000.0 * value) / 1000.0; }

inline SpectralTable flat_spectrum() {
  return {Eigen::ArrayXd::LinSpaced(2, 380.0, 780.0), Eigen::ArrayXd::Ones(2), {}};
}

inline Standard example_standard() {
  return {.file = {},
          .id = "iso_2813/2014",
          .title = "Paints and varnishes: gloss value at 20, 60 and 85 degrees",
          .edition = "2014",
          .transcription = "partial",
          .scale = {.unit = "GU", .value = {.nominal = 100.0}},
          .source = flat_spectrum(),
          .responsivity = flat_spectrum()};
}

inline Instrument example_instrument() {
  Instrument instrument{.file = "fixtures/instruments/triangle_gloss.yaml",
                        .id = "triangle_gloss",
                        .title = "Three-angle glossmeter as built",
                        .standard = example_standard(),
                        .geometries = {"20", "60"},
                        .source = flat_spectrum(),
                        .responsivity = flat_spectrum()};
  instrument.identity.manufacturer = "Example Works";
  instrument.identity.model = "EG-3";
  instrument.identity.serial_number = "0001";
  return instrument;
}

/// A quantity of the set-up with its nominal value, tolerance and value as built, in degrees.
struct ExampleQuantity {
  SetupQuantity quantity;
  double nominal, tolerance, as_built;
  ConformanceVerdict verdict;
};

inline std::string name_of(const ExampleQuantity& example) {
  return setup_quantity_names.at(std::size_t(example.quantity));
}

inline std::vector<ExampleQuantity> example_quantities(bool is_sixty) {
  using enum ConformanceVerdict;
  return {{SetupQuantity::theta_i, is_sixty ? 60.0 : 20.0, 0.1, is_sixty ? 60.04 : 19.97, pass},
          {SetupQuantity::theta_r, is_sixty ? 60.0 : 20.0, 0.1, is_sixty ? 59.85 : 20.02,
           is_sixty ? fail : pass},
          {SetupQuantity::source_in_plane, 0.75, 0.25, 0.8, pass},
          {SetupQuantity::source_perpendicular, 2.5, 0.5, 2.4, pass},
          {SetupQuantity::receptor_in_plane, is_sixty ? 4.4 : 1.8, is_sixty ? 0.1 : 0.05,
           is_sixty ? 4.495 : 1.78, is_sixty ? inconclusive : pass},
          {SetupQuantity::receptor_perpendicular, is_sixty ? 11.7 : 3.6, is_sixty ? 0.2 : 0.1,
           is_sixty ? 11.62 : 3.64, pass}};
}

inline CertificateLimit example_limit(const std::string& geometry, const ExampleQuantity& example,
                                      int line) {
  const std::string quantity = name_of(example);
  const bool is_remembered = quantity.starts_with("source");
  const std::string clause = is_remembered ? "source" : quantity;
  return {.clause = fmt::format("geometry/{}_{}", clause, geometry),
          .limit = {.quantity = quantity,
                    .geometry = geometry,
                    .unit = "deg",
                    .nominal = example.nominal,
                    .tolerance = example.tolerance,
                    .low = example.nominal - example.tolerance,
                    .high = example.nominal + example.tolerance,
                    .evidence = is_remembered ? Evidence{.level = "memory", .sources = {}}
                                              : Evidence{.level = "C2", .sources = {"IT14", "JK"}},
                    .mark = {certificate_numbers, line, 15}},
          .as_built = example.as_built,
          .expanded_uncertainty = 0.02,
          .verdict = example.verdict,
          .probability = example.verdict == ConformanceVerdict::pass   ? 0.99999
                         : example.verdict == ConformanceVerdict::fail ? 1e-7
                                                                       : 0.691,
          .counts = !is_remembered};
}

inline void add_limits(Certificate& certificate) {
  int line = 40;
  for (const bool is_sixty : {false, true}) {
    for (const ExampleQuantity& example : example_quantities(is_sixty)) {
      certificate.limits.push_back(example_limit(is_sixty ? "60" : "20", example, line++));
    }
  }
  certificate.limits.push_back({.clause = "photometry/linearity",
                                .limit = {.quantity = "linearity",
                                          .high = 0.01,
                                          .evidence = {.level = "C1", .sources = {"W523"}},
                                          .mark = {certificate_numbers, 90, 7}},
                                .as_built = {},
                                .verdict = ConformanceVerdict::not_applicable,
                                .probability = {},
                                .note = "the file does not state it"});
}

inline void add_inputs(Certificate& certificate) {
  using enum Distribution::Shape;
  certificate.inputs = {
      {.id = "reference_index",
       .component = "reference_index",
       .geometry = "",
       .unit = "",
       .distribution = {.standard_uncertainty = 0.0005, .degrees_of_freedom = 50.0}}};
  for (const bool is_sixty : {false, true}) {
    const std::string geometry = is_sixty ? "60" : "20";
    const auto add = [&](const std::string& component, const char* unit, double estimate,
                         const Distribution& distribution) {
      certificate.inputs.push_back({.id = fmt::format("{}/{}", geometry, component),
                                    .component = component,
                                    .geometry = geometry,
                                    .unit = unit,
                                    .estimate = estimate,
                                    .distribution = distribution});
    };
    for (const ExampleQuantity& example : example_quantities(is_sixty)) {
      add(name_of(example), "deg", example.as_built, {.standard_uncertainty = 0.005});
    }
    add("reference_value", "GU", 0.0, {.standard_uncertainty = 0.2});
    add("polarization", "", 0.0, {.shape = rectangular, .standard_uncertainty = 0.0058});
    add("temperature", "K", 0.0, {.shape = arcsine, .standard_uncertainty = 1.4});
    add("drift", "", 0.0, {.shape = triangular, .standard_uncertainty = 0.0004});
    add("resolution", "GU", 0.0, {.shape = rectangular, .standard_uncertainty = 0.029});
    add("repeatability", "GU", 0.0,
        {.shape = student, .standard_uncertainty = 0.05, .degrees_of_freedom = 9.0});
  }
}

/// One that adds up: u^2 is the sum of the squares of the contributions.
inline Propagated example_propagated(const Certificate& certificate, const std::string& geometry,
                                     double x) {
  Propagated result{.degrees_of_freedom = 220.0, .coverage_factor = 1.97};
  double variance = 0.0;
  for (std::size_t i = 0; i < certificate.inputs.size(); ++i) {
    const CertificateInput& input = certificate.inputs[i];
    const bool is_of_it = input.geometry.empty() || input.geometry == geometry;
    const double scale = input.component == "reference_value"   ? x
                         : input.component == "reference_index" ? -159.0 * x
                         : input.unit == "deg"                  ? 8.0 * x * (1.0 - x)
                         : input.component == "temperature"     ? -0.03 * x
                         : input.unit == "GU"                   ? 1.0
                                                                : 60.0 * x;
    const double sensitivity = is_of_it ? thousandths(scale) : 0.0;
    const double part = std::abs(sensitivity) * input.distribution.standard_uncertainty;
    variance += part * part;
    result.budget.push_back({.input = i, .sensitivity = sensitivity, .contribution = part});
  }
  for (Contribution& part : result.budget) {
    part.share = thousandths(part.contribution * part.contribution / variance);
  }
  result.standard_uncertainty = thousandths(std::sqrt(variance));
  result.expanded_uncertainty = thousandths(1.97 * result.standard_uncertainty);
  return result;
}

inline CertifiedReading example_reading(const Certificate& certificate,
                                        const GeometryCertificate& geometry, double x) {
  CertifiedReading reading{.nominal_gu = thousandths(0.5 * std::exp2(8.0 * x)),
                           .propagated = example_propagated(certificate, geometry.id, x)};
  reading.gloss_gu = reading.nominal_gu + thousandths(0.3 * x - 0.1);
  reading.before_adjustment_gu = reading.gloss_gu - thousandths(1.2 * x);
  const double U = thousandths(1.01 * reading.propagated.expanded_uncertainty);
  reading.monte_carlo = {.mean = reading.gloss_gu,
                         .standard_uncertainty = reading.propagated.standard_uncertainty,
                         .low = reading.gloss_gu - U,
                         .high = reading.gloss_gu + U,
                         .instability = 0.8};
  reading.sensitivity_error.assign(certificate.inputs.size(), 1e-5);
  const double worst = thousandths(0.05 + 6.0 * x * (1.0 - x));
  reading.lowest = {.change_gu = -worst, .setup = {}};
  reading.highest = {.change_gu = thousandths(1.3 * worst), .setup = {}};
  for (const ExampleQuantity& example : example_quantities(geometry.id == "60")) {
    reading.lowest.setup.push_back(example.nominal - example.tolerance);
    reading.highest.setup.push_back(example.nominal + example.tolerance);
  }
  return reading;
}

inline DeviationEffect example_effect(const GeometryCertificate& geometry, double scale) {
  DeviationEffect effect{.geometry = geometry.id, .component = "all"};
  for (std::size_t i = 0; i < geometry.readings.size(); ++i) {
    const double x = double(i) / double(geometry.readings.size() - 1);
    effect.as_built_gu.push_back(thousandths(scale * (0.1 + x * (1.0 - x))));
  }
  return effect;
}

inline void add_effects(GeometryCertificate& geometry, bool is_sixty) {
  double scale = 0.4;
  for (const ExampleQuantity& example : example_quantities(is_sixty)) {
    DeviationEffect effect = example_effect(geometry, scale);
    effect.component = name_of(example);
    effect.unit = "deg";
    effect.nominal = example.nominal;
    effect.as_built = example.as_built;
    effect.low = example.nominal - example.tolerance;
    effect.high = example.nominal + example.tolerance;
    for (const double change : effect.as_built_gu) {
      effect.low_gu.push_back(thousandths(-2.0 * change));
      effect.high_gu.push_back(thousandths(1.8 * change));
    }
    geometry.effects.push_back(effect);
    scale *= -0.7;
  }
  geometry.effects.push_back(example_effect(geometry, 0.02));
  geometry.effects.back().component = "spectrum";
  geometry.effects.push_back(example_effect(geometry, 0.25));
}

inline void add_geometry(Certificate& certificate, bool is_sixty) {
  GeometryCertificate geometry{.id = is_sixty ? "60" : "20", .theta_i_deg = is_sixty ? 60.0 : 20.0};
  for (const ExampleQuantity& example : example_quantities(is_sixty)) {
    geometry.quantities.push_back(example.quantity);
  }
  for (std::size_t i = 0; i < certificate.samples.size(); ++i) {
    const double x = double(i) / double(certificate.samples.size() - 1);
    geometry.readings.push_back(example_reading(certificate, geometry, x));
    geometry.surrogate_error_gu.push_back(1e-4);
  }
  if (is_sixty) {
    geometry.readings[7].methods_agree = false;
    geometry.direct_samples = {7};
  }
  add_effects(geometry, is_sixty);
  certificate.geometries.push_back(geometry);
}

inline void add_estimate(Certificate& certificate) {
  certificate.estimates.push_back(
      {.geometry = "60",
       .parameters = {{.name = "theta_i",
                       .unit = "deg",
                       .assumed = 60.04,
                       .prior_uncertainty = 0.15,
                       .estimate = 60.071,
                       .standard_uncertainty = 0.012,
                       .is_determined = true},
                      {.name = "receptor_in_plane",
                       .unit = "deg",
                       .assumed = 4.43,
                       .prior_uncertainty = 0.15,
                       .estimate = 4.38,
                       .standard_uncertainty = 0.11},
                      {.name = "receptor_perpendicular",
                       .unit = "deg",
                       .assumed = 11.62,
                       .prior_uncertainty = 0.3,
                       .estimate = 11.7,
                       .standard_uncertainty = 0.24},
                      {.name = "zero",
                       .unit = "GU",
                       .assumed = 0.0,
                       .prior_uncertainty = 0.2,
                       .estimate = 0.02,
                       .standard_uncertainty = 0.03,
                       .is_determined = true}},
       .correlation = {{1.0, 0.1, 0.1, 0.0},
                       {0.1, 1.0, -0.9, 0.0},
                       {0.1, -0.9, 1.0, 0.0},
                       {0.0, 0.0, 0.0, 1.0}},
       .confusions = {{.direction = {0.01, 0.72, 0.69, 0.0}, .remaining = 0.97}},
       .residual_gu = {0.01, -0.02, 0.04},
       .readings = {{"black_satin", "60", 21.3, {}, {"r.csv", 2, 1}},
                    {"black_semi_gloss", "60", 54.1, 0.2, {"r.csv", 3, 1}},
                    {"glass_n1500", "60", 86.9, {}, {"r.csv", 4, 1}}},
       .chi_squared = 2.4,
       .degrees_of_freedom = 3,
       .p_value = 0.49,
       .has_converged = true});
}

inline Certificate example_certificate() {
  Certificate certificate{.instrument = example_instrument(),
                          .standard = example_standard(),
                          .seed = 7,
                          .verdict = ConformanceVerdict::fail,
                          .trials = 250'000,
                          .direct_trials = 20'000,
                          .is_stable = true};
  constexpr int ladder_size = 12;
  for (int i = 1; i <= ladder_size; ++i) {
    certificate.samples.push_back(fmt::format("sample_{}", i));
    certificate.sample_titles.push_back(fmt::format("Sample {}, of some paint", i));
  }
  add_limits(certificate);
  add_inputs(certificate);
  add_geometry(certificate, false);
  add_geometry(certificate, true);
  add_estimate(certificate);
  return certificate;
}

/// The same of one geometry and two samples.
inline Certificate brief_certificate() {
  Certificate certificate = example_certificate();
  certificate.samples.resize(2);
  certificate.sample_titles.resize(2);
  certificate.geometries.erase(certificate.geometries.begin());
  GeometryCertificate& geometry = certificate.geometries.front();
  geometry.readings.resize(2);
  geometry.surrogate_error_gu.resize(2);
  geometry.direct_samples.clear();
  for (DeviationEffect& effect : geometry.effects) {
    for (auto* changes : {&effect.as_built_gu, &effect.low_gu, &effect.high_gu}) {
      changes->resize(std::min<std::size_t>(2, changes->size()));
    }
  }
  return certificate;
}

inline Laboratory example_laboratory() {
  return {.name = "Example Gloss Laboratory",
          .address = "1 Mirror Lane, 00000 Exampleton",
          .accreditation = "none",
          .certificate_number = "EGL-2026-0042",
          .customer = "Example Paints",
          .received = "2026-01-12",
          .calibrated = "2026-01-15",
          .temperature = "23 degC +- 1 degC",
          .reference_standards = {"Black glass wedge", "Ray table"},
          .traceability = "None is claimed.",
          .procedure = "EGL-P-07",
          .signatory = "A. N. Example"};
}

inline CertificateReport report_of(const Certificate& certificate) {
  return {.certificate = certificate,
          .laboratory = example_laboratory(),
          .version = "0.1.0",
          .date = "2026-01-31",
          .sources = {{"IT14", "ISO 2813:2014, summary of the key requirements"},
                      {"JK", "JIS K 5600-4-7:1999, table of its differences"},
                      {"W523", "ASTM D523-14, licensed translation"}}};
}

}  // namespace gonio::test
