#include "emulator/procedure/panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace gonio {

namespace {

/// Readings are decimal fractions, which a double holds to its last bits only: 16.4 - 6.4 is 10.
constexpr double last_bits_gu = 1e-9;

bool reaches(double value_gu, double limit_gu) { return value_gu >= limit_gu - last_bits_gu; }
bool exceeds(double value_gu, double limit_gu) { return value_gu > limit_gu + last_bits_gu; }

void expect_numbers(const std::vector<double>& readings_gu) {
  if (readings_gu.empty()) {
    throw std::invalid_argument("judge_panel: no readings");
  }
  for (const double reading : readings_gu) {
    if (!std::isfinite(reading)) {
      throw std::invalid_argument(fmt::format("judge_panel: a reading of {} GU", reading));
    }
  }
}

double largest_deviation(const std::vector<double>& readings_gu, double mean_gu) {
  double largest = 0.0;
  for (const double reading : readings_gu) {
    largest = std::max(largest, std::abs(reading - mean_gu));
  }
  return largest;
}

PanelResult statistics(const std::vector<double>& readings_gu) {
  PanelResult result{.n = readings_gu.size()};
  const double n = double(readings_gu.size());
  result.mean_gu = std::accumulate(readings_gu.begin(), readings_gu.end(), 0.0) / n;
  const auto [low, high] = std::minmax_element(readings_gu.begin(), readings_gu.end());
  result.range_gu = *high - *low;
  double squares = 0.0;
  for (const double reading : readings_gu) {
    squares += (reading - result.mean_gu) * (reading - result.mean_gu);
  }
  result.standard_deviation_gu = result.n > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  if (result.mean_gu > 0.0) {
    result.largest_relative_deviation =
        largest_deviation(readings_gu, result.mean_gu) / result.mean_gu;
  }
  return result;
}

bool is_rejected(const PanelResult& panel, const ReadingRule::Reject& rule) {
  return (rule.range_at_least_gu && reaches(panel.range_gu, *rule.range_at_least_gu)) ||
         (rule.share_at_least && panel.mean_gu > 0.0 &&
          reaches(panel.range_gu, *rule.share_at_least * panel.mean_gu));
}

bool is_not_uniform(const PanelResult& panel, const ReadingRule::NotUniform& rule) {
  return panel.largest_relative_deviation &&
         exceeds(*panel.largest_relative_deviation * panel.mean_gu,
                 rule.when_share_above * panel.mean_gu);
}

/// Where the standard does not say how many further readings, one at least.
std::size_t needed_with_more(const ReadingRule& rule) {
  return std::size_t(rule.count.at_least + (rule.more ? rule.more->count.value_or(1) : 0));
}

bool may_be_asked_for_more(const ReadingRule& rule, const PanelResult& panel) {
  return panel.n < needed_with_more(rule);
}

/// Of the rules that a panel has passed.
Evidence weakest_of(const ReadingRule& rule, const PanelResult& panel) {
  Evidence weakest = rule.count.evidence;
  const auto ask = [&](const auto& part) {
    if (part) {
      weakest = Evidence::weaker(weakest, part->evidence);
    }
  };
  ask(rule.reject);
  ask(rule.not_uniform);
  if (may_be_asked_for_more(rule, panel)) {
    ask(rule.more);
  }
  return weakest;
}

}  // namespace

const char* panel_verdict_name(PanelVerdict verdict) {
  return panel_verdict_names[std::size_t(verdict)];
}

PanelResult judge_panel(const std::vector<double>& readings_gu, const ReadingRule& rule) {
  expect_numbers(readings_gu);
  PanelResult panel = statistics(readings_gu);
  const auto found = [&](PanelVerdict verdict, const Evidence& evidence, std::size_t needed) {
    panel.verdict = verdict;
    panel.evidence = evidence;
    panel.further = std::max(needed, panel.n) - panel.n;
    return panel;
  };
  const auto at_least = std::size_t(rule.count.at_least);
  if (panel.n < at_least) {
    return found(PanelVerdict::more_readings, rule.count.evidence, at_least);
  }
  if (rule.reject && is_rejected(panel, *rule.reject)) {
    return found(PanelVerdict::rejected, rule.reject->evidence, 0);
  }
  if (rule.not_uniform && is_not_uniform(panel, *rule.not_uniform)) {
    return found(PanelVerdict::not_uniform, rule.not_uniform->evidence, 0);
  }
  if (may_be_asked_for_more(rule, panel) &&
      exceeds(panel.range_gu, rule.more->when_range_above_gu)) {
    return found(PanelVerdict::more_readings, rule.more->evidence, needed_with_more(rule));
  }
  return found(PanelVerdict::accepted, weakest_of(rule, panel), 0);
}

}  // namespace gonio
