#include "emulator/protocol/dispatcher.hpp"

#include <fmt/format.h>

#include <set>
#include <stdexcept>
#include <utility>

namespace gonio {

using modbus::Exception;
using modbus::Line;
using modbus::Pdu;

namespace {

constexpr std::uint8_t broadcast = 0;
constexpr std::uint8_t last_unit = 247;
constexpr std::uint8_t this_host = 255;

/// Finer steps of time than this are not worth their cost.
constexpr std::chrono::microseconds time_step{500};

void check_ids(const std::vector<ServedUnit>& units) {
  std::set<int> ids;
  for (const ServedUnit& served : units) {
    if (served.id == broadcast || served.id > last_unit || !ids.insert(served.id).second) {
      throw std::invalid_argument(
          fmt::format("unit ids: expected different ones in [1, 247], found '{}'", served.id));
    }
  }
  if (units.empty()) {
    throw std::invalid_argument("unit ids: expected at least one unit");
  }
}

}  // namespace

Dispatcher::Dispatcher(std::vector<ServedUnit> units, FaultPlan& faults, Counters& counters,
                       std::function<void(double seconds)> advance)
    : units_(std::move(units)), faults_(faults), counters_(counters), advance_(std::move(advance)) {
  check_ids(units_);
}

void Dispatcher::catch_up() {
  const auto now = Clock::now();
  if (now - last_ >= time_step) {
    advance_(std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }
}

const ServedUnit* Dispatcher::find(Line line, std::uint8_t id) const {
  if (line == Line::tcp && (id == broadcast || id == this_host)) {
    return &units_.front();
  }
  for (const ServedUnit& served : units_) {
    if (served.id == id) {
      return &served;
    }
  }
  return nullptr;
}

Pdu Dispatcher::execute(modbus::Unit& unit, const std::optional<FaultRule>& fault,
                        std::span<const std::uint8_t> request, Line line) {
  if (fault && fault->fault == WireFault::exception) {
    return exception_pdu(request[0], fault->code);
  }
  return answer(request, unit, line);
}

Response Dispatcher::handle(Line line, std::uint8_t unit, std::span<const std::uint8_t> request) {
  catch_up();
  if (line == Line::serial && unit == broadcast) {
    ++counters_.requests;
    ++counters_.by_function[request[0] & 0x7FU];
    for (const ServedUnit& served : units_) {
      static_cast<void>(answer(request, *served.unit, line));
    }
    return {};
  }
  const ServedUnit* const found = find(line, unit);
  if (found == nullptr && line == Line::serial) {
    return {};
  }
  ++counters_.requests;
  ++counters_.by_function[request[0] & 0x7FU];
  Response response;
  response.fault = faults_.strike(found == nullptr ? unit : found->id, request);
  counters_.injected_faults += response.fault ? 1 : 0;
  response.pdu = found == nullptr ? exception_pdu(request[0], Exception::gateway_target_failed)
                                  : execute(*found->unit, response.fault, request, line);
  counters_.exceptions += response.pdu->is_exception() ? 1 : 0;
  return response;
}

}  // namespace gonio
