#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/app/device_report.hpp"
#include "emulator/core/csv_cell.hpp"

// A device for programs: JSON and CSV.

namespace gonio::app {

namespace {

using nlohmann::ordered_json;

/// Columns of the CSV, and keys of a channel in JSON: the points of a channel by their names.
struct Column {
  const char* key;
  const char* point;
};
constexpr std::array readings = {Column{"gloss_gu", "gloss"},
                                 Column{"state", "reading_state"},
                                 Column{"difference_gu", "difference"},
                                 Column{"verdict", "verdict"},
                                 Column{"n", "statistics_n"},
                                 Column{"mean_gu", "mean"},
                                 Column{"standard_deviation_gu", "standard_deviation"},
                                 Column{"minimum_gu", "minimum"},
                                 Column{"maximum_gu", "maximum"},
                                 Column{"is_calibrated", "is_calibrated"},
                                 Column{"tile_gu", "tile"},
                                 Column{"calibration_deviation_gu", "calibration_deviation"},
                                 Column{"zero_offset_gu", "zero_offset"},
                                 Column{"reference_gu", "reference"},
                                 Column{"lower_limit_gu", "lower_limit"},
                                 Column{"upper_limit_gu", "upper_limit"}};

/// A symbol by its name, else a number.
ordered_json value_json(const DeviceView& view, const std::string& id) {
  const Point& point = *RegisterMap::standard().find(id);
  if (point.symbols.empty()) {
    return json_number(view.number(id));
  }
  const std::string text = view.text(id);
  return text == "yes" || text == "no" ? ordered_json(text == "yes") : ordered_json(text);
}

ordered_json names_on(const DeviceView& view, const std::string& id) {
  ordered_json names = ordered_json::array();
  for (const Symbol& symbol : RegisterMap::standard().find(id)->symbols) {
    if (view.bit(id, symbol.name)) {
      names.push_back(symbol.name);
    }
  }
  return names;
}

ordered_json channel_json(const DeviceView& view, int channel) {
  ordered_json json{{"channel", channel},
                    {"angle_deg", json_number(channel_number(view, "angle", channel))}};
  for (const Column& column : readings) {
    json[column.key] = value_json(view, fmt::format("{}_{}", column.point, channel));
  }
  return json;
}

ordered_json identity_json(const DeviceView& view) {
  return {{"manufacturer", view.text("manufacturer")},
          {"model", view.text("model")},
          {"serial_number", view.text("serial_number")},
          {"firmware", fmt::format("{}.{}.{}", view.text("firmware_major"),
                                   view.text("firmware_minor"), view.text("firmware_patch"))},
          {"calibration_date", view.text("calibration_date")},
          {"map_version", value_json(view, "map_version")}};
}

}  // namespace

ordered_json json_number(double value) {
  if (!std::isfinite(value)) {
    return nullptr;
  }
  constexpr double most_exact = 9007199254740992.0;  // 2^53
  return value == std::trunc(value) && std::abs(value) < most_exact
             ? ordered_json(static_cast<std::int64_t>(value))
             : ordered_json(value);
}

std::string device_json(const DeviceReport& report) {
  const DeviceView& view = report.view;
  const auto age_s = calibration_age_s(view);
  ordered_json json{{"schema", "gonio/device/1"},
                    {"url", report.url},
                    {"identity", identity_json(view)},
                    {"state", view.text("state")},
                    {"status", names_on(view, "status")},
                    {"alarms", names_on(view, "alarms")},
                    {"mode", view.text("active_mode")},
                    {"sequence", json_number(view.number("sequence"))},
                    {"command",
                     {{"name", view.text("last_command")},
                      {"state", view.text("command_state")},
                      {"error", view.text("command_error")},
                      {"sequence", json_number(view.number("command_sequence"))}}},
                    {"calibration",
                     {{"is_due", view.bit("status", "calibration_due")},
                      {"age_s", age_s ? json_number(*age_s) : ordered_json()},
                      {"interval_s", json_number(view.number("calibration_interval"))}}},
                    {"temperature_c", json_number(view.number("temperature"))},
                    {"uptime_s", json_number(view.number("uptime"))},
                    {"channels", ordered_json::array()}};
  for (int channel = 1; channel <= channel_count(view); ++channel) {
    json["channels"].push_back(channel_json(view, channel));
  }
  if (report.simulation) {
    const DeviceView& simulation = *report.simulation;
    json["simulation"] = {{"cover", simulation.text("cover")},
                          {"sample", simulation.text("sample_id")},
                          {"faults", names_on(simulation, "faults")}};
  }
  return json.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string device_csv(const DeviceReport& report) {
  std::string text = "channel,angle_deg";
  for (const Column& column : readings) {
    text += fmt::format(",{}", column.key);
  }
  text += "\n";
  for (int channel = 1; channel <= channel_count(report.view); ++channel) {
    text += fmt::format("{},{}", channel, channel_text(report.view, "angle", channel));
    for (const Column& column : readings) {
      const std::string cell = channel_text(report.view, column.point, channel);
      text += fmt::format(",{}", csv_cell(cell == "-" || cell == "over range" ? "" : cell));
    }
    text += "\n";
  }
  return text;
}

}  // namespace gonio::app
