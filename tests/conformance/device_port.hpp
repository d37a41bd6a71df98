#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/instrument/device.hpp"
#include "emulator/instrument/setup.hpp"

namespace gonio::conformance {

/// The device does not offer that, or nobody is there to do it: the case is skipped, and says why.
class NotOffered : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The device no longer answers, or answers nonsense: the case is an error.
class DeviceLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The device says no where it must not: the case fails.
class DeviceRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PortChannel {
  std::string geometry_id = {};              ///< where the port knows it; a wire tells angles only
  Angle theta_i = {};                        ///< nominal
  std::optional<double> full_scale_gu = {};  ///< nothing: no limit is known
  double tile_assigned_gu = 100.0;           ///< of its calibration tile
};

/// What the device shows, of one moment.
struct PortStatus {
  DeviceState state = DeviceState::warm_up;
  bool is_calibration_due = false;
  std::vector<ChannelValue> readings = {};         ///< the last ones, shape (n_channels)
  std::vector<ChannelStatistics> statistics = {};  ///< since clear_statistics
};

/// A device under test: the emulator in process, or whatever speaks the register map.
class DevicePort {
 public:
  virtual ~DevicePort() = default;

  /// Maker, model and serial number.
  [[nodiscard]] virtual const Identity& identity() const = 0;
  /// Where it was found: an instrument file, a URL.
  [[nodiscard]] virtual std::string where() const = 0;
  [[nodiscard]] virtual const std::vector<PortChannel>& channels() const = 0;
  /// As it is stated by the device or its maker; nothing if it does not say.
  [[nodiscard]] virtual std::optional<StatedAngle> setup(std::size_t channel,
                                                         SetupQuantity quantity) = 0;

  /// Lays something on the measuring port. @param sample  id, for PortCover::sample.
  /// @throws NotOffered  if there is no such sample, or nobody to lay it there.
  virtual void place(PortCover cover, const std::string& sample = {}) = 0;
  /// Runs a command to its end. @return  why it was refused or failed; none if it is done.
  [[nodiscard]] virtual DeviceError command(DeviceCommand command) = 0;
  [[nodiscard]] virtual PortStatus status() = 0;
  /// Lets the device's own time pass. @throws NotOffered  if that takes longer than one waits.
  virtual void pass(double seconds) = 0;
};

}  // namespace gonio::conformance
