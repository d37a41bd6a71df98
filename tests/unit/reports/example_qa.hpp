#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "emulator/quality/qa_result.hpp"

// A result of QA made up for the tests of its writers: two channels with limits, one without; all
// that may be missing is there. Its numbers are nobody's.

namespace gonio::test {

/// To a thousandth, which every processor writes alike.
inline double rounded(double value) { return std::round(1000.0 * value) / 1000.0; }

/// About zero, of standard deviation one or so, always the same.
inline double wobble(std::uint64_t i) {
  return rounded(std::sin(2.1 * double(i)) + 0.8 * std::sin(0.37 * double(i * i)));
}

inline RunRecord example_run() {
  return {.id = 7,
          .kind = RunRecord::Kind::simulated,
          .batch = "coil_coating_60",
          .title = "Coil coating, semi-gloss",
          .batch_file = "fixtures/batches/coil_coating_60.yaml",
          .batch_text = "schema: gonio/batch/1\nid: coil_coating_60\n",
          .fingerprint = std::string(64, 'f'),
          .seed = 20260101,
          .gonio_version = "0.1.0",
          .standard = "iso_2813/2014",
          .sample = {"coil_semi_gloss", std::string(64, 'a')},
          .readings = {"readings.csv", std::string(64, 'b')},
          .instruments = {{"triangle_gloss", std::string(64, 'c')},
                          {"triangle_gloss_2", std::string(64, 'd')}},
          .operators = {"first", "second"},
          .channels = {{"60", "60", BatchChannel::Kind::gloss, "GU"},
                       {"60/colour", "60", BatchChannel::Kind::colour_difference, ""},
                       {"haze_20", "", BatchChannel::Kind::haze, "GU"}},
          .lots = 3,
          .panels = 120,
          .gauge_panels = 10,
          .started = "2026-01-15T08:00:00Z"};
}

/// Points of a chart as they come; `per_point` neighbours together.
inline ControlChart example_chart(double centre, double sigma, std::uint64_t points,
                                  std::uint64_t per_point = 1) {
  ControlChart chart{.centre = centre,
                     .lower = rounded(centre - 3.0 * sigma),
                     .upper = rounded(centre + 3.0 * sigma),
                     .sigma = sigma,
                     .points = points * per_point};
  for (std::uint64_t i = 1; i <= points; ++i) {
    const double value = rounded(centre + sigma * (i == 17 ? 3.4 : wobble(i)));
    const double room = per_point > 1 ? rounded(1.4 * sigma) : 0.0;
    chart.shown.push_back({.first = (i - 1) * per_point + 1,
                           .last = i * per_point,
                           .lowest = value - room,
                           .mean = value,
                           .highest = value + room});
  }
  return chart;
}

inline ControlCharts::Result example_charts(double mean, double sigma) {
  ControlCharts::Result charts;
  charts.subgroup_size = 3;
  charts.baseline = 100;
  charts.mean = example_chart(mean, sigma, 120);
  charts.mean->signals = {1, 2, 1, 1};
  charts.mean->first_signals = {{17, 1}, {17, 2}, {41, 2}, {63, 3}, {90, 4}};
  charts.range = example_chart(rounded(4.0 * sigma), sigma, 120);
  charts.range->lower = 0.0;
  charts.range->signals = {1, 0, 0, 0};
  charts.range->first_signals = {{17, 1}};
  charts.individual = example_chart(mean, rounded(1.1 * sigma), 120);
  charts.moving_range = example_chart(rounded(4.0 * sigma), sigma, 119);
  charts.moving_range.lower = 0.0;
  return charts;
}

inline Histogram::Bins example_bins(double mean, double sigma) {
  Histogram::Bins bins{.low = rounded(mean - 3.0 * sigma), .width = rounded(0.3 * sigma)};
  for (int i = 0; i < 20; ++i) {
    const double z = (i - 9.5) * 0.3;
    bins.counts.push_back(std::uint64_t(std::lround(14.4 * std::exp(-0.5 * z * z))));
  }
  return bins;
}

inline std::vector<PositionSummary> example_positions(double mean, double sigma) {
  std::vector<PositionSummary> positions;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const double x = i == 4 ? 75.0 : 25.0 + 100.0 * (i % 2);
    const double y = i == 4 ? 50.0 : 25.0 + 50.0 * double(i / 2);
    positions.push_back({.position = i + 1,
                         .x_mm = x,
                         .y_mm = y,
                         .half_length_mm = 9.0,
                         .half_width_mm = 4.5,
                         .readings = 120,
                         .mean = rounded(mean + 0.4 * sigma * wobble(i + 3)),
                         .standard_deviation = rounded(1.2 * sigma)});
  }
  return positions;
}

