#include "emulator/quality/acceptance_probability.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/quality/normal_nodes.hpp"
#include "emulator/statistics/sampling_plan.hpp"

namespace gonio {

namespace {

using Kind = AcceptanceRule::Kind;

/// Share of panels that the reading rule may reject while a closed form leaves it out.
constexpr double negligible_share = 1e-6;
/// Of standard deviations: what no lot reaches.
constexpr double reach = 6.5;

std::vector<double> distances(const Interval& limits, double from) {
  std::vector<double> result;
  for (const std::optional<double>& limit : {limits.low, limits.high}) {
    if (limit) {
      result.push_back(*limit - from);
    }
  }
  return result;
}

/// Of sums of counts, up to where the shorter one ends.
std::vector<double> convolved(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      result[i] += a[j] * b[i - j];
    }
  }
  return result;
}

double squared(double x) { return x * x; }

}  // namespace

AcceptanceProbability::AcceptanceProbability(const Batch& batch,
                                             const ReadingUncertainties& uncertainties,
                                             std::uint32_t channel)
    : batch_(batch),
      uncertainties_(uncertainties),
      channel_(channel),
      readings_(double(batch.plan.positions.size() * batch.plan.repetitions)) {
  for (std::size_t i = 0; i < batch.instruments.size(); ++i) {
    largest_uncertainty_ = std::max(largest_uncertainty_, of(i).expanded.value_or(0.0));
  }
  const std::uint64_t appraisers = batch.appraisers(), panels = batch.plan.panels;
  const bool all_alike = batch.instruments.size() == 1 || panels % appraisers == 0;
  for (std::uint64_t lot = 0; lot < (all_alike ? 1 : appraisers); ++lot) {
    phases_.push_back(shares_from(lot * panels));
  }
  closed_form_ = name();
}

const ReadingUncertainty& AcceptanceProbability::of(std::size_t instrument) const {
  return uncertainties_.at(instrument * batch_.channels.size() + channel_);
}

AcceptanceProbability::Shares AcceptanceProbability::shares_from(std::uint64_t first_panel) const {
  const std::uint64_t appraisers = batch_.appraisers(), panels = batch_.plan.panels;
  Shares shares;
  for (std::size_t i = 0; i < batch_.instruments.size(); ++i) {
    shares.push_back({.instrument = i});
  }
  for (std::uint64_t a = 0; a < appraisers; ++a) {
    const std::uint64_t begin = (first_panel + a) % appraisers;
    shares[begin / batch_.operators.size()].panels +=
        panels / appraisers + (a < panels % appraisers ? 1 : 0);
  }
  std::erase_if(shares, [](const Share& share) { return share.panels == 0; });
  return shares;
}

bool AcceptanceProbability::instruments_err_apart() const {
  return batch_.instruments.size() > 1 && largest_error() > 0.0;
}

double AcceptanceProbability::largest_error() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < batch_.instruments.size(); ++i) {
    largest = std::max(largest, of(i).systematic);
  }
  return largest;
}

std::string AcceptanceProbability::name() const {
  const bool is_alone =
      batch_.requirements.size() == 1 && batch_.requirements.front().channel == channel_;
  if (!is_alone || batch_.selected_only ||
      batch_.channels.at(channel_).kind == BatchChannel::Kind::haze) {
    return {};
  }
  const Interval& limits = batch_.requirements.front().limits;
  switch (batch_.plan.accept.kind) {
    case Kind::attributes:
      return "binomial";
    case Kind::mean:
      return "normal";
    case Kind::variables:
      break;
  }
  const bool has_one_limit = limits.low.has_value() != limits.high.has_value();
  return has_one_limit && batch_.plan.panels > 1 && !instruments_err_apart() ? "noncentral t" : "";
}

/// Within which a mean of that U is accepted.
Interval AcceptanceProbability::acceptance(double expanded_uncertainty) const {
  const double guard = batch_.decision.rule == DecisionRule::guarded
                           ? batch_.decision.guard_band_factor * expanded_uncertainty
                           : 0.0;
  Interval limits = batch_.requirements.front().limits;
  if (limits.low) {
    *limits.low += guard;
  }
  if (limits.high) {
    *limits.high -= guard;
  }
  return limits;
}

double AcceptanceProbability::panel_spread(const NormalComponents& product) const {
  return std::hypot(product.sd_panels, product.sd_readings / std::sqrt(readings_));
}

/// The least range at which the reading rule does something that the plan notices.
double AcceptanceProbability::least_range(const NormalComponents& product) const {
  const ReadingRule& rule = *batch_.standard.readings;
  const bool is_by_attributes = batch_.plan.accept.kind == Kind::attributes;
  double least = HUGE_VAL;
  if (is_by_attributes || !batch_.plan.further_positions.empty()) {
    const int count = rule.count.at_least;
    if (readings_ < count) {
      return 0.0;
    }
    if (rule.more && readings_ < count + rule.more->count.value_or(1)) {
      least = rule.more->when_range_above_gu;
    }
  }
  if (is_by_attributes && rule.reject) {
    const double spread =
        std::hypot(std::hypot(product.sd_lots, largest_error()), panel_spread(product));
    const double low_gloss = std::max(0.0, product.mean - reach * spread);
    least = std::min({least, rule.reject->range_at_least_gu.value_or(HUGE_VAL),
                      rule.reject->share_at_least.value_or(HUGE_VAL) * low_gloss});
  }
  return least;
}

