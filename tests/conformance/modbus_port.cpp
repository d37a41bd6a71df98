#include "tests/conformance/modbus_port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "emulator/protocol/device_dialogue.hpp"
#include "emulator/protocol/point_text.hpp"
#include "tests/conformance/passing_time.hpp"

namespace gonio::conformance {

namespace {

constexpr int version_with_setup = 2;  // of the register map

std::string of_channel(const std::string& id, std::size_t channel) {
  return fmt::format("{}_{}", id, channel + 1);
}

/// @throws DeviceLost  for a number that the register map does not know.
template <class Enum>
Enum symbol_of(const DeviceView& view, const std::string& id) {
  const double number = view.number(id);
  if (find_symbol(known_point(id), number) == nullptr) {
    throw DeviceLost(
        fmt::format("{}: expected a number of the register map, found {}", id, number));
  }
  return static_cast<Enum>(int(number));
}

/// 0 for what there is none of.
double number_or_0(const DeviceView& view, const std::string& id) {
  const double number = view.number(id);
  return std::isnan(number) ? 0.0 : number;
}

ChannelValue reading_of(const DeviceView& view, std::size_t channel) {
  ChannelValue reading{.status =
                           symbol_of<ReadingStatus>(view, of_channel("reading_state", channel))};
  if (reading.status == ReadingStatus::valid) {
    reading.gloss_gu = view.number(of_channel("gloss", channel));
  }
  return reading;
}

ChannelStatistics statistics_of(const DeviceView& view, std::size_t channel) {
  const auto number = [&](const char* id) { return number_or_0(view, of_channel(id, channel)); };
  return {.n = int(number("statistics_n")),
          .mean = number("mean"),
          .standard_deviation = number("standard_deviation"),
          .minimum = number("minimum"),
          .maximum = number("maximum")};
}

/// A connection alone does not show that someone is there. @throws std::system_error
void expect_answer(ModbusClient& client) {
  try {
    (void)DeviceView(client, {&known_point("state")});
  } catch (const ModbusExceptionError&) {
    return;  // busy
  }
}

std::string in_words(PortCover cover, const std::string& sample) {
  switch (cover) {
    case PortCover::nothing:
      return "nothing";
    case PortCover::tile:
      return "the calibration tile";
    case PortCover::black_trap:
      return "the black trap";
    case PortCover::sample:
      break;
  }
  return fmt::format("the sample '{}'", sample);
}

}  // namespace

ModbusPort::ModbusPort(const std::string& url, Options options)
    : url_(DeviceUrl::parse(url)), options_(std::move(options)) {
  try {
    client_.emplace(url_, options_.timeout);
  } catch (const std::system_error& error) {
    lose(error.what());
  }
  const DeviceView view = read_blocks({"identity", "status", "channels", "settings"});
  identity_ = {.manufacturer = view.text("manufacturer"),
               .model = view.text("model"),
               .serial_number = view.text("serial_number"),
               .calibration_date = view.text("calibration_date")};
  has_setup_ = view.number("map_version") >= version_with_setup;
  is_simulated_ = view.bit("status", "simulated");
  read_channels(view);
}

void ModbusPort::read_channels(const DeviceView& view) {
  const double count = view.number("channel_count");
  if (count < 1 || !RegisterMap::standard().find(fmt::format("angle_{}", count))) {
    throw DeviceLost(
        fmt::format("{}: expected a device with 1 to 3 channels, found {}", url_.text(), count));
  }
  for (std::size_t i = 0; i < std::size_t(count); ++i) {
    const double full_scale = view.number(of_channel("full_scale", i));
    channels_.push_back({.theta_i = degrees(view.number(of_channel("angle", i))),
                         .full_scale_gu = std::isfinite(full_scale)
                                              ? std::optional<double>(full_scale)
                                              : std::nullopt,
                         .tile_assigned_gu = view.number(of_channel("tile", i))});
  }
}

// Asking.

template <class Talk>
auto ModbusPort::ask_device(const std::string& what, Talk&& talk) {
  ModbusClient& device = client();
  try {
    return retry_while_busy(busy_patience, [&] { return talk(device); });
  } catch (const std::system_error& error) {
    lose(fmt::format("{}: {}", what, error.what()));
  } catch (const DeviceRefusal& error) {
    throw DeviceLost(fmt::format("{}: {}", what, error.what()));
  }
}

ModbusClient& ModbusPort::client() {
  if (!client_) {
    search();
  }
  return *client_;
}

void ModbusPort::search() {
  if (searched_ >= options_.search_budget) {
    throw DeviceLost(fmt::format("lost before: {}", loss_));
  }
  const Clock::time_point begin = Clock::now();
  try {
    ModbusClient found(url_, std::min(options_.short_timeout, options_.timeout));
    expect_answer(found);
    client_.emplace(url_, options_.timeout);
  } catch (const std::system_error&) {
    searched_ += Clock::now() - begin;
    throw DeviceLost(fmt::format("lost before: {}", loss_));
  }
}

void ModbusPort::lose(const std::string& why) {
  client_.reset();
  sample_ids_.reset();
  loss_ = why;
  throw DeviceLost(why);
}

DeviceView ModbusPort::read_blocks(const std::vector<std::string>& blocks) {
  return ask_device("read its registers", [&](ModbusClient& client) {
    return DeviceView(client, points_of_blocks(blocks));
  });
}

PortStatus ModbusPort::status() {
  const DeviceView view = read_blocks({"status", "readings", "statistics"});
  PortStatus status{.state = symbol_of<DeviceState>(view, "state"),
                    .is_calibration_due = view.bit("status", "calibration_due")};
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    status.readings.push_back(reading_of(view, i));
    status.statistics.push_back(statistics_of(view, i));
  }
  return status;
}

