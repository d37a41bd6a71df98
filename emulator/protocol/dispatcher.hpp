#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "emulator/protocol/counters.hpp"
#include "emulator/protocol/fault_plan.hpp"
#include "emulator/protocol/pdu.hpp"
#include "emulator/protocol/unit.hpp"

namespace gonio {

/// A unit and the id it answers to.
struct ServedUnit {
  std::uint8_t id = 1;  ///< 1 to 247
  modbus::Unit* unit = nullptr;
};

/// What becomes of a request.
struct Response {
  std::optional<modbus::Pdu> pdu = {};  ///< nothing: not a word
  std::optional<FaultRule> fault = {};  ///< how its delivery is to fail
};

/// Hands requests to units, lets their time pass, counts, and lets faults strike. Knows no sockets.
///
/// On TCP the ids 0 and 255 mean the first unit, since the server is addressed by its host, and an
/// id that nobody has is answered with exception 0B. On a serial line 0 is a broadcast, which every
/// unit obeys and none answers, and an id that nobody has belongs to another device. Faults strike
/// by the id of the unit that is meant.
class Dispatcher {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param units     at least one; ids differ.
  /// @param advance   called with the seconds that have passed, before a request is looked at.
  /// @throws std::invalid_argument  for no unit, a doubled id, or one out of its range.
  Dispatcher(std::vector<ServedUnit> units, FaultPlan& faults, Counters& counters,
             std::function<void(double seconds)> advance);

  /// @param request  PDU, 1 to 253 bytes.
  [[nodiscard]] Response handle(modbus::Line line, std::uint8_t unit,
                                std::span<const std::uint8_t> request);

  /// Lets the time of the units come up to now.
  void catch_up();

  [[nodiscard]] Counters& counters() { return counters_; }

 private:
  [[nodiscard]] const ServedUnit* find(modbus::Line line, std::uint8_t id) const;
  [[nodiscard]] modbus::Pdu execute(modbus::Unit& unit, const std::optional<FaultRule>& fault,
                                    std::span<const std::uint8_t> request, modbus::Line line);

  std::vector<ServedUnit> units_;
  FaultPlan& faults_;
  Counters& counters_;
  std::function<void(double seconds)> advance_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace gonio
