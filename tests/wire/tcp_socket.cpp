#include "tests/wire/tcp_socket.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "emulator/protocol/tcp_framer.hpp"

namespace gonio::test {

namespace {

/// @return  false if the connection is gone.
bool is_whole(ssize_t count) { return count >= 0 || errno == EAGAIN || errno == EINTR; }

}  // namespace

TcpSocket::TcpSocket(std::uint16_t port, int receive_buffer)
    : file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const int on = 1;
  if (receive_buffer > 0) {
    setsockopt(file_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  setsockopt(file_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(file_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    const int error = errno;
    close();
    throw std::system_error(error, std::generic_category(), "connect");
  }
}

TcpSocket::TcpSocket(TcpSocket&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

TcpSocket& TcpSocket::operator=(TcpSocket&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

ssize_t TcpSocket::send_some(std::span<const std::uint8_t> bytes) {
  const ssize_t count = ::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  return count >= 0 ? count : is_whole(count) ? 0 : -1;
}

bool TcpSocket::send(std::span<const std::uint8_t> bytes, milliseconds within) {
  const Deadline deadline(within);
  while (!bytes.empty()) {
    const ssize_t count = send_some(bytes);
    if (count < 0 || (count == 0 && !is_readable(file_, deadline, POLLOUT))) {
      return false;
    }
    bytes = bytes.subspan(std::size_t(count));
  }
  return true;
}

Bytes TcpSocket::receive(std::size_t count, milliseconds within) {
  const Deadline deadline(within);
  Bytes bytes(count);
  std::size_t size = 0;
  while (size < count && is_readable(file_, deadline)) {
    const ssize_t more = recv(file_, bytes.data() + size, count - size, MSG_DONTWAIT);
    if (more == 0 || !is_whole(more)) {
      break;
    }
    size += std::size_t(std::max<ssize_t>(more, 0));
  }
  bytes.resize(size);
  return bytes;
}

Bytes TcpSocket::receive_adu(milliseconds within) {
  constexpr std::size_t before_unit = 6;
  const Deadline deadline(within);
  Bytes bytes = receive(before_unit, within);
  if (bytes.size() == before_unit) {
    const std::size_t length = std::size_t{bytes[4]} << 8U | bytes[5];
    const Bytes body = receive(length, milliseconds(deadline.left_ms()));
    bytes.insert(bytes.end(), body.begin(), body.end());
  }
  return bytes;
}

bool TcpSocket::is_closed(milliseconds within) {
  const Deadline deadline(within);
  std::array<std::uint8_t, 4096> dropped{};
  while (is_readable(file_, deadline)) {
    const ssize_t count = recv(file_, dropped.data(), dropped.size(), MSG_DONTWAIT);
    if (count == 0 || !is_whole(count)) {
      return true;
    }
  }
  return false;
}

void TcpSocket::half_close() { shutdown(file_, SHUT_WR); }

void TcpSocket::reset() {
  const linger at_once{1, 0};
  setsockopt(file_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close();
}

void TcpSocket::close() {
  if (file_ >= 0) {
    ::close(std::exchange(file_, -1));
  }
}

Bytes adu(std::uint16_t transaction, std::string_view pdu, std::uint8_t unit) {
  const Bytes content = bytes_of_hex(pdu);
  Bytes bytes(modbus::max_tcp_adu);
  bytes.resize(modbus::write_tcp_frame(transaction, unit, content, bytes));
  return bytes;
}

Bytes many_adus(std::size_t count, std::string_view pdu) {
  Bytes all;
  for (std::size_t i = 0; i < count; ++i) {
    const Bytes one = adu(static_cast<std::uint16_t>(i), pdu);
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

Bytes known_reply(std::uint16_t transaction, std::uint8_t function, std::uint8_t unit) {
  return adu(transaction, fmt::format("{:02X} 1C {}", function, known_registers), unit);
}

}  // namespace gonio::test