std::optional<StatedAngle> ModbusPort::setup(std::size_t channel, SetupQuantity quantity) {
  if (!has_setup_ || channel >= channels_.size()) {
    return std::nullopt;
  }
  if (!setup_) {
    setup_ = read_blocks({"setup"});
  }
  const std::string name = setup_quantity_names.at(static_cast<std::size_t>(quantity));
  const double value_deg = setup_->number(of_channel(name, channel));
  if (!std::isfinite(value_deg)) {
    return std::nullopt;
  }
  return StatedAngle{.value = degrees(value_deg),
                     .expanded_uncertainty =
                         degrees(number_or_0(*setup_, of_channel(name + "_uncertainty", channel)))};
}

// Doing.

DeviceError ModbusPort::command(DeviceCommand command) {
  const Symbol* name = find_symbol(known_point("command"), double(command));
  if (name == nullptr || command == DeviceCommand::none) {
    return DeviceError::unknown_command;
  }
  const auto deadline = Clock::now() + options_.command_limit;
  const auto run = [&](ModbusClient& client) -> std::optional<DeviceView> {
    try {
      return GivenCommand(client, name->name, busy_patience).outcome(deadline);
    } catch (const ModbusExceptionError& error) {
      if (error.code() == modbus::Exception::server_device_busy) {
        return std::nullopt;
      }
      throw;
    }
  };
  const auto view = ask_device(fmt::format("command {}", name->name), run);
  if (!view && Clock::now() < deadline) {
    return DeviceError::busy;
  }
  if (!view) {
    throw DeviceLost(fmt::format("{}: command {}: expected an end within {} s, found it running",
                                 url_.text(), name->name,
                                 std::chrono::duration<double>(options_.command_limit).count()));
  }
  return symbol_of<DeviceError>(*view, "command_error");
}

void ModbusPort::place(PortCover cover, const std::string& sample) {
  const std::string what = in_words(cover, sample);
  if (!is_simulated_) {
    if (!options_.ask) {
      throw NotOffered(fmt::format("nobody lays {} on the port of {}", what, url_.text()));
    }
    if (!options_.ask(fmt::format("Lay {} on the measuring port of {} {}, serial number {}.", what,
                                  identity_.manufacturer, identity_.model,
                                  identity_.serial_number))) {
      throw NotOffered(fmt::format("nobody laid {} on the port", what));
    }
    return;
  }
  std::vector<std::uint16_t> values{static_cast<std::uint16_t>(cover)};
  if (cover == PortCover::sample) {
    values.push_back(static_cast<std::uint16_t>(find_sample(sample)));
  }
  ask_device(fmt::format("lay {} on the port", what), [&](ModbusClient& client) {
    client.write_registers(known_point("cover").address, values);
  });
}

int ModbusPort::find_sample(const std::string& id) {
  if (!sample_ids_) {
    read_sample_ids();
  }
  // What a register block can hold of a longer id is all that the device can show of it.
  const std::size_t longest = 2 * std::size_t(known_point("sample_id").registers);
  const auto found = std::ranges::find(*sample_ids_, id.substr(0, longest));
  if (found == sample_ids_->end()) {
    throw NotOffered(fmt::format("{} has no sample '{}'", url_.text(), id));
  }
  return int(found - sample_ids_->begin());
}

/// The device shows the id of one sample at a time: of that whose number was written last.
void ModbusPort::read_sample_ids() {
  const DeviceView before = read_blocks({"simulation"});
  const auto choose = [&](double number) {
    ask_device("choose a sample", [&](ModbusClient& client) {
      client.write_registers(known_point("sample").address, {static_cast<std::uint16_t>(number)});
    });
  };
  std::vector<std::string> ids;
  for (int i = 0; i < int(before.number("sample_count")); ++i) {
    choose(i);
    ids.push_back(read_blocks({"simulation"}).text("sample_id"));
  }
  if (!ids.empty()) {
    choose(before.number("sample"));
  }
  sample_ids_ = std::move(ids);
}

double ModbusPort::uptime_s() {
  return ask_device("read its uptime", [](ModbusClient& client) {
    return DeviceView(client, {&known_point("uptime")}).number("uptime");
  });
}

void ModbusPort::pass(double seconds) {
  if (seconds <= 0.0) {
    return;
  }
  PassingTime time(seconds, uptime_s());
  const Clock::time_point begin = Clock::now();
  while (!time.is_over()) {
    pause_between_questions();
    const double uptime = uptime_s();
    const std::chrono::duration<double> waited = Clock::now() - begin;
    time.observe(waited.count(), uptime);
    if (time.least_total_s() > std::chrono::duration<double>(options_.patience).count()) {
      throw NotOffered(time.too_long_text());
    }
  }
}

}  // namespace gonio::conformance
