#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "emulator/protocol/modbus.hpp"
#include "emulator/protocol/unit.hpp"

namespace gonio::modbus {

/// A PDU without heap memory: function code and data. `Pdu reply;` leaves its room unwritten.
class Pdu {
 public:
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool is_exception() const { return size_ > 0 && (bytes_[0] & 0x80U) != 0; }

  /// What follows is added at the end. @throws std::length_error  beyond 253 bytes.
  void append(std::uint8_t byte) { extend(1)[0] = byte; }
  void append_u16(std::uint16_t value);  ///< high byte first
  void append(std::span<const std::uint8_t> bytes);
  /// @return  `count` more bytes at the end, for the caller to write.
  [[nodiscard]] std::span<std::uint8_t> extend(std::size_t count);
  void clear() { size_ = 0; }

 private:
  std::array<std::uint8_t, max_pdu> bytes_;  // clearing them would double the cost of a short reply
  std::size_t size_ = 0;
};

/// The exception response to a function code.
[[nodiscard]] Pdu exception_pdu(std::uint8_t function_code, Exception exception);

/// Answers a request to a unit. Depends on nothing but its arguments.
///
/// Checks in the order of the specification: function code (01), quantity, value and length (03),
/// address (02), execution (04, 06). Nothing of the unit has changed if the answer is an exception.
/// Bytes beyond a request's own length are an error (03). Function codes 8 and 17 are of the serial
/// line only. A broadcast is answered like any request: the caller keeps the answer to itself.
///
/// @param request  function code and data, 1 to 253 bytes. @throws std::invalid_argument  if empty
///                 or longer.
/// @see  Modbus Application Protocol V1.1b3, section 6
[[nodiscard]] Pdu answer(std::span<const std::uint8_t> request, Unit& unit, Line line);

}  // namespace gonio::modbus
