#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/instrument/behaviour.hpp"
#include "emulator/instrument/device_time.hpp"
#include "emulator/instrument/measuring_head.hpp"
#include "emulator/instrument/settings.hpp"
#include "emulator/statistics/running_statistics.hpp"

namespace gonio {

enum class DeviceState {
  warm_up,
  idle,
  calibrating,  ///< or finding its zero
  measuring,
  fault  ///< the lamp has failed
};

/// What a user asks of the instrument.
enum class DeviceCommand {
  none,
  measure,
  calibrate,  ///< gain on the tile, for all channels
  zero,       ///< on the black trap
  stop,
  acknowledge_alarms,
  store_reference,  ///< the last readings become the reference of mode `difference`
  clear_statistics,
  save_settings,
  restore_settings,  ///< what was saved last
  factory_settings,
  restart  ///< as after power on
};

/// Why the instrument says no.
enum class DeviceError {
  none,
  busy,
  warming_up,
  not_calibrated,
  not_on_tile,
  not_on_trap,
  tile_out_of_tolerance,
  lamp_failure,
  no_reading,  ///< nothing to store as a reference
  no_reference,
  zero_out_of_tolerance,
  storage_failed,
  unknown_command
};

enum class CommandState { idle, running, done, failed };

/// What became of the last command that was accepted.
struct CommandOutcome {
  DeviceCommand command = DeviceCommand::none;
  CommandState state = CommandState::idle;
  DeviceError error = DeviceError::none;
  std::uint16_t sequence = 0;  ///< counts accepted commands, wraps
};

/// What latches until it is acknowledged; bit numbers of the alarm word.
enum class Alarm {
  restarted,
  lamp_failure,
  tile_refused,
  zero_refused,
  over_range,
  calibration_overdue,
  storage_failed
};

enum class Verdict { none, pass, below, above };

/// One geometry of the instrument, and what it showed last.
struct ChannelStatus {
  ChannelValue reading = {};  ///< the last one
  /// Of the valid readings since clear_statistics; a measurement in the modes `statistics` and
  /// `continuous` begins anew.
  ChannelStatistics statistics = {};
  ChannelValue difference = {};     ///< to the reference, in mode `difference`
  Verdict verdict = Verdict::none;  ///< in mode `pass_fail`; over range is above
  bool is_calibrated = false;
  /// Of the tile read by the factory's calibration from its assigned value, at the last
  /// calibration, accepted or refused.
  double calibration_deviation_gu = 0.0;
  double zero_offset_gu = 0.0;  ///< found by the last zero, accepted or refused
};

/// A glossmeter as a state machine. It knows no clock and no wire: time is what advance() is told.
/// Everything random comes from the seed, so that the same calls give the same readings.
///
/// Several angles are channels, in the order of the instrument's standard, which is the steepest
/// first. A measurement reads all channels that are set to be measured at once. What runs keeps the
/// settings it began with, and sees what lies on the port when a reading ends.
class Device {
 public:
  /// Everything visible, of one moment.
  struct Status {
    DeviceState state = DeviceState::warm_up;
    PortCover cover = PortCover::nothing;
    int sample = 0;  ///< index of the sample on the port, if one is
    std::vector<ChannelStatus> channels = {};
    std::uint32_t alarms = 0;    ///< bits by Alarm
    std::uint32_t sequence = 0;  ///< counts readings
    CommandOutcome command = {};
    bool is_calibration_due = true;  ///< never done, or longer ago than the interval
    bool is_reference_set = false;
    int readings_left = 0;     ///< of the measurement that runs; 0 in mode `continuous`
    std::uint32_t faults = 0;  ///< bits by InstrumentFault: those that are on
  };

  /// Keeps settings over power off. @throws anything if it cannot; the old ones are then kept.
  using SettingsStore = std::function<void(const DeviceSettings&)>;

  /// Switches it on, with nothing on the port and the alarm `restarted`.
  /// @throws std::invalid_argument  if it has no channel, an array is not of shape (n_channels),
  ///                                or the magnitude of a fault is out of its range.
  Device(Identity identity, Behaviour behaviour, std::vector<Channel> channels,
         std::vector<DeviceSample> samples);

