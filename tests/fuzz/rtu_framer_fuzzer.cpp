// Input: chunks of bytes that come over a serial line. The first byte of each is its length, up to
// 63, plus 128 if there is a silence before it, plus 64 if the CRC of all since the silence
// follows: no fuzzer finds a CRC.

#include <algorithm>
#include <random>
#include <vector>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/wire_number.hpp"
#include "tests/fuzz/require.hpp"

namespace {

using gonio::modbus::RtuFrame;
using gonio::modbus::RtuFramer;
using gonio::test::require;

using Bytes = std::vector<std::uint8_t>;

constexpr std::chrono::microseconds silence{2006};

/// What lies between silences.
std::vector<Bytes> bursts(std::span<const std::uint8_t> input) {
  std::vector<Bytes> all(1);
  while (!input.empty()) {
    const std::size_t size = std::min<std::size_t>(input[0] & 0x3FU, input.size() - 1);
    if ((input[0] & 0x80U) != 0 && !all.back().empty()) {
      all.emplace_back();
    }
    Bytes& burst = all.back();
    const auto chunk = input.subspan(1, size);
    burst.insert(burst.end(), chunk.begin(), chunk.end());
    if ((input[0] & 0x40U) != 0) {
      const std::uint16_t crc = gonio::modbus::crc16(burst);
      burst.push_back(gonio::modbus::low_byte(crc));
      burst.push_back(gonio::modbus::high_byte(crc));
    }
    input = input.subspan(1 + size);
  }
  return all;
}

/// The good frames, written again one after the other, and the number of bad ones.
struct Cut {
  Bytes frames = {};
  std::uint32_t dropped = 0;
  bool operator==(const Cut&) const = default;
};

void append(const RtuFrame& frame, Bytes& frames) {
  require(!frame.pdu.empty() && frame.pdu.size() <= gonio::modbus::max_pdu,
          "PDU of 1 to 253 bytes");
  const std::size_t begin = frames.size();
  frames.resize(begin + gonio::modbus::max_rtu_adu);
  frames.resize(begin + gonio::modbus::write_rtu_frame(frame.unit, frame.pdu,
                                                       std::span(frames).subspan(begin)));
}

/// Chunks of 1 to `largest` bytes, with pauses that are shorter than a silence.
Cut cut(const std::vector<Bytes>& bursts, std::size_t largest) {
  std::minstd_rand random(1);
  RtuFramer framer(silence);
  RtuFramer::Time now{};
  Cut result;
  for (const Bytes& burst : bursts) {
    for (std::span<const std::uint8_t> rest(burst); !rest.empty();) {
      now += std::chrono::microseconds(random() % silence.count());
      require(!framer.end_of_frame(now), "no frame before the silence");
      const std::size_t size = std::min<std::size_t>(1 + random() % largest, rest.size());
      framer.feed(rest.first(size), now);
      require(framer.deadline() == now + silence, "the silence counts from the last byte");
      rest = rest.subspan(size);
    }
    now += silence;
    if (const auto frame = framer.end_of_frame(now)) {
      append(*frame, result.frames);
    }
    require(!framer.deadline(), "nothing is kept after the silence");
  }
  result.dropped = framer.dropped();
  return result;
}

/// The same by definition: unit, PDU of 1 to 253 bytes, CRC.
Cut expected(const std::vector<Bytes>& bursts) {
  Cut result;
  for (const Bytes& burst : bursts) {
    const bool is_good =
        burst.size() >= 4 && burst.size() <= 256 && gonio::modbus::crc16(burst) == 0;
    if (is_good) {
      result.frames.insert(result.frames.end(), burst.begin(), burst.end());
    }
    result.dropped += is_good || burst.empty() ? 0 : 1;
  }
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<Bytes> input = bursts({data, size});
  const Cut right = expected(input);
  require(cut(input, 1) == right, "frames are cut at silences, byte by byte");
  require(cut(input, 40) == right && cut(input, 4096) == right,
          "the same frames however they are chunked");
  return 0;
}
