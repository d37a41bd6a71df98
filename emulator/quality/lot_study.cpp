#include "emulator/quality/lot_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "emulator/core/parallel_for.hpp"
#include "emulator/quality/panel_judgement.hpp"

namespace gonio {

namespace {

constexpr std::uint64_t first_studied_lot = 1ULL << 32U;
/// Enough to outweigh what a thread costs, few enough to share out evenly.
constexpr std::uint64_t lots_per_block = 8;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool keeps(double truth, const Interval& limits) {
  return decide(truth, 0.0, limits, DecisionRule::simple) == ConformanceVerdict::pass;
}

/// Where no limit counts nothing is refused either.
bool is_accepted(ConformanceVerdict verdict) {
  return verdict == ConformanceVerdict::pass || verdict == ConformanceVerdict::not_applicable;
}

/// @param keeps_it  of a requirement whose truth is known.
template <class Keeps>
bool conforms(const Batch& batch, const std::vector<double>& truth, const Keeps& keeps_it) {
  const auto selected = selected_geometry(batch, truth);
  return std::all_of(batch.requirements.begin(), batch.requirements.end(),
                     [&](const Requirement& requirement) {
                       return !std::isfinite(truth[requirement.channel]) ||
                              !counts(batch, requirement, selected) || keeps_it(requirement);
                     });
}

bool panel_conforms(const Batch& batch, const PanelRecord& panel) {
  std::vector<double> truth(batch.channels.size(), none);
  for (const ChannelResult& result : panel.channels) {
    truth[result.channel] = result.truth.value_or(none);
  }
  return conforms(batch, truth, [&](const Requirement& requirement) {
    return keeps(truth[requirement.channel], requirement.limits);
  });
}

bool lot_conforms(const Batch& batch, const LotTruth& truth) {
  return conforms(batch, truth.mean, [&](const Requirement& requirement) {
    const std::uint32_t c = requirement.channel;
    return batch.plan.accept.kind == AcceptanceRule::Kind::mean
               ? keeps(truth.mean[c], requirement.limits)
               : truth.beyond[c] <= batch.plan.acceptable_share;
  });
}

void add_truth(const LotTruth& truth, LotStudy& study) {
  for (std::size_t c = 0; c < study.channels.size(); ++c) {
    if (std::isfinite(truth.mean[c])) {
      study.channels[c].lot_means.add(truth.mean[c]);
      study.channels[c].lot_spreads.add(truth.sd[c]);
      study.channels[c].lot_beyond.add(truth.beyond[c]);
    }
  }
}

void add_panel(const Batch& batch, const PanelRecord& panel, LotStudy& study) {
  study.panels.add(panel_conforms(batch, panel), is_accepted(panel.verdict));
  for (const ChannelResult& result : panel.channels) {
    ChannelTruths& of_channel = study.channels[result.channel];
    if (result.truth) {
      of_channel.panels.add(*result.truth);
      of_channel.errors[panel.readings.front().instrument].add(result.mean - *result.truth);
    }
  }
}

}  // namespace

void Moments::add(double value) {
  ++n_;
  const double from_last_mean = value - mean_;
  mean_ += from_last_mean / double(n_);
  sum_of_squares_ += from_last_mean * (value - mean_);
}

void Moments::add(const Moments& other) {
  if (other.n_ == 0) {
    return;
  }
  const double n = double(n_), m = double(other.n_), apart = other.mean_ - mean_;
  n_ += other.n_;
  mean_ += apart * m / (n + m);
  sum_of_squares_ += other.sum_of_squares_ + apart * apart * n * m / (n + m);
}

double Moments::standard_deviation() const {
  return n_ < 2 ? 0.0 : std::sqrt(sum_of_squares_ / double(n_ - 1));
}

double Moments::root_mean_square() const {
  return n_ == 0 ? 0.0 : std::sqrt(sum_of_squares_ / double(n_) + mean_ * mean_);
}

void DecisionCounts::add(bool conforms, bool is_accepted) {
  ++all;
  conforming += conforms ? 1 : 0;
  accepted += is_accepted ? 1 : 0;
  producer += conforms && !is_accepted ? 1 : 0;
  consumer += !conforms && is_accepted ? 1 : 0;
}

void DecisionCounts::add(const DecisionCounts& other) {
  all += other.all;
  conforming += other.conforming;
  accepted += other.accepted;
  producer += other.producer;
  consumer += other.consumer;
}

RiskSummary DecisionCounts::summary() const {
  return {.conforming = proportion(conforming, all),
          .accepted = proportion(accepted, all),
          .producer = proportion(producer, all),
          .consumer = proportion(consumer, all)};
}

void ChannelTruths::add(const ChannelTruths& other) {
  lot_means.add(other.lot_means);
  lot_spreads.add(other.lot_spreads);
  lot_beyond.add(other.lot_beyond);
  panels.add(other.panels);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    errors[i].add(other.errors[i]);
  }
}