inline ChannelSummary example_channel(const BatchChannel& channel, double mean, double sigma) {
  return {.channel = channel,
          .expanded_uncertainty = rounded(0.8 * sigma),
          .panels = 120,
          .readings = 360,
          .mean = mean,
          .standard_deviation = sigma,
          .lowest = rounded(mean - 2.7 * sigma),
          .highest = rounded(mean + 3.4 * sigma),
          .mean_range = rounded(1.7 * sigma),
          .spread = {.lots = 3,
                     .panels = 120,
                     .readings = 360,
                     .mean = mean,
                     .sd_lots = rounded(0.3 * sigma),
                     .sd_panels = rounded(0.7 * sigma),
                     .sd_readings = rounded(0.9 * sigma),
                     .freedom_lots = 2,
                     .freedom_panels = 117,
                     .freedom_readings = 240},
          .charts = example_charts(mean, sigma),
          .histogram = example_bins(mean, sigma),
          .uniformity = {117, 1, 1, 1},
          .passed = 117,
          .failed = 2,
          .inconclusive = 1,
          .positions = example_positions(mean, sigma)};
}

inline ChannelGauge example_gauge() {
  return {.channel = 0,
          .appraisers = {"triangle_gloss, first", "triangle_gloss, second"},
          .panels = 10,
          .repetitions = 3,
          .study = {.part = {88.4, 9, 9.822, 492.5, 0.00001},
                    .appraiser = {3.17, 1, 3.17, 79.4, 0.0001},
                    .interaction = {0.359, 9, 0.0399, 0.434, 0.897},
                    .repeatability = {2.759, 40, 0.069, {}, {}},
                    .total = {94.688, 59, 1.605, {}, {}},
                    .interaction_pooled = true,
                    .sd_repeatability = 0.2,
                    .sd_appraiser = 0.227,
                    .sd_interaction = 0.05,
                    .sd_reproducibility = 0.232,
                    .sd_gauge = 0.306,
                    .sd_part = 1.042,
                    .sd_total = 1.086,
                    .percent_of_study = 28.177,
                    .percent_of_tolerance = 30.6,
                    .percent_contribution = 7.939,
                    .distinct_categories = 4,
                    .repeatability_interval = Estimate{0.2, 0.164, 0.256}}};
}

inline Estimate share(double value) {
  return {value, rounded(0.8 * value), rounded(std::min(1.0, 1.2 * value + 0.002))};
}

inline Risks example_risks() {
  return {.from_normal_model = false,
          .lots = 4000,
          .panels = 160000,
          .lot = {share(0.953), share(0.941), share(0.021), share(0.009)},
          .panel = {share(0.981), share(0.968), share(0.014), share(0.0004)},
          .panel_normal = GlobalRisks{.consumer = 0.0003, .producer = 0.0151}};
}

inline OcCurve example_curve() {
  OcCurve curve{.channel = 0,
                .parameter = "roughness",
                .closed_form = "binomial",
                .lots = 1000,
                .present_mean = 60.4};
  for (int i = 0; i <= 20; ++i) {
    const double mean = 55.0 + 0.5 * i;
    const double accepted = rounded(1.0 / (1.0 + std::exp(2.5 * (std::abs(mean - 60.0) - 2.4))));
    curve.points.push_back({.offset = rounded(0.02 * (10 - i)),
                            .mean = mean,
                            .beyond = rounded(0.002 * (i - 10) * (i - 10)),
                            .accepted = share(accepted),
                            .exact = i % 7 == 6 ? std::optional<double>() : accepted});
  }
  return curve;
}

inline ReadingsAnswer example_readings_answer() {
  ReadingsAnswer answer{.risk = 0.05, .present = 3, .needed = 4};
  for (std::uint64_t n = 1; n <= 6; ++n) {
    answer.rows.push_back({.readings = n,
                           .producer = share(rounded(0.15 / double(n))),
                           .consumer = share(rounded(0.09 / double(n)))});
  }
  return answer;
}

