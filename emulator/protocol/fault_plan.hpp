#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "emulator/core/yaml_map.hpp"
#include "emulator/instrument/behaviour.hpp"
#include "emulator/protocol/modbus.hpp"

namespace gonio {

/// What a server does to a reply on demand.
enum class WireFault {
  delay,
  no_reply,
  exception,
  wrong_transaction,  ///< TCP: another transaction id; RTU: another unit
  split,              ///< the reply in two pieces, `time` apart
  truncated,          ///< the first half of the reply
  stray,              ///< the reply, and another one nobody asked for before it
  corrupt_crc,        ///< RTU; on TCP a wrong protocol id
  close               ///< TCP: the connection is closed instead; RTU: no reply
};

/// As it is written in files, e.g. "no_reply".
[[nodiscard]] std::string_view name_of(WireFault fault);

/// Which requests suffer what, and how often.
struct FaultRule {
  WireFault fault = WireFault::no_reply;
  std::chrono::milliseconds time{0};                 ///< of delay and split
  modbus::Exception code = modbus::Exception::none;  ///< of exception: 04, 06, 0A, 0B
  std::optional<std::uint8_t> unit = {};             ///< every unit if nothing
  std::optional<std::uint8_t> function = {};         ///< every function code if nothing
  /// First, last; every request if nothing. Else a request must touch one of them: with function
  /// code 23 to read or to write; one without addresses, or too short to tell, does not.
  std::optional<std::pair<std::uint16_t, std::uint16_t>> addresses = {};
  std::optional<std::uint32_t> count = {};  ///< so many times, then no more
  double probability = 1.0;                 ///< of each request that matches
};

/// Faults on demand. Seeded: the same requests in the same order suffer the same.
class FaultPlan {
 public:
  /// More than anybody needs. Every request looks at all rules: a client must not add for ever.
  static constexpr std::size_t most_rules = 1000;

  explicit FaultPlan(std::uint64_t seed = 1) : random_(seed) {}

  void add(const FaultRule& rule) { rules_.push_back(rule); }
  void clear() { rules_.clear(); }

  /// @param request  PDU. @return  the first rule that strikes, as it was before; nothing for a
  /// good
  ///                 reply. Its count is one less now; at the end of its count it is gone.
  [[nodiscard]] std::optional<FaultRule> strike(std::uint8_t unit,
                                                std::span<const std::uint8_t> request);
  /// Those that can still strike, with what is left of their count.
  [[nodiscard]] const std::vector<FaultRule>& rules() const { return rules_; }
  [[nodiscard]] bool is_full() const { return rules_.size() >= most_rules; }

 private:
  std::vector<FaultRule> rules_;
  std::mt19937_64 random_;
};

/// Reads one rule, e.g. {fault: exception, code: 6, function: 3, addresses: 0-9, count: 2}.
/// @throws InputError  for anything else.
[[nodiscard]] FaultRule read_fault_rule(const YamlNode& node);
[[nodiscard]] std::vector<FaultRule> read_fault_rules(const YamlNode& list);

/// Reads a fault of either kind, of the wire or of the instrument; its name tells which.
/// @throws InputError  for anything else.
[[nodiscard]] std::variant<FaultRule, TimedFault> read_any_fault(const YamlNode& node);

/// How an instrument is on the wire: the map `wire` of its file, e.g. {unit: 1, faults: [...]}.
struct WireOptions {
  int unit = 1;  ///< 1 to 247
  std::vector<FaultRule> faults = {};
};

/// @throws InputError  for anything else.
[[nodiscard]] WireOptions read_wire(const YamlNode& node);

}  // namespace gonio
