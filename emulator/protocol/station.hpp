#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "emulator/instrument/device.hpp"
#include "emulator/protocol/dispatcher.hpp"
#include "emulator/protocol/instrument_unit.hpp"

namespace gonio {

/// Instruments behind one server: their devices, their units, and what they share. Stays where it
/// is, since its parts refer to each other.
class Station {
 public:
  struct Member {
    std::uint8_t id = 1;  ///< 1 to 247
    Device device;
  };

  /// @param seed   of the faults on demand.
  /// @param speed  seconds of the instruments in a second of the world, > 0.
  /// @throws std::invalid_argument  as Dispatcher.
  Station(std::vector<Member> members, const InstrumentUnit::Options& options,
          std::uint64_t seed = 1, double speed = 1.0);
  Station(const Station&) = delete;
  Station& operator=(const Station&) = delete;

  [[nodiscard]] Dispatcher& dispatcher() { return dispatcher_; }
  [[nodiscard]] FaultPlan& faults() { return faults_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] std::vector<Member>& members() { return members_; }

 private:
  [[nodiscard]] std::vector<ServedUnit> make_units(const InstrumentUnit::Options& options);

  std::vector<Member> members_;
  FaultPlan faults_;
  Counters counters_;
  std::vector<std::unique_ptr<InstrumentUnit>> units_;
  Dispatcher dispatcher_;
};

}  // namespace gonio
