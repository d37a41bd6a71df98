#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "tests/unit/hex.hpp"
#include "tests/wire/waiting.hpp"

namespace gonio::test {

/// How long one waits for what must come.
constexpr milliseconds patience{5000};

/// A plain socket to a server on this machine.
class TcpSocket {
 public:
  /// @param receive_buffer  of the kernel, in bytes; 0: as it likes.
  explicit TcpSocket(std::uint16_t port, int receive_buffer = 0);
  ~TcpSocket() { close(); }
  TcpSocket(TcpSocket&& other) noexcept;
  TcpSocket& operator=(TcpSocket&& other) noexcept;

  /// @return  whether the other side took all of it in time.
  bool send(std::span<const std::uint8_t> bytes, milliseconds within = patience);
  /// Sends what goes without waiting. @return  how many bytes; -1 if the connection is gone.
  ssize_t send_some(std::span<const std::uint8_t> bytes);

  /// @return  `count` bytes; less if no more come in time, or the other side closes.
  [[nodiscard]] Bytes receive(std::size_t count, milliseconds within = patience);
  /// @return  one whole ADU, by the length in its header; empty if none comes in time.
  [[nodiscard]] Bytes receive_adu(milliseconds within = patience);
  /// Whether the other side closes in time; what it sends before is dropped.
  [[nodiscard]] bool is_closed(milliseconds within = patience);

  /// Tells the other side that no more comes.
  void half_close();
  /// Ends the connection without the usual farewell (RST).
  void reset();
  void close();

 private:
  int file_ = -1;
};

/// Header and PDU. @param pdu  as hexadecimal digits.
[[nodiscard]] Bytes adu(std::uint16_t transaction, std::string_view pdu, std::uint8_t unit = 1);
/// So many of them, with transaction ids from 0, in one piece.
[[nodiscard]] Bytes many_adus(std::size_t count, std::string_view pdu);

/// Requests of the block of known values (registers 300 to 313), and the reply.
constexpr std::string_view read_known = "03 012C 000E";
constexpr std::string_view read_known_inputs = "04 012C 000E";
constexpr std::string_view known_registers =
    "C2F6 E666 E666 C2F6 CFC7 D431 F8A4 32EB 1234 5678 2D31 3233 2E34 3500";
[[nodiscard]] Bytes known_reply(std::uint16_t transaction, std::uint8_t function = 3,
                                std::uint8_t unit = 1);

}  // namespace gonio::test
