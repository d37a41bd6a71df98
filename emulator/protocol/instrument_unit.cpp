#include "emulator/protocol/instrument_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "emulator/core/quantity.hpp"
#include "emulator/protocol/register_codec.hpp"

namespace gonio {

using modbus::Exception;
using modbus::Table;

namespace {

// What function code 43/14 can carry in one object.
constexpr std::size_t longest_object = 244;

std::array<int, 3> parse_version(const std::string& text) {
  std::array<int, 3> version{};
  std::size_t part = 0;
  for (const char c : text) {
    if (c == '.') {
      ++part;
    }
    if (part < version.size() && c >= '0' && c <= '9') {
      version[part] = std::min(10 * version[part] + (c - '0'), 65535);
    }
  }
  return version;
}

modbus::Identification identify(const Identity& identity, const std::string& firmware,
                                const RegisterMap& map) {
  modbus::Identification result;
  result.objects = {{0x00, identity.manufacturer},
                    {0x01, identity.model},
                    {0x02, firmware},
                    {0x03, identity.url},
                    {0x04, "Glossmeter"},
                    {0x05, identity.model},
                    {0x06, fmt::format("Register map {}", map.version)},
                    {0x80, identity.serial_number},
                    {0x81, identity.calibration_date},
                    {0x82, identity.calibration_text},
                    {0x83, "Word order ABCD: high word first, high byte first"}};
  for (auto& [number, text] : result.objects) {
    text = text.substr(0, longest_object);
  }
  return result;
}

bool is_symbol(const Point& point, double number) {
  if (point.symbols.empty()) {
    return true;
  }
  if (point.is_bit_field) {
    auto rest = static_cast<std::uint32_t>(number);
    for (const Symbol& bit : point.symbols) {
      rest &= ~(1U << static_cast<unsigned>(bit.value));
    }
    return rest == 0;
  }
  return std::ranges::any_of(point.symbols,
                             [&](const Symbol& symbol) { return symbol.value == number; });
}

}  // namespace

InstrumentUnit::InstrumentUnit(Device& device, FaultPlan& faults, const Counters& counters,
                               Options options)
    : device_(device),
      faults_(faults),
      counters_(counters),
      options_(std::move(options)),
      firmware_version_(parse_version(options_.firmware_version)),
      identification_(
          identify(device.identity(), options_.firmware_version, RegisterMap::standard())),
      image_(RegisterMap::standard(), options_.has_simulation_registers) {
  for (std::size_t slot = 0; slot < image_.slots().size(); ++slot) {
    const Point& point = *image_.slots()[slot].point;
    bindings_.push_back(bind(point));
    if (point.constant) {
      encode(slot);
    } else {
      const InstrumentValue* value = bindings_.back().value;
      (value != nullptr && value->is_counter ? counting_ : changing_).push_back(slot);
    }
  }
}

InstrumentUnit::Binding InstrumentUnit::bind(const Point& point) {
  Binding binding;
  if (point.constant) {
    return binding;
  }
  if (point.is_writable) {
    binding.setter = &instrument_setters().at(point.value);
  }
  if (point.value == "bits") {
    for (const Symbol& symbol : point.symbols) {
      binding.bits.emplace_back(symbol.value, &instrument_values().at(symbol.name));
    }
  } else {
    binding.value = &instrument_values().at(point.value);
  }
  return binding;
}

InstrumentView InstrumentUnit::view() const {
  return {.device = device_,
          .state = state_,
          .counters = counters_,
          .faults = faults_,
          .is_simulated = options_.has_simulation_registers,
          .map_version = RegisterMap::standard().version,
          .firmware_version = firmware_version_};
}

// Reading.

Table InstrumentUnit::home(Table table, std::uint16_t address, std::size_t count) const {
  return table == Table::holding_registers && image_.find(table, address, count).empty()
             ? Table::input_registers
             : table;
}

Exception InstrumentUnit::check(Table table, std::uint16_t address, std::size_t count) const {
  return image_.find(home(table, address, count), address, count).empty()
             ? Exception::illegal_data_address
             : Exception::none;
}

void InstrumentUnit::read_registers(Table table, std::uint16_t address,
                                    std::span<std::uint16_t> out) {
  std::ranges::copy(read(table, address, out.size()), out.begin());
}

void InstrumentUnit::read_bits(Table table, std::uint16_t address, std::span<std::uint8_t> out) {
  std::ranges::transform(read(table, address, out.size()), out.begin(),
                         [](std::uint16_t bit) { return static_cast<std::uint8_t>(bit); });
}

std::span<const std::uint16_t> InstrumentUnit::read(Table table, std::uint16_t address,
                                                    std::size_t count) {
  refresh();
  const Table where = home(table, address, count);
  for (const std::size_t slot : counting_) {
    const Point& point = *image_.slots()[slot].point;
    if (point.table == where && point.address < address + count &&
        address <= point.last_address()) {
      encode(slot);
    }
  }
  return image_.find(where, address, count);
}

void InstrumentUnit::refresh() {
  const double second = std::floor(device_.uptime_s());
  if (device_.revision() == encoded_revision_ && second == encoded_second_) {
    return;
  }
  for (const std::size_t slot : changing_) {
    encode(slot);
  }
  encoded_revision_ = device_.revision();
  encoded_second_ = second;
}

void InstrumentUnit::encode(std::size_t slot) {
  const Point& point = *image_.slots()[slot].point;
  const std::span<std::uint16_t> words = image_.words(image_.slots()[slot]);
  if (point.type == PointType::text) {
    encode_text(point.constant ? *point.constant : bindings_[slot].value->text(view()), words);
  } else {
    encode_number(point, number(slot), words);
  }
}

double InstrumentUnit::number(std::size_t slot) const {
  const Point& point = *image_.slots()[slot].point;
  const Binding& binding = bindings_[slot];
  if (point.constant) {
    return parse_quantity(*point.constant, Dimension::number).value();
  }
  const auto channel = static_cast<std::size_t>(point.channel.value_or(0));
  if (channel >= device_.channels().size()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (binding.value != nullptr) {
    return binding.value->number(view(), channel);
  }
  std::uint32_t bits = 0;
  for (const auto& [bit, value] : binding.bits) {
    bits |= value->number(view(), 0) == 1.0 ? 1U << static_cast<unsigned>(bit) : 0U;
  }
  return bits;
}

// Writing.

Exception InstrumentUnit::write_registers(std::uint16_t address,
                                          std::span<const std::uint16_t> values) {
  return write(Table::holding_registers, address, values);
}

Exception InstrumentUnit::write_coils(std::uint16_t address, std::span<const std::uint8_t> bits) {
  const std::vector<std::uint16_t> words(bits.begin(), bits.end());
  return write(Table::coils, address, words);
}

Exception InstrumentUnit::write(Table table, std::uint16_t address,
                                std::span<const std::uint16_t> values) {
  if (image_.find(table, address, values.size()).empty()) {
    return Exception::illegal_data_address;
  }
  const auto [first, end] = image_.slots_in(table, address, values.size());
  for (std::size_t slot = first; slot < end; ++slot) {
    const Point& point = *image_.slots()[slot].point;
    if (bindings_[slot].setter == nullptr || point.address < address ||
        static_cast<std::size_t>(point.last_address()) >= address + values.size()) {
      return Exception::illegal_data_address;
    }
  }
  refresh();
  InstrumentWrite write(device_, state_);
  bool is_setting = false;
  for (std::size_t slot = first; slot < end; ++slot) {
    const Point& point = *image_.slots()[slot].point;
    is_setting = is_setting || bindings_[slot].setter->is_setting;
    const auto words = values.subspan(static_cast<std::size_t>(point.address - address),
                                      static_cast<std::size_t>(point.registers));
    if (const Exception exception = gather(slot, words, write); exception != Exception::none) {
      return exception;
    }
  }
  if (is_setting && state_.are_settings_locked) {
    return Exception::server_device_failure;
  }
  Device copy = device_;
  if (const Exception exception = write.try_on(copy, faults_); exception != Exception::none) {
    return exception;
  }
  device_ = std::move(copy);
  write.apply(state_, faults_);
  encoded_second_ = -1.0;
  return Exception::none;
}

Exception InstrumentUnit::gather(std::size_t slot, std::span<const std::uint16_t> words,
                                 InstrumentWrite& write) {
  const Point& point = *image_.slots()[slot].point;
  const double number = decode_number(point, words);
  // The second: an interval of 0.1 s that comes back as float32 is still 0.1 s.
  if (std::isnan(number) || (bindings_[slot].setter->is_setting &&
                             std::ranges::equal(words, image_.words(image_.slots()[slot])))) {
    return Exception::none;
  }
  const auto channel = static_cast<std::size_t>(point.channel.value_or(0));
  const bool is_good = channel < device_.channels().size() && is_symbol(point, number) &&
                       bindings_[slot].setter->gather(write, channel, number);
  return is_good ? Exception::none : Exception::illegal_data_value;
}

}  // namespace gonio
