#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "emulator/protocol/modbus.hpp"

namespace gonio::modbus {

/// One request or reply on a serial line.
struct RtuFrame {
  std::uint8_t unit = 0;                   ///< 0: broadcast
  std::span<const std::uint8_t> pdu = {};  ///< 1 to 253 bytes; valid until the framer is fed again
};

/// CRC-16 of Modbus; 0x4B37 for the characters 123456789.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes);

/// The silence that ends a frame: 3.5 characters of 11 bits, rounded up; 1.75 ms above 19200 baud.
/// @throws std::invalid_argument  for a baud rate that is not positive.
/// @see  Modbus over Serial Line V1.02, section 2.5.1.1
[[nodiscard]] std::chrono::microseconds silence_between_frames(int baud);

/// Cuts what comes over a serial line into frames at silences. Time is an argument.
///
/// A frame ends when nothing came for the silence; it is then whole with a right CRC, or dropped
/// without an answer: less than 4 bytes, more than 256, noise, or two frames without a silence
/// between them. The shorter silence of 1.5 characters within a frame is not enforced. Frames for
/// other units and their replies are cut like all others: what is ours is the caller's choice.
class RtuFramer {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit RtuFramer(std::chrono::microseconds silence) : silence_(silence) {}

  /// Takes bytes that came at `now`, not before those of the last call. If silence had passed since
  /// then, they belong to a new frame: call end_of_frame(now) first, or the old one is dropped.
  void feed(std::span<const std::uint8_t> bytes, Time now);

  /// @return  when the frame that has begun will be over if nothing more comes; nothing if none
  /// has.
  [[nodiscard]] std::optional<Time> deadline() const;

  /// @return  the frame that the silence before `now` has ended, if it is good; it is forgotten
  ///          here whether good or not. Nothing while it goes on.
  [[nodiscard]] std::optional<RtuFrame> end_of_frame(Time now);

  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }  ///< frames that were not good

 private:
  [[nodiscard]] bool is_over(Time now) const { return is_begun_ && now >= last_ + silence_; }
  void forget();

  std::chrono::microseconds silence_;
  std::array<std::uint8_t, max_rtu_adu> buffer_{};
  std::size_t size_ = 0;
  bool is_begun_ = false, is_spoiled_ = false;
  Time last_{};
  std::uint32_t dropped_ = 0;
};

/// Writes unit, PDU and CRC to `out`, which holds at least pdu.size() + 3 bytes.
/// @throws std::length_error  if it does not, or for a PDU that is empty or longer than 253 bytes.
/// @return  the number of bytes written.
std::size_t write_rtu_frame(std::uint8_t unit, std::span<const std::uint8_t> pdu,
                            std::span<std::uint8_t> out);

}  // namespace gonio::modbus
