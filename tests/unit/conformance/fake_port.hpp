#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/conformance/bench.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio::test {

/// A device of three angles that does what a test writes into it, and keeps account of what was
/// done with it.
class FakePort final : public conformance::DevicePort {
 public:
  struct Laid {
    std::vector<double> gloss_gu;      ///< by channel; NaN-free
    std::vector<double> scatter = {};  ///< added to reading 0, 1, 2, 0, ... in all channels
  };

  FakePort() {
    identity_.model = "fake";
    for (const char* id : {"20", "60", "85"}) {
      known.push_back({.geometry_id = id, .theta_i = degrees(std::stod(id))});
    }
    laid["tile"] = {.gloss_gu = {100.0, 100.0, 100.0}};
    laid["black_trap"] = {.gloss_gu = {0.0, 0.0, 0.0}};
  }

  std::vector<conformance::PortChannel> known = {};
  std::map<std::string, Laid> laid = {};  ///< tile, black_trap, or the id of a sample
  std::map<DeviceCommand, DeviceError> refusals = {};
  std::map<std::size_t, StatedAngle> incidence = {};  ///< by channel; nothing is stated else
  double warm_up_s = 30.0;
  double interval_s = 8 * 3600.0;
  double drift_per_s = 0.0;           ///< added to every reading, GU
  bool is_lost = false;               ///< no answer any more
  std::vector<std::string> log = {};  ///< what was done: place x, a command, pass 5 s

  [[nodiscard]] const Identity& identity() const override { return identity_; }
  [[nodiscard]] std::string where() const override { return "a test"; }
  [[nodiscard]] const std::vector<conformance::PortChannel>& channels() const override {
    return known;
  }
  [[nodiscard]] std::optional<StatedAngle> setup(std::size_t channel,
                                                 SetupQuantity quantity) override {
    const auto found = incidence.find(channel);
    return found == incidence.end() || quantity != SetupQuantity::theta_i
               ? std::nullopt
               : std::optional(found->second);
  }

  void place(PortCover cover, const std::string& sample) override {
    expect_answer();
    on_port_ = cover == PortCover::tile         ? "tile"
               : cover == PortCover::black_trap ? "black_trap"
                                                : sample;
    if (!laid.contains(on_port_)) {
      throw conformance::NotOffered("there is no " + on_port_);
    }
    readings_ = 0;
    log.push_back("place " + on_port_);
  }

  [[nodiscard]] DeviceError command(DeviceCommand command) override {
    expect_answer();
    log.push_back(fmt::format("command {}", int(command)));
    if (const auto found = refusals.find(command); found != refusals.end()) {
      return found->second;
    }
    return carry_out(command);
  }

  [[nodiscard]] conformance::PortStatus status() override {
    expect_answer();
    conformance::PortStatus status = status_;
    status.state = uptime_s_ < warm_up_s ? DeviceState::warm_up : DeviceState::idle;
    status.is_calibration_due = !calibrated_s_ || uptime_s_ - *calibrated_s_ >= interval_s;
    return status;
  }

  void pass(double seconds) override {
    expect_answer();
    uptime_s_ += seconds;
    log.push_back(fmt::format("pass {} s", seconds));
  }

  /// How often that was done.
  [[nodiscard]] int count(const std::string& done) const {
    return int(std::count(log.begin(), log.end(), done));
  }
  [[nodiscard]] int count(DeviceCommand command) const {
    return count(fmt::format("command {}", int(command)));
  }

 private:
  void expect_answer() const {
    if (is_lost) {
      throw conformance::DeviceLost("it no longer answers");
    }
  }

  DeviceError carry_out(DeviceCommand command) {
    if (command == DeviceCommand::restart) {
      uptime_s_ = 0.0;
      calibrated_s_.reset();
      return DeviceError::none;
    }
    if (command == DeviceCommand::clear_statistics) {
      statistics_ = {};
      return DeviceError::none;
    }
    if (uptime_s_ < warm_up_s) {
      return DeviceError::warming_up;
    }
    if (command == DeviceCommand::calibrate) {
      calibrated_s_ = uptime_s_;
    }
    return command == DeviceCommand::measure ? measure() : DeviceError::none;
  }

  DeviceError measure() {
    if (!calibrated_s_) {
      return DeviceError::not_calibrated;
    }
    const Laid& lies = laid.at(on_port_);
    const double extra = lies.scatter.empty() ? 0.0 : lies.scatter[readings_ % lies.scatter.size()];
    ++readings_;
    status_.readings.clear();
    status_.statistics.clear();
    statistics_.resize(known.size());
    for (std::size_t j = 0; j < known.size(); ++j) {
      const double gloss_gu = lies.gloss_gu[j] + extra + drift_per_s * (uptime_s_ - *calibrated_s_);
      const bool is_over = known[j].full_scale_gu && gloss_gu > *known[j].full_scale_gu;
      status_.readings.push_back(
          is_over ? ChannelValue{.status = ReadingStatus::over_range}
                  : ChannelValue{.status = ReadingStatus::valid, .gloss_gu = gloss_gu});
      if (!is_over) {
        statistics_[j].add(gloss_gu);
      }
      status_.statistics.push_back(statistics_[j].result());
    }
    return DeviceError::none;
  }

  Identity identity_;
  conformance::PortStatus status_;
  std::vector<RunningStatistics> statistics_;
  std::string on_port_ = "tile";
  std::size_t readings_ = 0;
  double uptime_s_ = 0.0;
  std::optional<double> calibrated_s_;
};

inline const Standard& iso_2813() {
  static const Standard standard = shipped_standard("iso_2813/2014");
  return standard;
}

/// A bench with that device, by ISO 2813.
inline conformance::Bench bench_with(FakePort& port) {
  return {&iso_2813(), [&port]() -> conformance::DevicePort& { return port; }};
}

}  // namespace gonio::test
