#include "tests/conformance/bench.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace gonio::conformance {

namespace {

constexpr double coverage_factor = 2.0;
constexpr double warm_up_step_s = 5.0;
constexpr double longest_warm_up_s = 3600.0;
constexpr double same_angle_deg = 0.5;  // a channel names its nominal angle

std::string words_for(DeviceCommand command) {
  switch (command) {
    case DeviceCommand::measure:
      return "measure";
    case DeviceCommand::calibrate:
      return "calibrate";
    case DeviceCommand::zero:
      return "find its zero";
    case DeviceCommand::restart:
      return "restart";
    case DeviceCommand::clear_statistics:
      return "clear its statistics";
    default:
      return fmt::format("run command {}", int(command));
  }
}

std::string words_for(DeviceError error) {
  switch (error) {
    case DeviceError::none:
      return "nothing";
    case DeviceError::busy:
      return "busy";
    case DeviceError::warming_up:
      return "the lamp warms up";
    case DeviceError::not_calibrated:
      return "not calibrated";
    case DeviceError::not_on_tile:
      return "not on the tile";
    case DeviceError::not_on_trap:
      return "not on the black trap";
    case DeviceError::tile_out_of_tolerance:
      return "the tile is out of tolerance";
    case DeviceError::lamp_failure:
      return "the lamp has failed";
    case DeviceError::zero_out_of_tolerance:
      return "the zero is out of tolerance";
    default:
      return fmt::format("error {}", int(error));
  }
}

/// To the rounding of a 32-bit number, as a wire carries it.
bool is_multiple(double value, double step) {
  constexpr double float32_rounding = 1.2e-7;  // relative
  constexpr double of_quotient = 1e-6;
  const double steps = value / step;
  return std::abs(steps - std::round(steps)) <= float32_rounding * std::abs(steps) + of_quotient;
}

/// The channel of a geometry: by its id where the port knows it, else by its angle. By angle alone
/// a receptor beside the mirror direction cannot be told from the one within it.
std::optional<std::size_t> channel_for(const GeometryLimits& geometry,
                                       const std::vector<PortChannel>& channels) {
  for (std::size_t j = 0; j < channels.size(); ++j) {
    const double offset = channels[j].theta_i.degrees() - geometry.theta_i.nominal.degrees();
    const bool is_meant = channels[j].geometry_id.empty() ? !geometry.relative_to
                                                          : channels[j].geometry_id == geometry.id;
    if (is_meant && std::abs(offset) < same_angle_deg) {
      return j;
    }
  }
  return std::nullopt;
}

}  // namespace

ChannelStatistics ChannelReadings::statistics() const {
  RunningStatistics running;  // whose deviation of equal readings is 0 to the last bit
  for (const double reading : gloss_gu) {
    running.add(reading);
  }
  return running.result();
}

std::vector<Bench::Geometry> Bench::geometries() {
  std::vector<Geometry> found;
  if (standard_ == nullptr) {
    return found;
  }
  for (const GeometryLimits& geometry : standard_->geometries) {
    if (const auto channel = channel_for(geometry, port().channels())) {
      found.push_back({.id = geometry.id, .channel = *channel});
    }
  }
  return found;
}

std::optional<std::size_t> Bench::channel(const std::string& geometry_id) {
  for (const Geometry& geometry : geometries()) {
    if (geometry.id == geometry_id) {
      return geometry.channel;
    }
  }
  return std::nullopt;
}

void Bench::must(DeviceCommand command) {
  const DeviceError error = port().command(command);
  if (error != DeviceError::none) {
    throw DeviceRefused(
        fmt::format("the device does not {}: {}", words_for(command), words_for(error)));
  }
}

void Bench::wait_until_ready() {
  double waited_s = 0.0;
  while (port().status().state == DeviceState::warm_up) {
    if (waited_s >= longest_warm_up_s) {
      throw DeviceRefused("the device still warms up after an hour");
    }
    port().pass(warm_up_step_s);
    waited_s += warm_up_step_s;
  }
}

void Bench::prepare() {
  if (is_prepared_) {
    return;
  }
  wait_until_ready();
  port().place(PortCover::black_trap);
  must(DeviceCommand::zero);
  port().place(PortCover::tile);
  must(DeviceCommand::calibrate);
  is_prepared_ = true;
}

std::vector<ChannelReadings> Bench::read(PortCover cover, const std::string& sample, int readings) {
  port().place(cover, sample);
  std::vector<ChannelReadings> result;
  const std::vector<Geometry> known = geometries();
  result.reserve(known.size());
  for (const Geometry& geometry : known) {
    result.push_back({.geometry = geometry.id});
  }
  for (int i = 0; i < readings; ++i) {
    must(DeviceCommand::measure);
    const PortStatus status = port().status();
    for (std::size_t j = 0; j < known.size(); ++j) {
      const ChannelValue& value = status.readings.at(known[j].channel);
      if (value.status == ReadingStatus::not_measured) {
        throw std::runtime_error(fmt::format("no reading at {}", known[j].id));
      }
      result[j].is_over_range =
          result[j].is_over_range || value.status == ReadingStatus::over_range;
      if (value.status == ReadingStatus::valid) {
        result[j].gloss_gu.push_back(value.gloss_gu);
        if (!is_multiple(value.gloss_gu, display_step_gu_)) {
          display_step_gu_ =
              display_step_gu_ > 0.05 && is_multiple(value.gloss_gu, 0.01) ? 0.01 : 1e-6;
        }
      }
    }
  }
  return result;
}

double Bench::expanded_uncertainty_gu(const ChannelReadings& readings) const {
  const double n = double(std::max<std::size_t>(readings.gloss_gu.size(), 1));
  const double scatter = readings.deviation_gu();
  const double resolution = display_step_gu_ / std::sqrt(12.0);
  // Readings that scatter round the display's steps are rounded each for itself; readings that are
  // all the same are rounded all alike.
  const double standard_uncertainty =
      scatter > 0.0 ? std::hypot(scatter, resolution) / std::sqrt(n) : resolution;
  return coverage_factor * standard_uncertainty;
}

}  // namespace gonio::conformance
