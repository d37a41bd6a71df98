#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/quantity.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// What an instrument says of itself. Printable ASCII.
struct Identity {
  std::string manufacturer = "gonio";
  std::string model = "virtual glossmeter";
  std::string serial_number = "0";
  std::string url = {};
  std::string calibration_date = {};  ///< of the factory, YYYY-MM-DD
  std::string calibration_text = {};
};

/// What can break in an instrument, by itself or on demand.
enum class InstrumentFault { lamp_failure, over_range, frozen_reading, drift_step, tile_dirty };
constexpr std::size_t instrument_fault_count = 5;

/// As input files and people call them, in the order of InstrumentFault.
inline constexpr std::array<const char*, instrument_fault_count> instrument_fault_names{
    "lamp_failure", "over_range", "frozen_reading", "drift_step", "tile_dirty"};
[[nodiscard]] std::optional<InstrumentFault> instrument_fault(const std::string& name);

/// What the magnitude of a fault may be; nothing for a fault that has none.
[[nodiscard]] std::optional<Range> magnitude_range(InstrumentFault fault);

/// A fault that begins after some time.
struct TimedFault {
  InstrumentFault fault = InstrumentFault::lamp_failure;
  double after_s = 0.0;    ///< since power on
  double magnitude = 0.0;  ///< relative, for drift_step and tile_dirty

  bool operator==(const TimedFault&) const = default;
};

/// How an instrument departs from what its optics read. Everything that is 0 is ideal.
///
/// The signal of a channel whose optics read g, in gloss units of the factory's calibration, is
///
///   signal = lamp(t) * (1 + signal_per_k * (T(t) - 23)) * (g + e(g) + stray_light) + noise
///   lamp(t) = (1 - warm_up_loss * exp(-5 t / warm_up_s))
///             * (1 - drift_limit * (1 - exp(-drift_per_h * t / drift_limit)))
///   T(t) = ambient + self_heating * (1 - exp(-t / 600 s))
///   e(g) = 4 * linearity * g * (1 - g / full_scale)
///
/// with t since power on; the instrument shows gain * (signal - zero), rounded to its resolution.
struct Behaviour {
  double warm_up_s = 30.0;      ///< refuses to measure for so long after power on
  double warm_up_loss = 0.0;    ///< of light at power on, relative
  double reading_s = 0.5;       ///< one reading of all channels takes this long
  double calibration_s = 3.0;   ///< so does a calibration, or a zero
  double repeatability_gu = 0;  ///< standard deviation of the noise
  double resolution_gu = 0.0;   ///< step of what it shows; 0: none
  double linearity = 0.0;       ///< largest error of linearity, relative to full scale
  double stray_light_gu = 0.0;
  double ambient_light_gu = 0.0;  ///< more stray light while nothing covers the port
  double drift_per_h = 0.0;       ///< loss of light per hour at the beginning, relative
  double drift_limit = 0.0;       ///< what that loss tends to, relative, > 0 if there is a drift
  double ambient_c = 23.0;        ///< degrees Celsius
  double self_heating_k = 0.0;
  double signal_per_k = 0.0;        ///< relative change of the signal
  double tile_contamination = 0.0;  ///< share of its gloss that the tile has lost
  double tile_limit_gu = 1.0;       ///< largest deviation of the tile from the factory's value
  double calibration_interval_s = 8 * 3600.0;  ///< after that a calibration is due
  bool calibration_required = true;            ///< refuses to measure before the first calibration
  std::vector<double> full_scale_gu = {};      ///< by channel; over range beyond; empty: none
  double tile_index = 1.567;                   ///< refractive index of the calibration tile
  std::uint64_t seed = 1;
  std::vector<TimedFault> faults = {};

  /// The same instrument without noise, drift, warm-up, resolution, full scale and faults, which
  /// reads what its optics read, and measures at once, calibrated or not.
  [[nodiscard]] Behaviour ideal() const;

  bool operator==(const Behaviour&) const = default;
};

/// A value as a display of that resolution shows it: the decimal fraction that is nearest.
/// @param resolution  step of the display, >= 0; 0: none.
[[nodiscard]] double displayed(double value, double resolution);

/// Reads the map `identity` of an instrument file. What is not stated keeps its default.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Identity read_identity(const YamlNode& node);

/// Reads one of `behaviour.faults`, e.g. {fault: tile_dirty, after: 10 min, magnitude: 0.02}.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] TimedFault read_timed_fault(const YamlNode& node);

/// Reads the map `behaviour` of an instrument file.
/// @param geometry_ids  of the instrument, in the order of its channels.
/// @param behaviour     what is not stated stays as it is there; a list of faults that is stated
///                      replaces the other.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Behaviour read_behaviour(const YamlNode& node,
                                       const std::vector<std::string>& geometry_ids,
                                       Behaviour behaviour = {});

}  // namespace gonio
