#include "emulator/app/device_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace gonio::app {

namespace {

/// As the end of a sentence, without its capital.
std::string lower_first(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') {
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  }
  return text;
}

/// The two largest units of a time: "2 h 5 min".
std::string time_text(double seconds) {
  const auto s = static_cast<long long>(seconds);
  constexpr long long minute = 60, hour = 60 * minute, day = 24 * hour;
  if (s >= day) {
    return fmt::format("{} d {} h", s / day, s % day / hour);
  }
  if (s >= hour) {
    return fmt::format("{} h {} min", s / hour, s % hour / minute);
  }
  return s >= minute ? fmt::format("{} min", s / minute) : fmt::format("{} s", s);
}

bool is_due(const DeviceView& view) { return view.bit("status", "calibration_due"); }

std::string calibration_text(const DeviceView& view) {
  const auto age_s = calibration_age_s(view);
  const double interval_s = view.number("calibration_interval");
  if (!age_s) {
    return is_due(view) ? "due: never calibrated" : "never calibrated";
  }
  return is_due(view) ? fmt::format("due: the last one was {} ago", time_text(*age_s))
                      : fmt::format("{} ago, due in {}", time_text(*age_s),
                                    time_text(std::max(0.0, interval_s - *age_s)));
}

std::string command_text(const DeviceView& view) {
  const std::string state = view.text("command_state");
  if (state == "idle") {
    return "none";
  }
  const std::string text = fmt::format("{}: {}", view.text("last_command"), state);
  return state == "failed" ? text + ", " + lower_first(view.meaning("command_error")) : text;
}

std::string alarms_text(const DeviceView& view) {
  std::vector<std::string> alarms;
  for (const std::string& alarm : view.meanings("alarms")) {
    alarms.push_back(alarms.empty() ? alarm : lower_first(alarm));
  }
  return alarms.empty() ? "none" : fmt::format("{}", fmt::join(alarms, "; "));
}

std::string cover_text(const DeviceView& simulation) {
  return simulation.text("cover") == "sample" ? "sample " + simulation.text("sample_id")
                                              : lower_first(simulation.meaning("cover"));
}

/// The lines of names and values above the tables.
std::string head_text(const DeviceReport& report, bool styled) {
  const DeviceView& view = report.view;
  const bool has_alarm = view.number("alarms") != 0.0;
  const bool has_failed = view.text("command_state") == "failed";
  std::string text;
  const auto line = [&](const char* name, const std::string& value, int colour = colour::none) {
    text += fmt::format("{:<13} {}\n", name, painted(value, colour, styled));
  };
  line("State", fmt::format("{}: {}", view.text("state"), lower_first(view.meaning("state"))),
       view.text("state") == "fault" ? colour::red : colour::none);
  line("Alarms", alarms_text(view), has_alarm ? colour::yellow : colour::none);
  line("Last command", command_text(view), has_failed ? colour::red : colour::none);
  line("Mode",
       fmt::format("{}: {}", view.text("active_mode"), lower_first(view.meaning("active_mode"))));
  line("Calibration", calibration_text(view), is_due(view) ? colour::yellow : colour::none);
  line("Temperature", decimals_text(view.number("temperature"), 1) + " degC");
  line("Running for", time_text(view.number("uptime")));
  if (report.simulation) {
    line("On the port", cover_text(*report.simulation));
    line("Faults on", report.simulation->text("faults"));
  }
  return text;
}

std::string calibration_table(const DeviceView& view) {
  std::string text = fmt::format("{:>8} {:>10} {:>10} {:>10} {:>11}\n", "Angle", "Tile/GU",
                                 "Found/GU", "Zero/GU", "Calibrated");
  for (int channel = 1; channel <= channel_count(view); ++channel) {
    const auto column = [&](const char* id) {
      return decimals_text(channel_number(view, id, channel), 2);
    };
    const double found = channel_number(view, "tile", channel) +
                         channel_number(view, "calibration_deviation", channel);
    text += fmt::format("{:>8} {:>10} {:>10} {:>10} {:>11}\n", column("angle"), column("tile"),
                        decimals_text(found, 2), column("zero_offset"),
                        channel_text(view, "is_calibrated", channel));
  }
  return text;
}

}  // namespace

