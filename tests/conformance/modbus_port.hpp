#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/protocol/device_view.hpp"
#include "tests/conformance/device_port.hpp"

namespace gonio::conformance {

/// A device that speaks the register map over Modbus.
///
/// What it does not answer becomes DeviceLost, which names the URL and what was asked. No call
/// waits for longer than Options say, whatever the device does. After a loss each call tries once
/// to find the device again, with a short timeout, until that has taken `search_budget` altogether;
/// from then on it fails at once.
class ModbusPort final : public DevicePort {
 public:
  /// Asks a person to do something with the device. @return  false if nobody will.
  using Ask = std::function<bool(const std::string&)>;

  struct Options {
    std::chrono::milliseconds timeout{1000};          ///< of a connection, and of each answer
    std::chrono::milliseconds short_timeout{250};     ///< the same, to find a lost device again
    std::chrono::milliseconds search_budget{5'000};   ///< for that, altogether
    std::chrono::milliseconds command_limit{60'000};  ///< of one command
    std::chrono::milliseconds patience{60'000};  ///< longest wait for the device's time to pass
    Ask ask = {};  ///< lays something on the port of a device that has no registers for that
  };

  /// Connects, and reads who the device is.
  /// @param url  modbus:// or modbus-rtu:
  /// @throws std::invalid_argument  for a URL that is none, DeviceLost if nothing answers there or
  ///         what answers has not this register map.
  ModbusPort(const std::string& url, Options options);

  [[nodiscard]] const Identity& identity() const override { return identity_; }
  [[nodiscard]] std::string where() const override { return url_.text(); }
  [[nodiscard]] const std::vector<PortChannel>& channels() const override { return channels_; }
  [[nodiscard]] std::optional<StatedAngle> setup(std::size_t channel,
                                                 SetupQuantity quantity) override;
  void place(PortCover cover, const std::string& sample = {}) override;
  [[nodiscard]] DeviceError command(DeviceCommand command) override;
  [[nodiscard]] PortStatus status() override;
  void pass(double seconds) override;

 private:
  using Clock = std::chrono::steady_clock;

  /// Calls `talk(client)`, again while the device is busy. @param what  is asked, for messages.
  template <class Talk>
  auto ask_device(const std::string& what, Talk&& talk);
  ModbusClient& client();
  void search();
  [[noreturn]] void lose(const std::string& why);

  [[nodiscard]] DeviceView read_blocks(const std::vector<std::string>& blocks);
  void read_channels(const DeviceView& view);
  [[nodiscard]] int find_sample(const std::string& id);
  void read_sample_ids();
  [[nodiscard]] double uptime_s();

  DeviceUrl url_;
  Options options_;
  std::optional<ModbusClient> client_;
  std::string loss_;  // why there is no client
  std::chrono::nanoseconds searched_{};
  Identity identity_;
  std::vector<PortChannel> channels_;
  bool has_setup_ = false, is_simulated_ = false;
  std::optional<DeviceView> setup_;
  std::optional<std::vector<std::string>> sample_ids_;
};

}  // namespace gonio::conformance
