#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <ctime>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "emulator/app/command.hpp"
#include "emulator/app/device_report.hpp"
#include "emulator/app/device_session.hpp"

namespace gonio::app {

namespace {

struct WatchArguments {
  DeviceOptions device;
  std::string interval = "1 s";
  std::optional<int> count;
  std::string format = "text";
};

/// Ctrl-C and SIGTERM end a watch between two readings, while this lives.
class Interruption {
 public:
  Interruption() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~Interruption() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// @return  whether one came within that time.
  [[nodiscard]] bool within(std::chrono::milliseconds time) const {
    const timespec timeout{.tv_sec = time.count() / 1000,
                           .tv_nsec = time.count() % 1000 * 1'000'000};
    return sigtimedwait(&signals_, nullptr, &timeout) > 0;
  }

 private:
  sigset_t signals_{}, before_{};
};

/// Lines of a terminal that are drawn over and over in the same place.
class Screen {
 public:
  Screen() { print("\033[?25l\033[?7l"); }  // no cursor, no line breaks at the margin
  ~Screen() {
    try {
      print("\033[?25h\033[?7h");
    } catch (const std::exception&) {
      // The terminal is gone; nothing is left to restore.
    }
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void draw(const std::string& text) {
    std::string out = height_ > 0 ? fmt::format("\033[{}A\r", height_) : "";
    for (const char c : text) {
      out += c == '\n' ? "\033[K\n" : std::string(1, c);
    }
    print(out);
    height_ = std::count(text.begin(), text.end(), '\n');
  }

 private:
  std::ptrdiff_t height_ = 0;
};

/// The last readings of a channel as a row of bars.
class Chart {
 public:
  void add(double value) {
    values_.push_back(value);
    if (values_.size() > most) {
      values_.pop_front();
    }
  }

  [[nodiscard]] std::string text(std::size_t width) const {
    constexpr std::array bars = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    const std::size_t shown = std::min(width, values_.size());
    const auto first = values_.end() - static_cast<std::ptrdiff_t>(shown);
    double low = INFINITY, high = -INFINITY;
    for (auto value = first; value != values_.end(); ++value) {
      low = std::isfinite(*value) ? std::min(low, *value) : low;
      high = std::isfinite(*value) ? std::max(high, *value) : high;
    }
    std::string row;
    for (auto value = first; value != values_.end(); ++value) {
      const double height = high > low ? (*value - low) / (high - low) : 0.5;
      row += std::isfinite(*value) ? bars.at(static_cast<std::size_t>(height * 7.0 + 0.5)) : " ";
    }
    return low <= high ? fmt::format("{}  {:.2f} to {:.2f}", row, low, high) : row;
  }

 private:
  static constexpr std::size_t most = 200;
  std::deque<double> values_;
};

std::string now_text() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::size_t chart_width() {
  constexpr unsigned others = 42, least = 10;  // columns of a line beside the chart
  winsize size{};
  const unsigned columns =
      ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80U;
  return std::max(columns, others + least) - others;
}

/// What is shown of each reading, in one of the formats.
class Watch {
 public:
  Watch(ModbusClient& client, std::string format)
      : client_(client),
        format_(std::move(format)),
        channels_(client, points_of_blocks({"channels"})) {
    if (format_ == "text" && isatty(STDOUT_FILENO) != 0) {
      screen_.emplace();
    }
  }

  void show() {
    const DeviceView view = retry_while_busy(busy_patience, [&] {
      return DeviceView(client_, points_of_blocks({"status", "readings"}));
    });
    charts_.resize(static_cast<std::size_t>(channel_count(view)));
    if (screen_) {
      draw(view);
    } else {
      print(format_ == "json" ? json(view) : format_ == "csv" ? csv(view) : line(view));
    }
  }

 private:
  [[nodiscard]] std::string angle(int channel) const {
    return fmt::format("{}", std::round(channel_number(channels_, "angle", channel)));
  }
  [[nodiscard]] int channels() const { return static_cast<int>(charts_.size()); }

