#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "reports/conformance_report.hpp"

// A conformance report made up for the tests of its writers: every verdict, every role, clauses
// with and without cases, and everything that is drawn. Its numbers are nobody's.

namespace gonio::test {

using enum ConformanceVerdict;

inline const std::string example_clauses = "standards/iso_2813/2014/clauses.yaml";
inline const std::string example_numbers = "standards/iso_2813/2014/standard.yaml";
inline const std::string example_cases = "standards/cases/geometry.yaml";

inline Evidence read_in_two() { return {.level = "C2", .sources = {"IT14", "JK"}}; }

inline LimitRow angle_limit(const std::string& quantity, const std::string& geometry,
                            double nominal, double tolerance, int line) {
  return {.quantity = quantity,
          .geometry = geometry,
          .unit = "deg",
          .nominal = nominal,
          .tolerance = tolerance,
          .low = nominal - tolerance,
          .high = nominal + tolerance,
          .evidence = read_in_two(),
          .mark = {example_numbers, line, 15}};
}

inline Observation angle_found(double value, double nominal, double tolerance,
                               ConformanceVerdict verdict, double uncertainty = 0.02) {
  return {.quantity = "theta_i",
          .geometry = "60",
          .unit = "deg",
          .value = value,
          .expanded_uncertainty = uncertainty,
          .expected = nominal,
          .low = nominal - tolerance,
          .high = nominal + tolerance,
          .origin = "nominal of the standard",
          .verdict = verdict};
}

/// What came out of a case, and what should have.
struct Verdicts {
  ConformanceVerdict found, expected;
};

inline CaseResult example_case(const std::string& clause, const std::string& id, CaseRole role,
                               Verdicts verdicts, const std::string& intent, int line) {
  return {.id = id,
          .clause = clause,
          .address = "iso_2813/2014/" + clause + "/" + id,
          .intent = intent,
          .mark = {example_cases, line, 5},
          .role = role,
          .subject = role == CaseRole::evaluation ? "" : "Three-angle glossmeter, as built",
          .verdict = verdicts.found,
          .expected = verdicts.expected,
          .duration_s = 0.012};
}

/// Effects that a small angle could have, over twelve samples from matt to mirror.
inline SetupEffects example_effects(const std::string& geometry, SetupQuantity quantity,
                                    double nominal_deg, double tolerance_deg, double scale) {
  SetupEffects effects{.geometry = geometry,
                       .quantity = quantity,
                       .nominal = degrees(nominal_deg),
                       .as_built = degrees(nominal_deg + 0.4 * tolerance_deg),
                       .low = degrees(nominal_deg - tolerance_deg),
                       .high = degrees(nominal_deg + tolerance_deg)};
  constexpr int ladder_size = 12;
  // To a thousandth, which every processor writes alike.
  const auto rounded = [](double value) { return std::round(1000.0 * value) / 1000.0; };
  for (int i = 0; i < ladder_size; ++i) {
    const double x = double(i) / (ladder_size - 1);
    const double effect = scale * (0.05 + 4.0 * x * (1.0 - x));
    effects.rows.push_back({.sample = fmt::format("sample_{}", i + 1),
                            .title = fmt::format("Sample {}", i + 1),
                            .nominal_gu = rounded(0.5 * std::exp2(i)),
                            .as_built_gu = rounded(0.4 * effect),
                            .low_gu = rounded(-effect),
                            .high_gu = rounded(0.8 * effect)});
  }
  return effects;
}

inline FootprintOutline rectangle(const std::string& title, double in_plane, double perpendicular,
                                  double offset = 0.0) {
  const double x = in_plane / 2.0;
  const double y = perpendicular / 2.0;
  return {.title = title,
          .in_plane_deg = {offset - x, offset + x, offset + x, offset - x, offset - x},
          .perpendicular_deg = {-y, -y, y, y, -y}};
}

/// A lobe beside the mirror direction, on 31 x 41 directions.
inline Footprint example_footprint(const std::string& geometry) {
  Footprint made{.geometry = geometry, .sample = "black_semi_gloss"};
  made.outlines = {rectangle("receptor by the standard", 4.4, 11.7),
                   rectangle("receptor as built", 4.5, 11.6, 0.1),
                   rectangle("source image by the standard", 0.75, 2.5),
                   rectangle("source image as built", 0.8, 2.6, 0.2)};
  constexpr int columns = 31;
  constexpr int rows = 41;
  for (int i = 0; i < columns; ++i) {
    made.in_plane_deg.push_back(-4.5 + 0.3 * i);
  }
  for (int j = 0; j < rows; ++j) {
    made.perpendicular_deg.push_back(-8.0 + 0.4 * j);
    for (const double x : made.in_plane_deg) {
      const double u = (x - 0.6) / 2.5;
      const double v = made.perpendicular_deg.back() / 4.0;
      made.radiance.push_back(std::exp(-u * u - v * v));
    }
  }
  return made;
}

inline WeightingCurve example_weighting(const std::string& title, double peak_nm) {
  WeightingCurve curve{.title = title, .wavelength_nm = {}, .weight = {}};
  for (double lambda = 380.0; lambda <= 780.0; lambda += 5.0) {
    const double u = (lambda - peak_nm) / 60.0;
    curve.wavelength_nm.push_back(lambda);
    curve.weight.push_back(0.047 * std::exp(-u * u));
  }
  return curve;
}

inline void add_incidence(ConformanceReport& report) {
  const std::string clause = "geometry/incidence_60";
  const double nominal = 60.0;
  const double tolerance = 0.1;
  CaseResult device = example_case(clause, "as_stated", CaseRole::device, {fail, pass},
                                   "The device states an angle of incidence within the limit.", 12);
  device.observations = {angle_found(60.2, nominal, tolerance, fail)};
  CaseResult accepted = example_case(clause, "offset_within_limit", CaseRole::control, {pass, pass},
                                     "An instrument aimed within the limit is accepted.", 21);
  accepted.observations = {angle_found(60.04, nominal, tolerance, pass)};
  CaseResult rejected = example_case(clause, "offset_beyond_limit", CaseRole::control, {fail, fail},
                                     "An instrument aimed beyond the limit is caught.", 30);
  rejected.observations = {angle_found(60.15, nominal, tolerance, fail)};
  CaseResult close =
      example_case(clause, "offset_at_limit", CaseRole::control, {inconclusive, inconclusive},
                   "Where the uncertainty straddles the limit nothing is said.", 39);
  close.observations = {angle_found(60.09, nominal, tolerance, inconclusive, 0.03)};

  const std::size_t first = report.cases.size();
  report.cases.insert(report.cases.end(), {device, accepted, rejected, close});
  report.clauses.push_back(
      {.id = clause,
       .level = "shall",
       .requirement = "The axis of the incident beam lies at the nominal angle.",
       .coverage = "cases",
       .mark = {example_clauses, 7, 5},
       .evidence = read_in_two(),
       .limits = {angle_limit("theta_i", "60", nominal, tolerance, 41)},
       .cases = {first, first + 1, first + 2, first + 3},
       .verdict = fail,
       .effects = {example_effects("60", SetupQuantity::theta_i, nominal, tolerance, 0.4)}});
}

inline void add_remembered_source(ConformanceReport& report) {
  const std::string clause = "geometry/source_60";
  CaseResult device = example_case(clause, "as_stated", CaseRole::device, {fail, pass},
                                   "The device states a source image within the limits.", 50);
  device.observations = {{.quantity = "source_in_plane",
                          .geometry = "60",
                          .unit = "deg",
                          .value = 1.2,
                          .expected = 0.75,
                          .low = 0.5,
                          .high = 1.0,
                          .origin = "nominal of the standard",
                          .verdict = fail}};
  LimitRow limit = angle_limit("source_in_plane", "60", 0.75, 0.25, 44);
  limit.evidence = {.level = "memory", .sources = {}};
  report.clauses.push_back(
      {.id = clause,
       .level = "shall",
       .requirement = "The image of the source has the nominal size.",
       .coverage = "cases",
       .mark = {example_clauses, 14, 5},
       .evidence = {.level = "memory", .sources = {}},
       .limits = {limit},
       .cases = {report.cases.size()},
       .verdict = fail,
       .counts = false,
       .effects = {example_effects("60", SetupQuantity::source_in_plane, 0.75, 0.25, 0.9)}});
  report.cases.push_back(device);
}

/// A clause with one case, whose observation is of gloss or is a text.
inline void add_reading(ConformanceReport& report, const std::string& clause,
                        const std::string& level, const CaseResult& result, const LimitRow& limit) {
  report.clauses.push_back({.id = clause,
                            .level = level,
                            .requirement = "What the case of this clause shows is so.",
                            .coverage = "cases",
                            .mark = {example_clauses, 30 + int(report.clauses.size()), 5},
                            .evidence = limit.evidence,
                            .limits = {limit},
                            .cases = {report.cases.size()},
                            .verdict = result.verdict});
  report.cases.push_back(result);
}

inline void add_readings(ConformanceReport& report) {
  const Evidence one{.level = "C1", .sources = {"W523"}};
  const LimitRow at_most{.quantity = "zero",
                         .unit = "GU",
                         .high = 0.1,
                         .evidence = one,
                         .mark = {example_clauses, 33, 16}};
  CaseResult zero = example_case("photometry/zero", "black_trap", CaseRole::device,
                                 {inconclusive, pass}, "The trap reads nothing.", 61);
  zero.observations = {{.quantity = "zero",
                        .geometry = "85",
                        .subject = "black trap",
                        .unit = "GU",
                        .value = 0.09,
                        .expanded_uncertainty = 0.05,
                        .high = 0.1,
                        .verdict = inconclusive}};
  add_reading(report, "photometry/zero", "shall", zero, at_most);

  CaseResult range = example_case("procedure/selection", "matt_paint", CaseRole::evaluation,
                                  {pass, pass}, "A matt paint is reported at 85 degrees.", 70);
  range.observations = {{.quantity = "selected_geometry",
                         .found = "85",
                         .expected_text = "85",
                         .origin = "rule of the standard"}};
  add_reading(report, "procedure/selection", "shall", range, at_most);

  CaseResult shift = example_case("procedure/drift", "over_a_shift", CaseRole::device,
                                  {skipped, pass}, "The tile reads the same after a shift.", 80);
  shift.message = "takes 8 h; nobody waits that long for a device on the wire";
  add_reading(report, "procedure/drift", "should", shift, at_most);

  CaseResult lost = example_case("procedure/repeatability", "ten_readings", CaseRole::device,
                                 {error, pass}, "Ten readings scatter little.", 90);
  lost.message = "modbus://127.0.0.1:1502: no answer within 1 s";
  lost.observations = {{.quantity = "repeatability",
                        .geometry = "60",
                        .subject = "black_glass_n1567",
                        .unit = "GU",
                        .value = std::nan(""),
                        .high = 0.5,
                        .verdict = error}};
  add_reading(report, "procedure/repeatability", "shall", lost, at_most);
}

inline void add_clauses_without_cases(ConformanceReport& report) {
  report.clauses.push_back({.id = "report/contents",
                            .level = "shall",
                            .requirement = "The test report names the standard and the sample.",
                            .coverage = "inspection",
                            .reason = "a report is read by a person",
                            .mark = {example_clauses, 60, 5},
                            .evidence = {.level = "C1", .sources = {"TOC14"}}});
  report.clauses.push_back({.id = "sample/preparation",
                            .level = "may",
                            .requirement = "Panels are coated and dried as agreed.",
                            .coverage = "out_of_scope",
                            .reason = "happens before the glossmeter",
                            .mark = {example_clauses, 66, 5},
                            .evidence = {.level = "C1", .sources = {"TOC14"}}});
}

inline ConformanceReport example_report() {
  ConformanceReport report{
      .standard_id = "iso_2813/2014",
      .title = "Paints and varnishes: gloss value at 20, 60 and 85 degrees",
      .edition = "2014",
      .transcription = "partial",
      .notes = "No bought copy was used.",
      .device = "Example Works EG-3, serial number 0001",
      .device_detail = "fixtures/instruments/triangle_gloss.yaml",
      .decision_rule = "guarded: a limit is met if the expanded uncertainty (k = 2) lies within it",
      .version = "0.1.0",
      .date = "2026-01-31",
      .seed = 7,
      .verdict = fail};
  add_incidence(report);
  add_remembered_source(report);
  add_readings(report);
  add_clauses_without_cases(report);
  report.sources = {{"IT14", "ISO 2813:2014, summary of the key requirements"},
                    {"JK", "JIS K 5600-4-7:1999, table of its differences from ISO 2813:1994"},
                    {"TOC14", "ISO 2813:2014, list of contents"},
                    {"W523", "ASTM D523-14, licensed translation"}};
  report.weightings = {example_weighting("illuminant C with V(lambda), by the standard", 555.0),
                       example_weighting("the device: LED with filter", 560.0)};
  report.footprints = {example_footprint("60")};
  return report;
}

}  // namespace gonio::test
