#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "emulator/quality/lot_study.hpp"
#include "emulator/quality/risk_study.hpp"

namespace gonio {

namespace {

constexpr std::array<std::uint64_t, 9> tried_readings{1, 2, 3, 4, 6, 8, 12, 16, 24};
constexpr std::size_t fewest_rows = 4;
/// To which an allowed spread is found, of itself.
constexpr double spread_tolerance = 0.02;
/// A spread below that share of the largest tried is none.
constexpr double smallest_factor = 1e-3 * largest_spread_factor;

/// So many of the positions, spread evenly over their list.
std::vector<PanelPlace> some_of(const std::vector<PanelPlace>& positions, std::size_t n) {
  std::vector<PanelPlace> some;
  for (std::size_t i = 0; i < n; ++i) {
    some.push_back(positions[(2 * i + 1) * positions.size() / (2 * n)]);
  }
  return some;
}

SamplingPlan with_readings(const SamplingPlan& plan, std::uint64_t readings) {
  SamplingPlan changed = plan;
  const std::size_t positions = plan.positions.size();
  if (readings < positions) {
    changed.positions = some_of(plan.positions, readings);
  }
  changed.repetitions = std::uint32_t(std::max<std::uint64_t>(1, readings / positions));
  return changed;
}

/// Numbers of readings that the positions allow for, and the standard; the present one is among
/// them.
std::vector<std::uint64_t> numbers_to_try(const Batch& batch) {
  const std::uint64_t positions = batch.plan.positions.size();
  std::vector<std::uint64_t> numbers{positions * batch.plan.repetitions};
  for (const std::uint64_t n : tried_readings) {
    numbers.push_back(n <= positions ? n : (n + positions - 1) / positions * positions);
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  if (batch.standard.readings) {
    const auto at_least = std::uint64_t(batch.standard.readings->count.at_least);
    std::erase_if(numbers, [&](std::uint64_t n) { return n < at_least; });
  }
  return numbers;
}

}  // namespace

ReadingsAnswer readings_for_risk(const Batch& batch, const ReadingUncertainties& uncertainties,
                                 const PanelSourceFactory& source, const RiskOptions& options) {
  ReadingsAnswer answer{.risk = options.risk,
                        .present = batch.plan.positions.size() * batch.plan.repetitions,
                        .rows = {}};
  const std::vector<std::uint64_t> numbers = numbers_to_try(batch);
  StudyProgress progress(options, "readings", numbers.size() * study_steps(options.lots_per_point));
  for (const std::uint64_t readings : numbers) {
    if (answer.needed && answer.rows.size() >= fewest_rows && readings > answer.present) {
      break;
    }
    Batch changed = batch;
    changed.plan = with_readings(batch.plan, readings);
    const RiskSummary risks =
        study_lots(changed, uncertainties, *source(changed), options.lots_per_point, progress)
            .lots.summary();
    answer.rows.push_back(
        {.readings = readings, .producer = risks.producer, .consumer = risks.consumer});
    if (!answer.needed && risks.producer.value <= options.risk &&
        risks.consumer.value <= options.risk) {
      answer.needed = readings;
    }
  }
  progress.finish();
  return answer;
}

namespace {

/// Spreads that were tried, as multiples of the present one.
class SpreadSearch {
 public:
  using Try = std::function<SpreadAnswer::Row(double factor)>;

  SpreadSearch(double risk, Try try_factor) : risk_(risk), try_(std::move(try_factor)) {}

  void run(SpreadAnswer& answer) {
    if (is_too_much(0.0)) {
      finish(answer);
      return;
    }
    double good = 0.0, bad = 1.0;
    while (!is_too_much(bad)) {
      good = bad;
      bad *= 2.0;
      if (bad > largest_spread_factor) {
        answer.allowed = rows_.back().spread;
        answer.unlimited = true;
        finish(answer);
        return;
      }
    }
    while (bad - good > spread_tolerance * bad && bad > smallest_factor) {
      const double middle = 0.5 * (good + bad);
      (is_too_much(middle) ? bad : good) = middle;
    }
    answer.allowed = good * unit_;
    finish(answer);
  }

 private:
  bool is_too_much(double factor) {
    rows_.push_back(try_(factor));
    if (factor > 0.0) {
      unit_ = rows_.back().spread / factor;
    }
    return rows_.back().refused.value > risk_;
  }
  void finish(SpreadAnswer& answer) {
    std::sort(rows_.begin(), rows_.end(),
              [](const auto& a, const auto& b) { return a.spread < b.spread; });
    answer.rows = std::move(rows_);
  }

  double risk_;
  Try try_;
  double unit_ = 0.0;
  std::vector<SpreadAnswer::Row> rows_ = {};
};

/// With all levels of one parameter that much wider.
Batch with_spread(const Batch& batch, std::size_t parameter, double factor) {
  Batch changed = batch;
  ParameterSpread& spread = changed.product->spread[parameter];
  spread.lots.standard_uncertainty *= factor;
  spread.panels.standard_uncertainty *= factor;
  spread.within_panel *= factor;
  return changed;
}

/// Steps that a search takes at most: none, doublings, and halvings to the smallest.
std::size_t most_spreads() {
  return 2 + std::size_t(std::ceil(std::log2(largest_spread_factor)) +
                         std::ceil(std::log2(1.0 / (spread_tolerance * smallest_factor))));
}

}  // namespace

SpreadAnswer spread_for_risk(const Batch& batch, std::size_t parameter,
                             const ReadingUncertainties& uncertainties,
                             const PanelSourceFactory& source, const RiskOptions& options) {
  if (parameter >= sample_parameter_count || !batch.product ||
      !(batch.product->spread[parameter].total() > 0.0)) {
    throw std::invalid_argument(fmt::format(
        "spread_for_risk: expected a parameter in which the product varies, found {}", parameter));
  }
  SpreadAnswer answer{.parameter = sample_parameter_names[parameter],
                      .risk = options.risk,
                      .present = batch.product->spread[parameter].total(),
                      .rows = {}};
  StudyProgress progress(options, "spread", most_spreads() * study_steps(options.lots_per_point));
  const auto try_factor = [&](double factor) -> SpreadAnswer::Row {
    const Batch changed = with_spread(batch, parameter, factor);
    const LotStudy study =
        study_lots(changed, uncertainties, *source(changed), options.lots_per_point, progress);
    return {
        .spread = factor * answer.present,
        .refused = study.not_accepted(),
        .beyond = double(study.panels.all - study.panels.conforming) / double(study.panels.all)};
  };
  SpreadSearch(options.risk, try_factor).run(answer);
  progress.finish();
  return answer;
}

}  // namespace gonio