inline SpreadAnswer example_spread_answer(const std::string& parameter) {
  SpreadAnswer answer{.parameter = parameter, .risk = 0.05, .present = 0.022, .allowed = 0.031};
  for (int i = 0; i <= 8; ++i) {
    answer.rows.push_back({.spread = rounded(0.008 * i),
                           .refused = share(rounded(0.0008 * i * i * i)),
                           .beyond = rounded(0.002 * i * i)});
  }
  return answer;
}

inline void add_judgement(QaResult& result) {
  result.lots = {{.number = 1,
                  .panels = 40,
                  .nonconforming = 0,
                  .mean = {60.52, 0.41, 22.1},
                  .verdict = ConformanceVerdict::pass},
                 {.number = 2,
                  .panels = 40,
                  .nonconforming = 2,
                  .not_uniform = 1,
                  .mean = {60.31, 0.39, 22.3},
                  .verdict = ConformanceVerdict::fail},
                 {.number = 3,
                  .panels = 40,
                  .inconclusive = 1,
                  .mean = {60.37, 0.4, 22.2},
                  .verdict = ConformanceVerdict::inconclusive}};
  ChannelSummary& gloss = result.channels[0];
  gloss.limits = {57.0, 63.0};
  gloss.target = 60.0;
  gloss.capability = Capability{.cp = Estimate{1.25, 1.09, 1.41},
                                .cpk = Estimate{1.083, 0.93, 1.236},
                                .pp = Estimate{1.11, 0.97, 1.25},
                                .ppk = Estimate{0.962, 0.82, 1.104},
                                .expected_beyond = 0.0021};
  ChannelSummary& colour = result.channels[1];
  colour.limits = {{}, 1.0};
  colour.capability = Capability{.cpk = Estimate{1.4, 1.2, 1.6}, .ppk = Estimate{1.3, 1.1, 1.5}};
  result.channels[2].positions.clear();  // haze has no readings of its own
  result.channels[2].charts.mean.reset();
  result.channels[2].charts.range.reset();
}

inline QaResult example_qa() {
  QaResult result{.run = example_run(),
                  .store = "sqlite:qa.db",
                  .verdict = ConformanceVerdict::fail,
                  .decision = "guard band of 1 U: pass and fail only where U leaves no doubt",
                  .acceptance = "a lot is accepted if at most 1 of its panels does not conform",
                  .panels = 120,
                  .readings = 720,
                  .panels_passed = 117,
                  .panels_failed = 2,
                  .panels_inconclusive = 1,
                  .lots_accepted = 1,
                  .lots_refused = 1,
                  .lots_inconclusive = 1};
  result.channels = {example_channel(result.run.channels[0], 60.4, 0.83),
                     example_channel(result.run.channels[1], 0.4, 0.14),
                     example_channel(result.run.channels[2], 22.2, 0.5)};
  add_judgement(result);
  result.panel_length_mm = 150.0;
  result.panel_width_mm = 100.0;
  result.gauge = {example_gauge()};
  result.risks = example_risks();
  result.oc_curves = {example_curve()};
  result.readings_answer = example_readings_answer();
  result.spread_answers = {example_spread_answer("roughness"),
                           example_spread_answer("diffuse_reflectance")};
  result.surrogate_error = 0.004;
  result.remarks = {"The batch file is an example.", "Two panels have readings that differ."};
  return result;
}

/// The same with one channel and few points: everything is there once.
inline QaResult brief_qa() {
  constexpr std::size_t few = 3;
  QaResult result = example_qa();
  result.channels.resize(1);
  ControlCharts::Result& charts = result.channels.front().charts;
  for (ControlChart* chart :
       {&*charts.mean, &*charts.range, &charts.individual, &charts.moving_range}) {
    chart->shown.resize(few);
  }
  result.channels.front().positions.resize(1);
  result.oc_curves.front().points.resize(few);
  result.readings_answer->rows.resize(few);
  result.spread_answers.resize(1);
  result.spread_answers.front().rows.resize(few);
  return result;
}

/// Nothing that may be missing is there.
inline QaResult empty_qa() {
  QaResult result;
  result.run.id = 1;
  return result;
}

/// Channels are there, but no panel, no limit, no chart and no position of theirs.
inline QaResult bare_qa() {
  QaResult result = empty_qa();
  result.channels = {{.channel = {"60", "60", BatchChannel::Kind::gloss, "GU"}}};
  result.gauge = {{}};
  result.risks = Risks{};
  result.oc_curves = {{}};
  result.readings_answer = ReadingsAnswer{};
  result.spread_answers = {{}};
  result.lots = {{}};
  return result;
}

}  // namespace gonio::test