Moments ChannelTruths::all_errors() const {
  Moments all;
  for (const Moments& of_instrument : errors) {
    all.add(of_instrument);
  }
  return all;
}

void LotStudy::add(const LotStudy& other) {
  lots.add(other.lots);
  panels.add(other.panels);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    channels[c].add(other.channels[c]);
  }
}

Estimate LotStudy::not_accepted() const { return proportion(lots.all - lots.accepted, lots.all); }

void StudyProgress::advance(std::size_t steps) {
  const std::lock_guard lock(one_at_a_time_);
  done_ = std::min(done_ + steps, total_);
  if (options_.advance) {
    options_.advance(work_, done_, total_);
  }
}

void StudyProgress::finish() {
  if (done_ < total_) {
    advance(total_);
  }
}

std::size_t study_steps(std::uint64_t lots) {
  return std::size_t((lots + lots_per_block - 1) / lots_per_block);
}

LotStudy study_lots(const Batch& batch, const ReadingUncertainties& uncertainties,
                    const PanelSource& source, std::uint64_t lots, StudyProgress& progress) {
  const PanelJudge judge(batch, uncertainties);
  ChannelTruths no_truths;
  no_truths.errors.resize(batch.instruments.size());
  const LotStudy empty{.lots = {},
                       .panels = {},
                       .channels = std::vector<ChannelTruths>(batch.channels.size(), no_truths)};
  std::vector<LotStudy> blocks(study_steps(lots), empty);
  parallel_for(blocks.size(), [&](std::size_t block) {
    LotJudge lot_judge(batch, judge);
    const std::uint64_t end = std::min(lots, (block + 1) * lots_per_block);
    for (std::uint64_t i = block * lots_per_block; i < end; ++i) {
      const std::uint64_t lot = first_studied_lot + i;
      for (std::uint64_t panel = 1; panel <= batch.plan.panels; ++panel) {
        const PanelRecord record = source.inspect((lot - 1) * batch.plan.panels + panel);
        add_panel(batch, record, blocks[block]);
        lot_judge.add(record);
      }
      const LotTruth truth = source.truth(lot);
      add_truth(truth, blocks[block]);
      blocks[block].lots.add(lot_conforms(batch, truth), is_accepted(lot_judge.result().verdict));
    }
    progress.advance();
  });
  LotStudy study = empty;
  for (const LotStudy& block : blocks) {
    study.add(block);
  }
  return study;
}

double true_mean(const PanelSource& source, std::uint32_t channel, std::uint64_t lots) {
  std::vector<double> means(lots);
  parallel_for(lots, [&](std::size_t i) {
    means[i] = source.truth(first_studied_lot + i).mean.at(channel);
  });
  Moments all;
  for (const double mean : means) {
    if (std::isfinite(mean)) {
      all.add(mean);
    }
  }
  return all.mean();
}

}  // namespace gonio
