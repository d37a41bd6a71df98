#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gonio {

enum class MeasuringMode { single, statistics, continuous, difference, pass_fail };

/// What a user may set. Volatile until saved.
struct DeviceSettings {
  struct ByChannel {
    double reference_gu = 0.0;
    double lower_limit_gu = 0.0, upper_limit_gu = 2000.0;
    double tile_gu = 100.0;  ///< assigned value of the tile
    bool is_measured = true;

    friend bool operator==(const ByChannel&, const ByChannel&) = default;
  };
  MeasuringMode mode = MeasuringMode::single;
  int statistics_readings = 5;  ///< of one measurement in mode `statistics`, 1 to 999
  double interval_s = 1.0;      ///< between readings in mode `continuous`, 0.1 to 3600
  bool has_reference = false;
  std::vector<ByChannel> channels = {};

  friend bool operator==(const DeviceSettings&, const DeviceSettings&) = default;
};

/// The first value that is out of its range, e.g. "interval_s" or "channels[1].tile_gu"; nothing if
/// there is none. There is one entry of `channels` for each of the instrument, and at least one of
/// them is measured.
[[nodiscard]] std::optional<std::string> out_of_range(const DeviceSettings& settings,
                                                      std::size_t channel_count);

/// Reads a file of schema gonio/settings/1.
/// @param geometry_ids  of the instrument, in the order of its channels.
/// @throws InputError  for anything that is not as the schema says; nothing is half loaded.
[[nodiscard]] DeviceSettings load_settings(const std::filesystem::path& path,
                                           const std::vector<std::string>& geometry_ids);

/// Writes such a file, whole or not at all; what is read back is equal to the last bit.
/// @throws std::system_error      with the path, if that fails.
/// @throws std::invalid_argument  for settings out of their range.
void save_settings(const std::filesystem::path& path, const DeviceSettings& settings,
                   const std::vector<std::string>& geometry_ids);

}  // namespace gonio
