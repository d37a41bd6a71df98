#include "emulator/protocol/delivery.hpp"

#include <functional>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/tcp_framer.hpp"

namespace gonio {

using modbus::Pdu;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes tcp_frame(std::uint16_t transaction, std::uint8_t unit, const Pdu& pdu) {
  Bytes bytes(modbus::max_tcp_adu);
  bytes.resize(modbus::write_tcp_frame(transaction, unit, pdu.bytes(), bytes));
  return bytes;
}

Bytes rtu_frame(std::uint8_t unit, const Pdu& pdu) {
  Bytes bytes(modbus::max_rtu_adu);
  bytes.resize(modbus::write_rtu_frame(unit, pdu.bytes(), bytes));
  return bytes;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// @param reply    the good one.
/// @param foreign  the same under another transaction or unit.
Delivery deliver(const FaultRule& rule, const Bytes& reply, const Bytes& foreign,
                 const Bytes& corrupt) {
  const auto middle = reply.begin() + std::ptrdiff_t(reply.size() / 2);
  switch (rule.fault) {
    case WireFault::delay:
      return {.pause = rule.time, .then = reply};
    case WireFault::no_reply:
      return {};
    case WireFault::exception:
      return {.first = reply};
    case WireFault::wrong_transaction:
      return {.first = foreign};
    case WireFault::split:
      return {.first = {reply.begin(), middle}, .pause = rule.time, .then = {middle, reply.end()}};
    case WireFault::truncated:
      return {.first = {reply.begin(), middle}};
    case WireFault::stray:
      return {.first = foreign + reply};
    case WireFault::corrupt_crc:
      return {.first = corrupt};
    case WireFault::close:
      return {.close = true};
  }
  return {};
}

}  // namespace

Delivery faulty_tcp_reply(const FaultRule& rule, std::uint16_t transaction, std::uint8_t unit,
                          const Pdu& pdu) {
  const Bytes reply = tcp_frame(transaction, unit, pdu);
  const Bytes foreign = tcp_frame(static_cast<std::uint16_t>(transaction + 1U), unit, pdu);
  Bytes corrupt = reply;
  constexpr std::size_t protocol_id = 3;
  corrupt[protocol_id] = 1;
  return deliver(rule, reply, foreign, corrupt);
}

Delivery faulty_rtu_reply(const FaultRule& rule, std::uint8_t unit, const Pdu& pdu) {
  const Bytes reply = rtu_frame(unit, pdu);
  const Bytes foreign = rtu_frame(static_cast<std::uint8_t>(unit + 1U), pdu);
  Bytes corrupt = reply;
  corrupt.back() ^= 0xFFU;
  return deliver(rule, reply, foreign, corrupt);
}

}  // namespace gonio
