#include "tests/wire/serial_port.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/wire_number.hpp"

namespace gonio::test {

SerialPort::SerialPort(const ServerProcess& server, tcflag_t control)
    : server_(server.port()),
      file_(open(server.serial_line().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
  termios line{};
  if (file_ < 0 || tcgetattr(file_, &line) != 0) {
    throw std::system_error(errno, std::generic_category(), server.serial_line());
  }
  cfmakeraw(&line);
  cfsetspeed(&line, B115200);
  line.c_cflag |= CLOCAL | CREAD | control;
  tcsetattr(file_, TCSANOW, &line);
}

SerialPort::~SerialPort() { close(file_); }

void SerialPort::send(std::span<const std::uint8_t> bytes) {
  constexpr milliseconds handed_over{15},
      silence{5};  // by the kernel; that between frames and more
  pause(handed_over);
  server_.send(adu(1, "01 07D0 0001"));
  (void)server_.receive_adu();
  pause(silence);
  const Deadline deadline(patience);
  while (!bytes.empty() && is_readable(file_, deadline, POLLOUT)) {
    const ssize_t count = write(file_, bytes.data(), bytes.size());
    bytes = bytes.subspan(std::size_t(std::max<ssize_t>(count, 0)));
  }
}

void SerialPort::send_what_is_dropped(std::span<const std::uint8_t> bytes) {
  const unsigned before = dropped_frames();
  send(bytes);
  (void)becomes_true([&] { return dropped_frames() != before; });
}

/// Low word of that register.
unsigned SerialPort::dropped_frames() {
  server_.send(adu(1, "04 0201 0001"));
  const Bytes reply = server_.receive_adu();
  return reply.size() > 1 ? modbus::u16_at(reply, reply.size() - 2) : 0;
}

Bytes SerialPort::receive(std::size_t count, milliseconds within) const {
  const Deadline deadline(within);
  Bytes bytes(count);
  std::size_t size = 0;
  while (size < count && is_readable(file_, deadline)) {
    const ssize_t more = read(file_, bytes.data() + size, count - size);
    if (more <= 0 && errno != EAGAIN) {
      break;
    }
    size += std::size_t(std::max<ssize_t>(more, 0));
  }
  bytes.resize(size);
  return bytes;
}

Bytes SerialPort::receive_until_silence(milliseconds first, milliseconds silence) const {
  Bytes all;
  milliseconds within = first;
  for (Bytes more; !(more = receive(1, within)).empty(); within = silence) {
    all.push_back(more.front());
  }
  return all;
}

Bytes rtu_adu(std::string_view pdu, std::uint8_t unit) {
  const Bytes content = bytes_of_hex(pdu);
  Bytes bytes(modbus::max_rtu_adu);
  bytes.resize(modbus::write_rtu_frame(unit, content, bytes));
  return bytes;
}

Bytes known_rtu_reply(std::uint8_t function) {
  return rtu_adu(fmt::format("{:02X} 1C {}", function, known_registers));
}

}  // namespace gonio::test