/// A range is above w only if one of all differences is: so the share is bounded.
bool AcceptanceProbability::rule_has_a_say(const NormalComponents& product) const {
  if (!batch_.standard.readings || batch_.channels[channel_].kind != BatchChannel::Kind::gloss) {
    return false;
  }
  const double least = least_range(product);
  if (product.sd_readings == 0.0 || least == 0.0) {
    return least == 0.0;
  }
  const double differences = 0.5 * readings_ * (readings_ - 1.0);
  return differences * std::erfc(least / (2.0 * product.sd_readings)) > negligible_share;
}

/// Probability of each number of panels that are not accepted, up to the acceptance number, of
/// those that one instrument reads.
std::vector<double> AcceptanceProbability::refused_panels(const NormalComponents& product,
                                                          const Share& share, double lot) const {
  const ReadingUncertainty& instrument = of(share.instrument);
  const Interval limits = acceptance(instrument.expanded.value_or(0.0));
  const double sd = panel_spread(product), mean = product.mean + lot + share.bias;
  std::vector<double> result(batch_.plan.accept.nonconforming + 1);
  std::vector<double> ways;  // of choosing j panels, as logarithms
  for (std::size_t j = 0; j < result.size() && j <= share.panels; ++j) {
    const double n = double(share.panels), k = double(j);
    ways.push_back(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0));
  }
  const auto times = [](double n, double log) { return n == 0.0 ? 0.0 : n * log; };
  for (const NormalNode& error : normal_nodes(instrument.systematic, distances(limits, mean), sd)) {
    const double p = beyond_limits(mean + error.x, sd, limits);
    const double log_refused = std::log(p), log_accepted = std::log1p(-p);
    for (std::size_t j = 0; j < ways.size(); ++j) {
      result[j] += error.weight * std::exp(ways[j] + times(double(j), log_refused) +
                                           times(double(share.panels - j), log_accepted));
    }
  }
  return result;
}

double AcceptanceProbability::by_attributes(const NormalComponents& product,
                                            const Shares& shares) const {
  const std::uint64_t c = batch_.plan.accept.nonconforming;
  if (c >= batch_.plan.panels) {
    return 1.0;
  }
  const double sd = panel_spread(product);
  double accepted = 0.0;
  if (shares.size() == 1) {
    const ReadingUncertainty& instrument = of(shares.front().instrument);
    const Interval limits = acceptance(instrument.expanded.value_or(0.0));
    const double shared = std::hypot(product.sd_lots, instrument.systematic);
    const double mean = product.mean + shares.front().bias;
    for (const NormalNode& node : normal_nodes(shared, distances(limits, mean), sd)) {
      const double p = beyond_limits(mean + node.x, sd, limits);
      accepted += node.weight * accepted_by_attributes(batch_.plan.panels, c, p);
    }
    return accepted;
  }
  std::vector<double> centres;
  for (const Share& share : shares) {
    const auto add = distances(acceptance(of(share.instrument).expanded.value_or(0.0)),
                               product.mean + share.bias);
    centres.insert(centres.end(), add.begin(), add.end());
  }
  for (const NormalNode& lot : normal_nodes(product.sd_lots, centres, sd)) {
    std::vector<double> all(c + 1);
    all[0] = 1.0;
    for (const Share& share : shares) {
      all = convolved(all, refused_panels(product, share, lot.x));
    }
    for (const double of_number : all) {
      accepted += lot.weight * of_number;
    }
  }
  return accepted;
}

double AcceptanceProbability::by_mean(const NormalComponents& product, const Shares& shares) const {
  const double n = double(batch_.plan.panels);
  double variance = squared(product.sd_lots) + squared(panel_spread(product)) / n;
  double mean = product.mean;
  for (const Share& share : shares) {
    mean += double(share.panels) / n * share.bias;
    variance += squared(double(share.panels) / n * of(share.instrument).systematic);
  }
  return within_limits(mean, std::sqrt(variance), acceptance(largest_uncertainty_));
}

double AcceptanceProbability::by_variables(const NormalComponents& product, double bias) const {
  const double mean = product.mean + bias;
  const Interval limits = acceptance(largest_uncertainty_);
  const double sd = panel_spread(product), k = batch_.plan.accept.k;
  const double n = double(batch_.plan.panels);
  const double nearest = (limits.high ? *limits.high - k * sd : *limits.low + k * sd);
  const double shared = std::hypot(product.sd_lots, of(0).systematic);
  // Of the mean, less k times the standard deviation.
  const double scale = sd * std::sqrt(1.0 / n + k * k / (2.0 * n));
  double accepted = 0.0;
  for (const NormalNode& node : normal_nodes(shared, {nearest - mean}, scale)) {
    accepted +=
        node.weight *
        accepted_by_variables(batch_.plan.panels, k, mean + node.x, sd, limits).value_or(0.0);
  }
  return accepted;
}

std::optional<double> AcceptanceProbability::operator()(const NormalComponents& product,
                                                        const std::vector<double>& bias) const {
  const bool is_by_variables = batch_.plan.accept.kind == Kind::variables;
  if (closed_form_.empty() || rule_has_a_say(product) || (is_by_variables && bias.size() > 1)) {
    return std::nullopt;
  }
  double sum = 0.0;
  for (Shares shares : phases_) {
    for (Share& share : shares) {
      share.bias = bias.empty() ? 0.0 : bias.at(share.instrument);
    }
    switch (batch_.plan.accept.kind) {
      case Kind::attributes:
        sum += by_attributes(product, shares);
        break;
      case Kind::mean:
        sum += by_mean(product, shares);
        break;
      case Kind::variables:
        sum += by_variables(product, shares.front().bias);
        break;
    }
  }
  return std::clamp(sum / double(phases_.size()), 0.0, 1.0);
}

}  // namespace gonio
