#pragma once

#include <termios.h>

#include <cstdint>
#include <span>
#include <string_view>

#include "tests/wire/server_process.hpp"
#include "tests/wire/tcp_socket.hpp"

namespace gonio::test {

/// The master's end of a serial line: the pseudo terminal of a server, opened as a client opens it.
class SerialPort {
 public:
  /// @param control  flags that a client sets beside 8 bits, e.g. PARENB.
  explicit SerialPort(const ServerProcess& server, tcflag_t control = 0);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Sends after a silence. Silence is what the server takes for it: on a machine that gives it no
  /// processor for a while two frames look like one. So it is asked, over TCP, whether it is awake.
  void send(std::span<const std::uint8_t> bytes);
  /// The same, and waits until the server has found that it is no frame.
  void send_what_is_dropped(std::span<const std::uint8_t> bytes);
  /// @return  `count` bytes; less if no more come in time.
  [[nodiscard]] Bytes receive(std::size_t count, milliseconds within = patience) const;
  /// @return  all until nothing came for `silence`.
  [[nodiscard]] Bytes receive_until_silence(milliseconds first = patience,
                                            milliseconds silence = milliseconds(30)) const;

 private:
  [[nodiscard]] unsigned dropped_frames();

  TcpSocket server_;
  int file_ = -1;
};

/// Unit, PDU and CRC. @param pdu  as hexadecimal digits.
[[nodiscard]] Bytes rtu_adu(std::string_view pdu, std::uint8_t unit = 1);
[[nodiscard]] Bytes known_rtu_reply(std::uint8_t function = 3);

}  // namespace gonio::test
