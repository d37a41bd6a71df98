#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "emulator/protocol/modbus.hpp"

namespace gonio::modbus {

/// One request or reply on TCP.
struct TcpFrame {
  std::uint16_t transaction = 0;
  std::uint8_t unit = 0;
  std::span<const std::uint8_t> pdu = {};  ///< 1 to 253 bytes; valid until the framer is fed again
};

/// Cuts a stream of bytes into frames, strictly: protocol id 0, length 2 to 254. A header that
/// breaks this is corrupt, and the stream cannot be trusted from there on: close the connection.
///
/// The caller receives bytes straight into space() and says how many with received(); frames are
/// the same however the bytes were chunked. Never holds more than its buffer.
class TcpFramer {
 public:
  /// Where the next bytes go: at least one, once next() has returned nothing and the stream is not
  /// corrupt. Ends the life of the frames that next() returned.
  [[nodiscard]] std::span<std::uint8_t> space();
  /// @throws std::length_error  for more than space() had room for.
  void received(std::size_t count);

  /// @return  the next whole frame, or nothing: more bytes are needed, or the header is corrupt.
  [[nodiscard]] std::optional<TcpFrame> next();
  [[nodiscard]] bool is_corrupt() const { return is_corrupt_; }
  /// Once next() has returned nothing: a frame has begun and is not whole yet.
  [[nodiscard]] bool is_partial() const { return begin_ != end_; }

 private:
  static constexpr std::size_t capacity = 4096;
  std::array<std::uint8_t, capacity> buffer_{};
  std::size_t begin_ = 0, end_ = 0;
  bool is_corrupt_ = false;
};

/// Writes header and PDU to `out`, which holds at least 7 + pdu.size() bytes.
/// @throws std::length_error  if it does not, or for a PDU that is empty or longer than 253 bytes.
/// @return  the number of bytes written.
std::size_t write_tcp_frame(std::uint16_t transaction, std::uint8_t unit,
                            std::span<const std::uint8_t> pdu, std::span<std::uint8_t> out);

}  // namespace gonio::modbus