  /// Where `save_settings` keeps them; without one it fails with storage_failed.
  /// @param saved  what was kept before, which is in force from now on; nothing if there is none.
  /// @throws std::invalid_argument  if `saved` is out of its range.
  void keep_settings(SettingsStore store, const std::optional<DeviceSettings>& saved);

  /// Lets time pass: the same in one step as in many. A day is as quick as a second, but for the
  /// readings of mode `continuous`.
  /// @param seconds  >= 0, resolved to nanoseconds.
  /// @throws std::domain_error  if it is negative or NaN, or uptime passes 100 years.
  void advance(double seconds);

  /// `restart` is as power off and on: volatile settings, calibration and readings are lost; what
  /// lies on the port, what is broken and the count of commands stay.
  /// @return  false if the instrument is busy: nothing has changed then. Otherwise status().command
  ///          tells what becomes of it; a command that is refused for another reason has failed at
  ///          once. `stop` and `acknowledge_alarms` are always accepted.
  [[nodiscard]] bool command(DeviceCommand command);

  /// Lays something on the port. @throws std::out_of_range  for a sample that there is not.
  void place(PortCover cover, int sample = 0);

  /// Puts settings in force, all or none.
  /// @return  nothing, or which value is out of its range, e.g. "statistics_readings".
  [[nodiscard]] std::optional<std::string> set(const DeviceSettings& settings);

  /// @param magnitude  relative: gain of the signal in [-1, 10] for drift_step, loss in [0, 1] for
  ///                   tile_dirty; the others take none.
  /// @return  false if it is out of its range: nothing has changed then.
  bool set_fault(InstrumentFault fault, bool on, double magnitude = 0.0);

  [[nodiscard]] const Status& status() const { return status_; }
  /// Grows with every change of status, settings or samples: a view that was made for a revision
  /// holds as long as it stands.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  [[nodiscard]] const DeviceSettings& settings() const { return settings_; }
  /// As they leave the factory: the tile reads what its certificate says.
  [[nodiscard]] DeviceSettings factory_settings() const;
  [[nodiscard]] const Identity& identity() const { return identity_; }
  [[nodiscard]] const Behaviour& behaviour() const { return head_.behaviour(); }
  [[nodiscard]] const std::vector<Channel>& channels() const { return head_.channels(); }
  [[nodiscard]] const std::vector<DeviceSample>& samples() const { return head_.samples(); }
  [[nodiscard]] double uptime_s() const;  ///< since power on or restart
  [[nodiscard]] double temperature_c() const;
  [[nodiscard]] double since_calibration_s() const;  ///< infinity before the first

 private:
  /// A measurement, a calibration or a zero that runs.
  struct Activity {
    DeviceCommand command = DeviceCommand::none;
    std::uint16_t sequence = 0;        ///< of the command
    DeviceTime begin = {}, next = {};  ///< next: when it has its next reading, or ends
    DeviceSettings settings = {};      ///< as they were when it began
  };

  void power_on();
  void run_until(DeviceTime end);
  [[nodiscard]] DeviceTime next_event() const;
  void happen();
  void changed();
  [[nodiscard]] DeviceState present_state() const;

  [[nodiscard]] DeviceError refusal(DeviceCommand command) const;
  [[nodiscard]] DeviceError carry_out(DeviceCommand command);
  [[nodiscard]] DeviceError save_settings();
  [[nodiscard]] DeviceError store_reference();
  void begin(DeviceCommand command);
  void proceed();
  void end_activity(DeviceError error);
  void conclude(CommandState state, DeviceError error = DeviceError::none);

  void take_reading();
  [[nodiscard]] DeviceError finish_calibration();
  [[nodiscard]] DeviceError finish_zero();
  void clear_statistics();
  void raise(Alarm alarm) { status_.alarms |= 1U << unsigned(alarm); }

  Identity identity_;
  MeasuringHead head_;
  DeviceSettings settings_;
  SettingsStore store_;
  std::optional<DeviceSettings> saved_;
  Status status_;
  std::uint64_t revision_ = 0;

  DeviceTime uptime_ = {};
  std::size_t next_fault_ = 0;  // of behaviour().faults, which the head keeps in order of time
  std::optional<Activity> activity_;
  std::optional<DeviceTime> calibrated_at_;
  bool is_overdue_ = false;
  std::vector<RunningStatistics> statistics_;
};

}  // namespace gonio
