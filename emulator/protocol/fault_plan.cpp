#include "emulator/protocol/fault_plan.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace gonio {

namespace {

using modbus::FunctionCode;
using AddressRange = std::pair<std::uint16_t, std::uint16_t>;  // first, last

constexpr std::array<std::string_view, 9> names = {
    "delay", "no_reply",    "exception", "wrong_transaction", "split", "truncated",
    "stray", "corrupt_crc", "close"};

constexpr Range delay_s = {.low = 0.001, .high = 600.0};
constexpr int highest_function = 127, highest_unit = 247;
constexpr int highest_count = 1'000'000'000;

/// Where a request holds addresses: offset in the PDU of an address, and of a quantity of them.
struct AddressField {
  std::size_t address = 1;
  std::optional<std::size_t> quantity = {};  ///< one if nothing
};

std::vector<AddressField> address_fields(std::uint8_t function) {
  switch (static_cast<FunctionCode>(function)) {
    case FunctionCode::read_coils:
    case FunctionCode::read_discrete_inputs:
    case FunctionCode::read_holding_registers:
    case FunctionCode::read_input_registers:
    case FunctionCode::write_multiple_coils:
    case FunctionCode::write_multiple_registers:
      return {{.address = 1, .quantity = 3}};
    case FunctionCode::write_single_coil:
    case FunctionCode::write_single_register:
    case FunctionCode::mask_write_register:
      return {{.address = 1}};
    case FunctionCode::read_write_multiple_registers:
      return {{.address = 1, .quantity = 3}, {.address = 5, .quantity = 7}};
    default:
      return {};
  }
}

std::optional<unsigned> u16(std::span<const std::uint8_t> request, std::size_t offset) {
  if (offset + 2 > request.size()) {
    return std::nullopt;
  }
  return unsigned{request[offset]} << 8U | request[offset + 1];
}

bool touches(std::span<const std::uint8_t> request, const AddressRange& range) {
  const auto fields = address_fields(request.front());
  return std::any_of(fields.begin(), fields.end(), [&](const AddressField& field) {
    const auto address = u16(request, field.address);
    const auto quantity = field.quantity ? u16(request, *field.quantity) : 1U;
    return address && quantity && *quantity > 0 && *address <= range.second &&
           *address + *quantity > range.first;
  });
}

bool matches(const FaultRule& rule, std::uint8_t unit, std::span<const std::uint8_t> request) {
  return rule.unit.value_or(unit) == unit &&
         rule.function.value_or(request.front()) == request.front() &&
         (!rule.addresses || touches(request, *rule.addresses));
}

std::optional<std::uint16_t> parse_address(std::string_view text) {
  std::uint16_t value = 0;
  const char* const text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, value);
  return error == std::errc() && end == text_end ? std::optional(value) : std::nullopt;
}

/// "0-9", or a single number.
AddressRange read_addresses(const YamlNode& node, std::optional<std::uint8_t> function) {
  const std::string text = node.is_scalar() ? node.text() : std::string();
  const auto dash = text.find('-');
  const auto first = parse_address(text.substr(0, dash));
  const auto last = dash == std::string::npos ? first : parse_address(text.substr(dash + 1));
  if (!first || !last || *first > *last) {
    node.fail("an address or a range of them in [0, 65535], e.g. 0-9");
  }
  if (function && address_fields(*function).empty()) {
    node.fail("addresses only with a function code that has some");
  }
  return {*first, *last};
}

/// What only some faults have.
void read_parameters(YamlMap& map, FaultRule& rule) {
  if (rule.fault == WireFault::delay || rule.fault == WireFault::split) {
    const double time_s = map.required("time").time_s(delay_s);
    rule.time = std::chrono::milliseconds(std::lround(time_s * 1e3));
  }
  if (rule.fault == WireFault::exception) {
    const std::string code = map.required("code").choice({"4", "6", "10", "11"});
    rule.code = static_cast<modbus::Exception>(std::stoi(code));
  }
}

/// Which requests the rule is for, and how many.
void read_selection(YamlMap& map, FaultRule& rule) {
  if (const auto unit = map.optional("unit")) {
    rule.unit = static_cast<std::uint8_t>(unit->integer(1, highest_unit));
  }
  if (const auto function = map.optional("function")) {
    rule.function = static_cast<std::uint8_t>(function->integer(1, highest_function));
  }
  if (const auto addresses = map.optional("addresses")) {
    rule.addresses = read_addresses(*addresses, rule.function);
  }
  if (const auto count = map.optional("count")) {
    rule.count = static_cast<std::uint32_t>(count->integer(1, highest_count));
  }
  if (const auto probability = map.optional("probability")) {
    rule.probability = probability->number({.low = 0.0, .high = 1.0, .low_open = true});
  }
}

}  // namespace

std::string_view name_of(WireFault fault) { return names.at(static_cast<std::size_t>(fault)); }

std::optional<FaultRule> FaultPlan::strike(std::uint8_t unit,
                                           std::span<const std::uint8_t> request) {
  if (request.empty()) {
    return std::nullopt;
  }
  for (auto rule = rules_.begin(); rule != rules_.end(); ++rule) {
    // A rule that always strikes takes no random number, so that it does not shift the others.
    if (!matches(*rule, unit, request) ||
        (rule->probability < 1.0 &&
         static_cast<double>(random_() >> 11U) * 0x1p-53 >= rule->probability)) {
      continue;
    }
    const FaultRule struck = *rule;
    if (rule->count && --*rule->count == 0) {
      rules_.erase(rule);
    }
    return struck;
  }
  return std::nullopt;
}

FaultRule read_fault_rule(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    FaultRule rule;
    const std::string name = map.required("fault").choice({names.begin(), names.end()});
    rule.fault =
        static_cast<WireFault>(std::find(names.begin(), names.end(), name) - names.begin());
    read_parameters(map, rule);
    read_selection(map, rule);
    return rule;
  });
}

std::vector<FaultRule> read_fault_rules(const YamlNode& list) {
  std::vector<FaultRule> rules;
  for (const YamlNode& item : list.list_or_empty()) {
    rules.push_back(read_fault_rule(item));
  }
  return rules;
}

std::variant<FaultRule, TimedFault> read_any_fault(const YamlNode& node) {
  std::vector<std::string> all(names.begin(), names.end());
  all.insert(all.end(), instrument_fault_names.begin(), instrument_fault_names.end());
  if (instrument_fault(YamlMap(node).required("fault").choice(all))) {
    return read_timed_fault(node);
  }
  return read_fault_rule(node);
}

WireOptions read_wire(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    WireOptions options;
    if (const auto unit = map.optional("unit")) {
      options.unit = unit->integer(1, highest_unit);
    }
    if (const auto faults = map.optional("faults")) {
      options.faults = read_fault_rules(*faults);
    }
    return options;
  });
}

}  // namespace gonio
