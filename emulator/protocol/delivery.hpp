#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "emulator/protocol/fault_plan.hpp"
#include "emulator/protocol/pdu.hpp"

namespace gonio {

/// What goes out for one request, and when.
struct Delivery {
  std::vector<std::uint8_t> first = {};
  std::chrono::milliseconds pause{0};  ///< between first and then
  std::vector<std::uint8_t> then = {};
  bool close = false;  ///< the connection, afterwards; a serial line stays
};

/// What a fault makes of a reply.
[[nodiscard]] Delivery faulty_tcp_reply(const FaultRule& rule, std::uint16_t transaction,
                                        std::uint8_t unit, const modbus::Pdu& pdu);
[[nodiscard]] Delivery faulty_rtu_reply(const FaultRule& rule, std::uint8_t unit,
                                        const modbus::Pdu& pdu);

}  // namespace gonio