  void draw(const DeviceView& view) {
    const bool is_new = view.number("sequence") != sequence_;
    sequence_ = view.number("sequence");
    std::string text =
        fmt::format("{}  {}  reading {}  {:.1f} degC\n", client_.url().text(), view.text("state"),
                    view.text("sequence"), view.number("temperature"));
    const auto alarms = view.meanings("alarms");
    text +=
        fmt::format("alarms: {}\n",
                    painted(alarms.empty() ? "none" : fmt::format("{}", fmt::join(alarms, "; ")),
                            alarms.empty() ? colour::none : colour::yellow, true));
    for (int channel = 1; channel <= channels(); ++channel) {
      Chart& chart = charts_[static_cast<std::size_t>(channel) - 1];
      const double gloss = channel_number(view, "gloss", channel);
      if (is_new) {
        chart.add(gloss);
      }
      text +=
          fmt::format("{:>3} deg  {} GU  {}\n", angle(channel),
                      painted(fmt::format("{:>10}", decimals_text(gloss, 2)), colour::bold, true),
                      chart.text(chart_width()));
    }
    screen_->draw(text);
  }

  [[nodiscard]] std::string line(const DeviceView& view) const {
    std::string text =
        fmt::format("{}  #{} {}", now_text(), view.text("sequence"), view.text("state"));
    for (int channel = 1; channel <= channels(); ++channel) {
      text += fmt::format("  {} deg {}", angle(channel),
                          decimals_text(channel_number(view, "gloss", channel), 2));
    }
    return text + "\n";
  }

  [[nodiscard]] std::string csv(const DeviceView& view) {
    std::string head = "time,sequence,state";
    std::string text =
        fmt::format("{},{},{}", now_text(), view.text("sequence"), view.text("state"));
    for (int channel = 1; channel <= channels(); ++channel) {
      head += fmt::format(",gloss_{0}_gu,state_{0}", angle(channel));
      const double gloss = channel_number(view, "gloss", channel);
      text += fmt::format(",{},{}", std::isfinite(gloss) ? fmt::format("{}", gloss) : "",
                          channel_text(view, "reading_state", channel));
    }
    const bool is_first = std::exchange(is_first_, false);
    return (is_first ? head + "\n" : "") + text + "\n";
  }

  [[nodiscard]] std::string json(const DeviceView& view) const {
    nlohmann::ordered_json json{{"schema", "gonio/watch/1"},
                                {"time", now_text()},
                                {"sequence", json_number(view.number("sequence"))},
                                {"state", view.text("state")},
                                {"temperature_c", json_number(view.number("temperature"))},
                                {"channels", nlohmann::ordered_json::array()}};
    for (int channel = 1; channel <= channels(); ++channel) {
      json["channels"].push_back(
          {{"angle_deg", json_number(channel_number(channels_, "angle", channel))},
           {"gloss_gu", json_number(channel_number(view, "gloss", channel))},
           {"state", channel_text(view, "reading_state", channel)}});
    }
    return json.dump() + "\n";
  }

  ModbusClient& client_;
  std::string format_;
  DeviceView channels_;
  std::optional<Screen> screen_;
  std::vector<Chart> charts_;
  double sequence_ = 0.0;  // of the newest reading in the charts; 0 while there is none
  bool is_first_ = true;
};

void run_watch(const WatchArguments& options) {
  const auto interval =
      parse_duration("--interval", options.interval, Range::closed(0.01, 86'400.0));
  const Interruption interruption;
  ModbusClient client = options.device.connect();
  Watch watch(client, options.format);
  for (int shown = 1;; ++shown) {
    watch.show();
    if (shown == options.count || interruption.within(interval)) {
      return;
    }
  }
}

}  // namespace

void add_watch_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "watch", "Follow a glossmeter on Modbus: live on a terminal, else a line each time");
  const auto options = std::make_shared<WatchArguments>();
  add_device_options(*command, options->device);
  command->add_option("--interval", options->interval, "Time between two looks at it")
      ->capture_default_str();
  command
      ->add_option("--count", options->count,
                   "Ends after so many; goes on until Ctrl-C if not given")
      ->check(CLI::Range(1, 1'000'000'000));
  add_format_option(*command, options->format);
  command->footer(
      "Example: gonio watch modbus://127.0.0.1:1502 --interval 0.5\n"
      "         gonio watch modbus://127.0.0.1:1502 --interval 100ms --format csv");
  command->callback([options] { run_watch(*options); });
}

}  // namespace gonio::app
