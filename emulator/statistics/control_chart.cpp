#include "emulator/statistics/control_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace gonio {
namespace {

constexpr std::size_t most_first_signals = 100;

bool has_range(std::size_t n) { return n >= 2 && n <= largest_subgroup; }

}  // namespace

bool ControlChart::in_control() const {
  return std::all_of(signals.begin(), signals.end(), [](auto n) { return n == 0; });
}

void ControlCharts::Recorder::set(double centre, double sigma, double lower, double upper) {
  chart.centre = centre;
  chart.sigma = sigma;
  chart.lower = lower;
  chart.upper = upper;
}

void ControlCharts::Recorder::add(std::uint64_t number, double value, double z, bool only_rule_1) {
  ++chart.points;
  points.add(number, value);
  if (!(chart.sigma > 0.0)) {
    return;
  }
  const WesternElectric::Broken broken = rules.add(z);
  for (std::size_t i = 0; i < (only_rule_1 ? 1 : broken.size()); ++i) {
    if (!broken[i]) {
      continue;
    }
    ++chart.signals[i];
    if (chart.first_signals.size() < most_first_signals) {
      chart.first_signals.push_back({.point = number, .rule = int(i) + 1});
    }
  }
}

ControlChart ControlCharts::Recorder::result() const {
  ControlChart result = chart;
  result.shown = points.result();
  return result;
}

namespace {

template <class Subgroups>
std::size_t usual_size(const Subgroups& subgroups) {
  std::map<std::size_t, std::size_t> often;
  for (const auto& subgroup : subgroups) {
    ++often[subgroup.n];
  }
  const auto most = std::max_element(
      often.begin(), often.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == often.end() ? 0 : most->first;
}

}  // namespace

ControlCharts::Charts::Charts(const std::vector<Subgroup>& first)
    : usual(usual_size(first)), baseline(first.size()) {
  double values = 0.0, weighted = 0.0, means = 0.0, moving = 0.0, ranges = 0.0, sigmas = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Subgroup& subgroup = first[i];
    values += double(subgroup.n);
    weighted += double(subgroup.n) * subgroup.mean;
    means += subgroup.mean;
    moving += i == 0 ? 0.0 : std::abs(subgroup.mean - first[i - 1].mean);
    if (has_range(subgroup.n)) {
      ranges += 1.0;
      sigmas += subgroup.range / control_chart_constants(subgroup.n).d2;
    }
  }
  if (has_range(usual)) {
    const ControlChartConstants& of = control_chart_constants(usual);
    within = sigmas / ranges;
    const double centre = weighted / values, sigma = within / std::sqrt(double(usual));
    mean.set(centre, sigma, centre - 3.0 * sigma, centre + 3.0 * sigma);
    range.set(of.d2 * within, of.d3 * within, of.D3 * of.d2 * within, of.D4 * of.d2 * within);
  }
  if (first.empty()) {
    return;
  }
  const double n = double(first.size()), centre = means / n;
  const double moving_range_mean = first.size() < 2 ? 0.0 : moving / (n - 1.0);
  const ControlChartConstants& two = control_chart_constants(2);
  const double sigma = moving_range_mean / two.d2;
  individual.set(centre, sigma, centre - 3.0 * sigma, centre + 3.0 * sigma);
  moving_range.set(moving_range_mean, two.d3 * sigma, 0.0, two.D4 * moving_range_mean);
}

void ControlCharts::Charts::add(const Subgroup& subgroup) {
  const std::uint64_t number = ++subgroups;
  if (has_range(usual)) {
    const double sigma = within / std::sqrt(double(subgroup.n));
    mean.add(number, subgroup.mean, (subgroup.mean - mean.chart.centre) / sigma);
  }
  if (has_range(usual) && has_range(subgroup.n)) {
    const ControlChartConstants& of = control_chart_constants(subgroup.n);
    range.add(number, subgroup.range, (subgroup.range / within - of.d2) / of.d3, true);
  }
  const auto scaled = [](double value, const ControlChart& chart) {
    return (value - chart.centre) / chart.sigma;
  };
  individual.add(number, subgroup.mean, scaled(subgroup.mean, individual.chart));
  if (number > 1) {
    const double moving = std::abs(subgroup.mean - last_mean);
    moving_range.add(number, moving, scaled(moving, moving_range.chart), true);
  }
  last_mean = subgroup.mean;
}

ControlCharts::Result ControlCharts::Charts::result() const {
  Result result{.subgroup_size = usual,
                .baseline = baseline,
                .mean = {},
                .range = {},
                .individual = individual.result(),
                .moving_range = moving_range.result()};
  if (has_range(usual)) {
    result.mean = mean.result();
    result.range = range.result();
  }
  return result;
}

ControlCharts::ControlCharts(std::size_t baseline) : wanted_(baseline) {
  if (baseline < 2) {
    throw std::domain_error(fmt::format(
        "ControlCharts: expected a baseline of two subgroups or more, found {}", baseline));
  }
}

void ControlCharts::add(std::size_t n, double mean, double range) {
  if (n == 0 || !std::isfinite(mean) || !(range >= 0.0 && std::isfinite(range))) {
    throw std::domain_error(fmt::format(
        "ControlCharts::add: expected values with a mean and a range >= 0, found {} with {} and {}",
        n, mean, range));
  }
  const Subgroup subgroup{.n = n, .mean = mean, .range = range};
  if (charts_) {
    charts_->add(subgroup);
    return;
  }
  baseline_.push_back(subgroup);
  if (baseline_.size() == wanted_) {
    charts_.emplace(baseline_);
    std::for_each(baseline_.begin(), baseline_.end(), [&](const Subgroup& s) { charts_->add(s); });
    baseline_ = {};
  }
}

ControlCharts::Result ControlCharts::result() const {
  if (charts_) {
    return charts_->result();
  }
  Charts charts(baseline_);
  std::for_each(baseline_.begin(), baseline_.end(), [&](const Subgroup& s) { charts.add(s); });
  return charts.result();
}

}  // namespace gonio
