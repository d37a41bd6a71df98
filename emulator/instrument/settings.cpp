#include "emulator/instrument/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "emulator/core/quantity.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace {

const std::vector<std::string> mode_names{"single", "statistics", "continuous", "difference",
                                          "pass_fail"};
constexpr int most_readings = 999;
const Range interval_s = Range::closed(0.1, 3600.0);
const Range gloss_gu = Range::closed(-10'000.0, 10'000.0);
const Range tile_gu{.low = 0.0, .high = 10'000.0, .low_open = true};

std::optional<std::string> out_of_range(const DeviceSettings::ByChannel& channel) {
  if (!gloss_gu.contains(channel.reference_gu)) {
    return "reference_gu";
  }
  if (!gloss_gu.contains(channel.lower_limit_gu)) {
    return "lower_limit_gu";
  }
  if (!gloss_gu.contains(channel.upper_limit_gu) ||
      channel.upper_limit_gu < channel.lower_limit_gu) {
    return "upper_limit_gu";
  }
  if (!tile_gu.contains(channel.tile_gu)) {
    return "tile_gu";
  }
  return std::nullopt;
}

bool is_any_measured(const DeviceSettings& settings) {
  return std::any_of(settings.channels.begin(), settings.channels.end(),
                     [](const auto& channel) { return channel.is_measured; });
}

DeviceSettings::ByChannel read_channel(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    DeviceSettings::ByChannel channel{
        .reference_gu = map.required("reference").gloss_gu(gloss_gu),
        .lower_limit_gu = map.required("lower_limit").gloss_gu(gloss_gu)};
    channel.upper_limit_gu =
        map.required("upper_limit").gloss_gu(Range::closed(channel.lower_limit_gu, gloss_gu.high));
    channel.tile_gu = map.required("tile").gloss_gu(tile_gu);
    channel.is_measured = map.required("measured").boolean();
    return channel;
  });
}

MeasuringMode read_mode(const YamlNode& node) {
  const std::string name = node.choice(mode_names);
  return MeasuringMode(std::find(mode_names.begin(), mode_names.end(), name) - mode_names.begin());
}

std::string channel_text(const std::string& geometry_id, const DeviceSettings::ByChannel& channel) {
  return fmt::format(
      "  \"{}\": {{reference: {} GU, lower_limit: {} GU, upper_limit: {} GU, tile: {} GU, "
      "measured: {}}}\n",
      geometry_id, channel.reference_gu, channel.lower_limit_gu, channel.upper_limit_gu,
      channel.tile_gu, channel.is_measured);
}

}  // namespace

std::optional<std::string> out_of_range(const DeviceSettings& settings, std::size_t channel_count) {
  if (std::size_t(settings.mode) >= mode_names.size()) {
    return "mode";
  }
  if (settings.statistics_readings < 1 || settings.statistics_readings > most_readings) {
    return "statistics_readings";
  }
  if (!interval_s.contains(settings.interval_s)) {
    return "interval_s";
  }
  if (settings.channels.size() != channel_count) {
    return "channels";
  }
  for (std::size_t i = 0; i < channel_count; ++i) {
    if (const auto wrong = out_of_range(settings.channels[i])) {
      return fmt::format("channels[{}].{}", i, *wrong);
    }
  }
  if (!is_any_measured(settings)) {
    return "channels[0].is_measured";
  }
  return std::nullopt;
}

DeviceSettings load_settings(const std::filesystem::path& path,
                             const std::vector<std::string>& geometry_ids) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/settings/1");
    DeviceSettings settings{
        .mode = read_mode(map.required("mode")),
        .statistics_readings = map.required("statistics_readings").integer(1, most_readings),
        .interval_s = map.required("interval").time_s(interval_s),
        .has_reference = map.required("has_reference").boolean()};
    const YamlNode channels = map.required("channels");
    channels.read_map([&](YamlMap& by_geometry) {
      for (const std::string& id : geometry_ids) {
        settings.channels.push_back(read_channel(by_geometry.required(id)));
      }
      return true;
    });
    if (!is_any_measured(settings)) {
      channels.fail("a channel that is measured", "none");
    }
    return settings;
  });
}

void save_settings(const std::filesystem::path& path, const DeviceSettings& settings,
                   const std::vector<std::string>& geometry_ids) {
  if (const auto wrong = out_of_range(settings, geometry_ids.size())) {
    throw std::invalid_argument(fmt::format("save_settings: {} is out of its range", *wrong));
  }
  std::string text = fmt::format(
      "schema: gonio/settings/1\n"
      "mode: {}\nstatistics_readings: {}\ninterval: {} s\nhas_reference: {}\nchannels:\n",
      mode_names[std::size_t(settings.mode)], settings.statistics_readings, settings.interval_s,
      settings.has_reference);
  for (std::size_t i = 0; i < geometry_ids.size(); ++i) {
    text += channel_text(geometry_ids[i], settings.channels[i]);
  }
  write_text_file(path, text);
}

}  // namespace gonio
