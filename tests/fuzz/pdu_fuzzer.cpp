// Input: the PDU of a request.

#include <stdexcept>
#include <string>

#include "emulator/protocol/pdu.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/unit/protocol/fake_unit.hpp"

namespace {

using gonio::modbus::Exception;
using gonio::modbus::Line;
using gonio::modbus::Pdu;
using gonio::test::FakeUnit;
using gonio::test::require;

constexpr std::size_t places = 2048;  // from 0 on: whole bytes of an input find it

FakeUnit make_unit() {
  FakeUnit unit(0, places);
  for (std::size_t i = 0; i < places; ++i) {
    unit.coils.values[i] = i % 3 == 0 ? 1 : 0;
    unit.discrete_inputs.values[i] = i % 5 == 0 ? 1 : 0;
    unit.holding_registers.values[i] = static_cast<std::uint16_t>(i * 40503U);
    unit.input_registers.values[i] = static_cast<std::uint16_t>(i * 9973U);
  }
  unit.holding_registers.holes = unit.coils.holes = {0x0110, 0x0300};
  unit.holding_registers.read_only = unit.coils.read_only = {0x0120, 0x0400};
  unit.identity.objects = {
      {0, "vendor"},           {1, std::string(200, 'c')},   {2, "1.0"}, {4, std::string(244, 'p')},
      {0x80, "serial number"}, {0xFF, std::string(100, 'z')}};
  return unit;
}

bool writes(std::uint8_t code) {
  return code == 5 || code == 6 || code == 15 || code == 16 || code == 22 || code == 23;
}

/// What holds for every reply, and for a unit before and after it.
void check_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply,
                 const FakeUnit& before, const FakeUnit& after) {
  const std::uint8_t code = request[0];
  require(reply.size() >= 2 && reply.size() <= gonio::modbus::max_pdu, "2 to 253 bytes");
  if (reply[0] == (code | 0x80U)) {
    require(reply.size() == 2, "an exception has 2 bytes");
    const std::uint8_t exception = reply[1];
    require((exception >= 1 && exception <= 4) || exception == 6, "an exception code of a server");
    require(after.has_same_values(before), "nothing changes with an exception");
    return;
  }
  require(reply[0] == code && code < 0x80, "the function code of the request");
  require(writes(code) || after.has_same_values(before), "reading changes nothing");
  if ((code >= 1 && code <= 4) || code == 17 || code == 23) {
    require(reply.size() == 2U + reply[1], "as many bytes as it says");
  }
  if (code == 43) {
    std::size_t at = 7;
    for (int objects = reply[6]; objects > 0; --objects) {
      require(at + 2 <= reply.size(), "objects end within the reply");
      at += 2U + reply[at + 1];
    }
    require(at == reply.size(), "objects fill the reply");
    require(reply[4] == 0 || reply[6] > 0, "a stream goes on");
  }
}

void check_request(std::span<const std::uint8_t> request) {
  static const FakeUnit before = make_unit();
  static FakeUnit after = before;
  for (const Exception failure :
       {Exception::none, Exception::server_device_failure, Exception::server_device_busy}) {
    for (const Line line : {Line::tcp, Line::serial}) {
      after.holding_registers.values = before.holding_registers.values;
      after.coils.values = before.coils.values;
      after.failure = failure;
      const Pdu reply = answer(request, after, line);
      check_reply(request, reply.bytes(), before, after);
      require(failure == Exception::none || reply.is_exception() || !writes(request[0]),
              "a failure is told");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> request(data, size);
  if (size >= 1 && size <= gonio::modbus::max_pdu) {
    check_request(request);
    return 0;
  }
  static FakeUnit unit = make_unit();
  bool is_refused = false;
  try {
    (void)answer(request, unit, Line::tcp);
  } catch (const std::invalid_argument&) {
    is_refused = true;
  }
  require(is_refused, "what is no PDU is refused");
  return 0;
}
