#include "emulator/protocol/station.hpp"

#include <utility>

namespace gonio {

Station::Station(std::vector<Member> members, const InstrumentUnit::Options& options,
                 std::uint64_t seed, double speed)
    : members_(std::move(members)),
      faults_(seed),
      dispatcher_(make_units(options), faults_, counters_, [this, speed](double seconds) {
        for (Member& member : members_) {
          member.device.advance(speed * seconds);
        }
      }) {}

std::vector<ServedUnit> Station::make_units(const InstrumentUnit::Options& options) {
  std::vector<ServedUnit> served;
  for (Member& member : members_) {
    units_.push_back(std::make_unique<InstrumentUnit>(member.device, faults_, counters_, options));
    served.push_back({.id = member.id, .unit = units_.back().get()});
  }
  return served;
}

}  // namespace gonio
