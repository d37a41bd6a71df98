#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/instrument/behaviour.hpp"
#include "emulator/instrument/setup.hpp"

namespace gonio {

enum class ReadingStatus { not_measured, valid, over_range };

/// A value that may be missing, or too large to tell.
struct ChannelValue {
  ReadingStatus status = ReadingStatus::not_measured;
  double gloss_gu = 0.0;  ///< 0 unless valid
};

/// What lies on the measuring port.
enum class PortCover { nothing, tile, black_trap, sample };

/// A channel as it is built.
struct Channel {
  std::string geometry_id;
  Angle theta_i;
  double tile_assigned_gu = 100.0;  ///< what the tile's certificate says
  double tile_optics_gu = 100.0;    ///< what the optics read on the clean tile
  StatedSetup setup = {};           ///< what its maker states of it
};

/// Something that can be laid on the port.
struct DeviceSample {
  std::string id, title;
  std::vector<double> gloss_gu;  ///< what the optics read, shape (n_channels)
};

/// The part of a device that measures: what lies on its port, its light, its detector, and how it
/// is calibrated. It knows no states: whoever asks may have a reading. Time is seconds since power
/// on.
class MeasuringHead {
 public:
  /// What a calibration or a zero has found.
  struct Finding {
    std::vector<double> by_channel_gu;  ///< deviations of the tile, or offsets
    bool is_accepted = false;           ///< if not, the old calibration stays
  };

  /// @throws std::invalid_argument  if there is no channel, an array is not of shape (n_channels),
  ///                                or the magnitude of a fault is out of its range.
  MeasuringHead(Behaviour behaviour, std::vector<Channel> channels,
                std::vector<DeviceSample> samples);

  /// @throws std::out_of_range  for a sample that there is not.
  void place(PortCover cover, int sample);

  /// @return  false if the magnitude is out of its range: nothing has changed then.
  bool set_fault(InstrumentFault fault, bool on, double magnitude);
  [[nodiscard]] bool is_on(InstrumentFault fault) const {
    return faults_[std::size_t(fault)].is_on;
  }

  /// A reading of all channels. Frozen, it is the last one again; the noise goes on unseen.
  [[nodiscard]] std::vector<ChannelValue> read(double t_s);

  /// Sets the gain so that the tile reads what is assigned to it. The deviation is that of its
  /// signal less the zero, which is its reading by the factory's gain of 1, from the assigned
  /// value.
  /// @param tile_gu  assigned values, shape (n_channels).
  [[nodiscard]] Finding calibrate(double begin_s, double end_s, const std::vector<double>& tile_gu);

  /// Sets the zero to the signal of what lies on the port. Refused beyond `zero_limit_gu`. The gain
  /// stays: calibrate after a zero, not before.
  [[nodiscard]] Finding zero(double begin_s, double end_s);

  /// Back to the factory's calibration, and no last reading.
  void reset();

  [[nodiscard]] const Behaviour& behaviour() const { return behaviour_; }
  [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::vector<DeviceSample>& samples() const { return samples_; }
  [[nodiscard]] PortCover cover() const { return cover_; }
  [[nodiscard]] int sample() const { return sample_; }

  /// An offset beyond that is no stray light but a trap that is not black.
  static constexpr double zero_limit_gu = 1.0;

 private:
  struct Calibration {
    double gain = 1.0;  ///< that of the factory
    double zero_gu = 0.0;
  };
  struct Fault {
    bool is_on = false;
    double magnitude = 0.0;  ///< 0 while it is off
  };

  [[nodiscard]] double gloss_on_port_gu(std::size_t channel) const;
  [[nodiscard]] double signal_gu(std::size_t channel, double t_s) const;
  [[nodiscard]] std::vector<double> mean_signals_gu(double begin_s, double end_s);
  [[nodiscard]] ChannelValue shown(std::size_t channel, double signal_gu) const;

  Behaviour behaviour_;
  std::vector<Channel> channels_;
  std::vector<DeviceSample> samples_;
  PortCover cover_ = PortCover::nothing;
  int sample_ = 0;
  std::array<Fault, instrument_fault_count> faults_ = {};
  std::vector<Calibration> calibrations_;
  std::vector<ChannelValue> last_;
  std::uint64_t light_count_ = 0;  // numbers the noise, from the first power on
};

}  // namespace gonio