std::string painted(const std::string& text, int colour, bool styled) {
  return styled && colour != colour::none ? fmt::format("\033[{}m{}\033[0m", colour, text) : text;
}

int channel_count(const DeviceView& view) { return static_cast<int>(view.number("channel_count")); }

std::optional<double> calibration_age_s(const DeviceView& view) {
  constexpr double never = 4294967295.0;  // all ones: there is no such time
  const double age_s = view.number("calibration_age");
  return age_s == never ? std::nullopt : std::optional(age_s);
}

double channel_number(const DeviceView& view, const char* id, int channel) {
  return view.number(fmt::format("{}_{}", id, channel));
}

std::string channel_text(const DeviceView& view, const char* id, int channel) {
  return view.text(fmt::format("{}_{}", id, channel));
}

std::string decimals_text(double value, int decimals) {
  return std::isnan(value)   ? "-"
         : std::isinf(value) ? "over range"
                             : fmt::format("{:.{}f}", value, decimals);
}

DeviceReport DeviceReport::read(ModbusClient& client) {
  DeviceView view(client, points_of_blocks({"identity", "status", "readings", "statistics",
                                            "calibration", "channels", "command", "settings"}));
  std::optional<DeviceView> simulation;
  if (view.bit("status", "simulated")) {
    simulation.emplace(client, points_of_blocks({"simulation"}));
  }
  return {client.url().text(), std::move(view), std::move(simulation)};
}

std::string readings_text(const DeviceView& view, bool styled) {
  const bool has_reference = view.text("active_mode") == "difference";
  const bool is_judged = view.text("active_mode") == "pass_fail";
  bool has_statistics = false;
  for (int channel = 1; channel <= channel_count(view); ++channel) {
    has_statistics = has_statistics || channel_number(view, "statistics_n", channel) > 0.0;
  }
  std::string text = fmt::format("{:>8} {:>10}", "Angle", "Gloss/GU");
  text += has_reference ? fmt::format(" {:>11}", "Difference") : "";
  text += is_judged ? fmt::format(" {:>8}", "Verdict") : "";
  text += has_statistics
              ? fmt::format(" {:>5} {:>10} {:>8} {:>10} {:>10}", "n", "Mean", "s", "Min", "Max")
              : "";
  text += "\n";
  for (int channel = 1; channel <= channel_count(view); ++channel) {
    const auto column = [&](const char* id, int decimals = 2) {
      return decimals_text(channel_number(view, id, channel), decimals);
    };
    const std::string verdict = channel_text(view, "verdict", channel);
    text += fmt::format("{:>8} {}", column("angle"),
                        painted(fmt::format("{:>10}", column("gloss")), colour::bold, styled));
    text += has_reference ? fmt::format(" {:>11}", column("difference")) : "";
    const int verdict_colour = verdict == "pass"   ? colour::green
                               : verdict == "none" ? colour::none
                                                   : colour::red;
    text += is_judged
                ? fmt::format(" {}", painted(fmt::format("{:>8}", verdict), verdict_colour, styled))
                : "";
    text += has_statistics
                ? fmt::format(" {:>5} {:>10} {:>8} {:>10} {:>10}", column("statistics_n", 0),
                              column("mean"), column("standard_deviation", 3), column("minimum"),
                              column("maximum"))
                : "";
    text += "\n";
  }
  return text;
}

std::string device_text(const DeviceReport& report, bool styled) {
  const DeviceView& view = report.view;
  return painted(fmt::format("{} {}", view.text("manufacturer"), view.text("model")), colour::bold,
                 styled) +
         fmt::format(", serial number {}, firmware {}.{}.{}\n{}\n\n", view.text("serial_number"),
                     view.text("firmware_major"), view.text("firmware_minor"),
                     view.text("firmware_patch"), report.url) +
         head_text(report, styled) + "\n" + readings_text(view, styled) + "\n" +
         calibration_table(view);
}

}  // namespace gonio::app
