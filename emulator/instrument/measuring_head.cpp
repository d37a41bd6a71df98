#include "emulator/instrument/measuring_head.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "emulator/instrument/signal.hpp"
#include "emulator/statistics/running_statistics.hpp"

namespace gonio {

namespace {

/// A calibration averages as many readings as its time allows, up to that.
constexpr int most_averaged = 100;

int averaged_readings(const Behaviour& behaviour) {
  if (!(behaviour.reading_s > 0.0)) {
    return 1;
  }
  return int(std::clamp(behaviour.calibration_s / behaviour.reading_s, 1.0, double(most_averaged)));
}

bool is_in_range(InstrumentFault fault, double magnitude) {
  const auto range = magnitude_range(fault);
  return !range || range->contains(magnitude);
}

}  // namespace

MeasuringHead::MeasuringHead(Behaviour behaviour, std::vector<Channel> channels,
                             std::vector<DeviceSample> samples)
    : behaviour_(std::move(behaviour)),
      channels_(std::move(channels)),
      samples_(std::move(samples)) {
  const auto has_all_channels = [&](const DeviceSample& sample) {
    return sample.gloss_gu.size() == channels_.size();
  };
  if (channels_.empty() || !std::all_of(samples_.begin(), samples_.end(), has_all_channels) ||
      (!behaviour_.full_scale_gu.empty() && behaviour_.full_scale_gu.size() != channels_.size())) {
    throw std::invalid_argument("MeasuringHead: expected one value for each of its channels");
  }
  for (const TimedFault& timed : behaviour_.faults) {
    if (!is_in_range(timed.fault, timed.magnitude)) {
      throw std::invalid_argument(
          fmt::format("MeasuringHead: a magnitude of {} is out of its range", timed.magnitude));
    }
  }
  std::stable_sort(behaviour_.faults.begin(), behaviour_.faults.end(),
                   [](const auto& a, const auto& b) { return a.after_s < b.after_s; });
  reset();
}

void MeasuringHead::reset() {
  calibrations_.assign(channels_.size(), {});
  last_.assign(channels_.size(), {});
}

void MeasuringHead::place(PortCover cover, int sample) {
  if (cover == PortCover::sample) {
    (void)samples_.at(std::size_t(sample));
  }
  cover_ = cover;
  sample_ = cover == PortCover::sample ? sample : 0;
}

bool MeasuringHead::set_fault(InstrumentFault fault, bool on, double magnitude) {
  if (on && !is_in_range(fault, magnitude)) {
    return false;
  }
  faults_.at(std::size_t(fault)) = {.is_on = on,
                                    .magnitude = on && magnitude_range(fault) ? magnitude : 0.0};
  return true;
}

double MeasuringHead::gloss_on_port_gu(std::size_t channel) const {
  switch (cover_) {
    case PortCover::tile:
      return channels_[channel].tile_optics_gu * (1.0 - behaviour_.tile_contamination) *
             (1.0 - faults_[std::size_t(InstrumentFault::tile_dirty)].magnitude);
    case PortCover::sample:
      return samples_[std::size_t(sample_)].gloss_gu[channel];
    case PortCover::nothing:
    case PortCover::black_trap:
      break;
  }
  return 0.0;
}

double MeasuringHead::signal_gu(std::size_t channel, double t_s) const {
  const double stray_light_gu = behaviour_.stray_light_gu +
                                (cover_ == PortCover::nothing ? behaviour_.ambient_light_gu : 0.0);
  const double step = 1.0 + faults_[std::size_t(InstrumentFault::drift_step)].magnitude;
  return step *
             clean_signal_gu(behaviour_, channel, gloss_on_port_gu(channel), stray_light_gu, t_s) +
         behaviour_.repeatability_gu * normal_noise(behaviour_.seed, channel, light_count_);
}

ChannelValue MeasuringHead::shown(std::size_t channel, double signal_gu) const {
  if (is_on(InstrumentFault::frozen_reading) &&
      last_[channel].status != ReadingStatus::not_measured) {
    return last_[channel];
  }
  const Calibration& calibration = calibrations_[channel];
  const double gloss_gu =
      displayed(calibration.gain * (signal_gu - calibration.zero_gu), behaviour_.resolution_gu);
  const bool is_beyond_scale =
      !behaviour_.full_scale_gu.empty() && gloss_gu > behaviour_.full_scale_gu[channel];
  if (is_beyond_scale || is_on(InstrumentFault::over_range)) {
    return {.status = ReadingStatus::over_range};
  }
  return {.status = ReadingStatus::valid, .gloss_gu = gloss_gu};
}

std::vector<ChannelValue> MeasuringHead::read(double t_s) {
  ++light_count_;
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    last_[channel] = shown(channel, signal_gu(channel, t_s));
  }
  return last_;
}

std::vector<double> MeasuringHead::mean_signals_gu(double begin_s, double end_s) {
  const int n = averaged_readings(behaviour_);
  std::vector<RunningStatistics> signals(channels_.size());
  for (int i = 1; i <= n; ++i) {
    ++light_count_;
    for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
      signals[channel].add(signal_gu(channel, begin_s + (end_s - begin_s) * i / n));
    }
  }
  std::vector<double> means;
  means.reserve(signals.size());
  for (const RunningStatistics& signal : signals) {
    means.push_back(signal.result().mean);
  }
  return means;
}

MeasuringHead::Finding MeasuringHead::calibrate(double begin_s, double end_s,
                                                const std::vector<double>& tile_gu) {
  const std::vector<double> signals = mean_signals_gu(begin_s, end_s);
  std::vector<Calibration> found = calibrations_;
  Finding finding{.by_channel_gu = {}, .is_accepted = true};
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    const double net_gu = signals[channel] - found[channel].zero_gu;
    const double deviation_gu = net_gu - tile_gu[channel];
    found[channel].gain = tile_gu[channel] / net_gu;
    finding.by_channel_gu.push_back(deviation_gu);
    finding.is_accepted =
        finding.is_accepted && net_gu > 0.0 && std::abs(deviation_gu) <= behaviour_.tile_limit_gu;
  }
  if (finding.is_accepted) {
    calibrations_ = found;
  }
  return finding;
}

MeasuringHead::Finding MeasuringHead::zero(double begin_s, double end_s) {
  Finding finding{.by_channel_gu = mean_signals_gu(begin_s, end_s)};
  finding.is_accepted =
      std::all_of(finding.by_channel_gu.begin(), finding.by_channel_gu.end(),
                  [](double offset_gu) { return std::abs(offset_gu) <= zero_limit_gu; });
  for (std::size_t channel = 0; finding.is_accepted && channel < channels_.size(); ++channel) {
    calibrations_[channel].zero_gu = finding.by_channel_gu[channel];
  }
  return finding;
}

}  // namespace gonio
