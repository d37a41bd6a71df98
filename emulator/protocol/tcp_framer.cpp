#include "emulator/protocol/tcp_framer.hpp"

#include <algorithm>
#include <stdexcept>

#include "emulator/protocol/wire_number.hpp"

namespace gonio::modbus {

namespace {

constexpr std::size_t header_size = 7;
constexpr std::size_t min_length = 2, max_length = max_pdu + 1;  // unit and PDU

/// A header is judged as soon as the byte that spoils it is there.
bool has_corrupt_header(std::span<const std::uint8_t> bytes) {
  const auto is_not_zero = [&](std::size_t i) { return bytes.size() > i && bytes[i] != 0; };
  return is_not_zero(2) || is_not_zero(3) ||  // protocol id
         is_not_zero(4) ||                    // length
         (bytes.size() > 5 && (bytes[5] < min_length || bytes[5] > max_length));
}

}  // namespace

std::span<std::uint8_t> TcpFramer::space() {
  if (begin_ != 0) {
    std::copy(buffer_.begin() + std::ptrdiff_t(begin_), buffer_.begin() + std::ptrdiff_t(end_),
              buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
  }
  return std::span(buffer_).subspan(end_);
}

void TcpFramer::received(std::size_t count) {
  if (count > capacity - end_) {
    throw std::length_error("TcpFramer::received: more than its space");
  }
  end_ += count;
}

std::optional<TcpFrame> TcpFramer::next() {
  const std::span<const std::uint8_t> bytes = std::span(buffer_).subspan(begin_, end_ - begin_);
  is_corrupt_ = has_corrupt_header(bytes);  // for good: these bytes are not taken
  if (is_corrupt_ || bytes.size() < header_size) {
    return std::nullopt;
  }
  const std::size_t size = header_size - 1 + u16_at(bytes, 4);
  if (bytes.size() < size) {
    return std::nullopt;
  }
  begin_ += size;
  return TcpFrame{.transaction = u16_at(bytes, 0),
                  .unit = bytes[6],
                  .pdu = bytes.subspan(header_size, size - header_size)};
}

std::size_t write_tcp_frame(std::uint16_t transaction, std::uint8_t unit,
                            std::span<const std::uint8_t> pdu, std::span<std::uint8_t> out) {
  if (pdu.empty() || pdu.size() > max_pdu || out.size() < header_size + pdu.size()) {
    throw std::length_error("write_tcp_frame: PDU of the wrong size, or no room for it");
  }
  const std::array<std::uint8_t, header_size> header = {
      high_byte(transaction),
      low_byte(transaction),
      0,
      0,
      0,
      static_cast<std::uint8_t>(pdu.size() + 1),  // at most 254
      unit};
  std::copy(header.begin(), header.end(), out.begin());
  std::copy(pdu.begin(), pdu.end(), out.begin() + header_size);
  return header_size + pdu.size();
}

}  // namespace gonio::modbus
