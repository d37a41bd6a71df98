// Input: what comes over a TCP connection.

#include <algorithm>
#include <random>
#include <vector>

#include "emulator/protocol/tcp_framer.hpp"
#include "tests/fuzz/require.hpp"

namespace {

using gonio::modbus::TcpFrame;
using gonio::modbus::TcpFramer;
using gonio::test::require;

using Bytes = std::vector<std::uint8_t>;

/// The frames, written again, and whether the stream broke behind them.
struct Cut {
  Bytes frames = {};
  bool is_corrupt = false, is_partial = false;
  bool operator==(const Cut&) const = default;
};

void append(const TcpFrame& frame, Bytes& frames) {
  require(!frame.pdu.empty() && frame.pdu.size() <= gonio::modbus::max_pdu,
          "PDU of 1 to 253 bytes");
  const std::size_t begin = frames.size();
  frames.resize(begin + gonio::modbus::max_tcp_adu);
  frames.resize(begin + gonio::modbus::write_tcp_frame(frame.transaction, frame.unit, frame.pdu,
                                                       std::span(frames).subspan(begin)));
}

/// Chunks of 1 to `largest` bytes.
Cut cut(std::span<const std::uint8_t> stream, std::size_t largest) {
  std::minstd_rand random(static_cast<unsigned>(stream.size() + 1));
  TcpFramer framer;
  Cut result;
  while (!stream.empty() && !framer.is_corrupt()) {
    const std::span<std::uint8_t> space = framer.space();
    require(!space.empty(), "space for a byte while there is no whole frame");
    const std::size_t size = std::min({1 + random() % largest, space.size(), stream.size()});
    std::copy_n(stream.begin(), size, space.begin());
    framer.received(size);
    stream = stream.subspan(size);
    while (const auto frame = framer.next()) {
      append(*frame, result.frames);
    }
  }
  result.is_corrupt = framer.is_corrupt();
  result.is_partial = framer.is_partial();
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span stream(data, size);
  const Cut bytewise = cut(stream, 1);
  require(cut(stream, 40) == bytewise && cut(stream, 4096) == bytewise,
          "the same frames however the stream is chunked");
  require(bytewise.frames.size() <= size &&
              std::equal(bytewise.frames.begin(), bytewise.frames.end(), data),
          "frames are what came, byte for byte");
  require(bytewise.is_corrupt || bytewise.is_partial == (bytewise.frames.size() < size),
          "what is left over is a frame that has begun");
  return 0;
}
