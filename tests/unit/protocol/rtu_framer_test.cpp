#include "emulator/protocol/rtu_framer.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/hex.hpp"

namespace gonio::modbus {
namespace {

using std::chrono::microseconds;
using test::Bytes;
using test::bytes_of_hex;
using test::hex;

TEST(Crc16, IsThatOfTheCheckString) {
  const std::string text = "123456789";
  EXPECT_EQ(crc16({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}), 0x4B37);
  EXPECT_EQ(crc16({}), 0xFFFF);
}

TEST(SilenceBetweenFrames, IsThreeAndAHalfCharactersUpTo19200Baud) {
  EXPECT_EQ(silence_between_frames(1200), microseconds(32084));
  EXPECT_EQ(silence_between_frames(9600), microseconds(4011));
  EXPECT_EQ(silence_between_frames(19200), microseconds(2006));
  EXPECT_EQ(silence_between_frames(19201), microseconds(1750));
  EXPECT_EQ(silence_between_frames(115200), microseconds(1750));
  EXPECT_THROW((void)silence_between_frames(0), std::invalid_argument);
  EXPECT_THROW((void)silence_between_frames(-1), std::invalid_argument);
}

/// `hex_text` and its CRC.
Bytes with_crc(const std::string& hex_text) {
  Bytes bytes = bytes_of_hex(hex_text);
  const std::uint16_t crc = crc16(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return bytes;
}

class RtuFramerTest : public testing::Test {
 protected:
  static constexpr microseconds silence{2000}, tick{1};
  RtuFramer framer{silence};
  RtuFramer::Time now{std::chrono::hours(1)};

  void wait(microseconds time) { now += time; }
  void feed(std::span<const std::uint8_t> bytes) { framer.feed(bytes, now); }
  /// Unit and PDU of the frame that is over now.
  std::string ended() {
    const auto frame = framer.end_of_frame(now);
    return frame ? fmt::format("{:02X} [{}]", frame->unit, hex(frame->pdu)) : "nothing";
  }
};

const std::string good_frame = "01 [03 00 00 00 02]";
const Bytes good = with_crc("01 03 0000 0002");

TEST_F(RtuFramerTest, TakesTheLowByteOfTheCrcFirst) {
  feed(bytes_of_hex("01 03 00 00 00 02 C4 0B"));
  wait(silence);
  EXPECT_EQ(ended(), good_frame);
}

TEST_F(RtuFramerTest, EndsAFrameAtTheSilenceAndNotBefore) {
  EXPECT_FALSE(framer.deadline());
  feed(good);
  EXPECT_EQ(framer.deadline(), now + silence);
  wait(silence - tick);
  EXPECT_EQ(ended(), "nothing");
  wait(tick);
  EXPECT_EQ(ended(), good_frame);
  EXPECT_EQ(ended(), "nothing") << "once only";
  EXPECT_FALSE(framer.deadline());
  EXPECT_EQ(framer.dropped(), 0U);
}

TEST_F(RtuFramerTest, AllowsGapsShorterThanTheSilence) {
  for (const std::uint8_t byte : good) {
    wait(silence - tick);
    feed({&byte, 1});
    EXPECT_EQ(framer.deadline(), now + silence);
  }
  wait(silence);
  EXPECT_EQ(ended(), good_frame);
}

TEST_F(RtuFramerTest, DropsAFrameThatIsTornBySilence) {
  feed(std::span(good).first(4));
  wait(silence);
  EXPECT_EQ(ended(), "nothing");
  feed(std::span(good).subspan(4));
  wait(silence);
  EXPECT_EQ(ended(), "nothing");
  EXPECT_EQ(framer.dropped(), 2U);
}

TEST_F(RtuFramerTest, DropsABadCrc) {
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= 0x10;
    feed(bad);
    wait(silence);
    EXPECT_EQ(ended(), "nothing");
  }
  EXPECT_EQ(framer.dropped(), good.size());
}

TEST_F(RtuFramerTest, DropsLessThanFourBytesEvenWithARightCrc) {
  for (const Bytes& bytes : {Bytes{1}, Bytes{0xFF, 0xFF}, with_crc("01")}) {
    feed(bytes);
    wait(silence);
    EXPECT_EQ(ended(), "nothing");
  }
  EXPECT_EQ(framer.dropped(), 3U);
  feed(with_crc("01 07"));
  wait(silence);
  EXPECT_EQ(ended(), "01 [07]");
}

TEST_F(RtuFramerTest, TakesUpTo256BytesAndDropsLonger) {
  Bytes pdu(max_pdu, 0x55), adu(max_rtu_adu);
  ASSERT_EQ(write_rtu_frame(1, pdu, adu), max_rtu_adu);
  feed(adu);
  wait(silence);
  EXPECT_EQ(ended(), "01 [" + hex(pdu) + "]");
  feed(adu);
  feed(Bytes{0});
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), "nothing");
  EXPECT_EQ(framer.dropped(), 1U);
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), good_frame);
}

TEST_F(RtuFramerTest, DropsANoiseByteThatASilenceParts) {
  feed(Bytes{0x00});
  wait(silence);
  EXPECT_EQ(ended(), "nothing");
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), good_frame);
}

TEST_F(RtuFramerTest, DropsAFrameWithANoiseByteBeforeIt) {
  feed(Bytes{0x00});
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), "nothing");
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), good_frame) << "the next one is not touched";
}

TEST_F(RtuFramerTest, DropsFramesWithoutASilenceBetweenThem) {
  feed(good);
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), "nothing");
  EXPECT_EQ(framer.dropped(), 1U);
}

TEST_F(RtuFramerTest, DropsAnOldFrameThatNobodyFetchedAndKeepsTheNewOne) {
  feed(with_crc("02 07"));
  wait(silence);
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), good_frame);
  EXPECT_EQ(framer.dropped(), 1U);
}

TEST_F(RtuFramerTest, CutsTheTrafficOfOthersLikeAnyOther) {
  feed(with_crc("07 03 0000 0001"));
  wait(silence);
  EXPECT_EQ(ended(), "07 [03 00 00 00 01]");
  feed(with_crc("07 03 02 1234"));
  wait(silence);
  EXPECT_EQ(ended(), "07 [03 02 12 34]");
  feed(good);
  wait(silence);
  EXPECT_EQ(ended(), good_frame);
}

TEST_F(RtuFramerTest, NothingIsNoFrame) {
  feed({});
  EXPECT_FALSE(framer.deadline());
  wait(silence);
  EXPECT_EQ(ended(), "nothing");
  EXPECT_EQ(framer.dropped(), 0U);
}

TEST_F(RtuFramerTest, CutsTheSameFramesHoweverTheyAreChunked) {
  constexpr unsigned seed = 1;
  constexpr int frames = 1000;
  std::mt19937 random(seed);
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution(low, high)(random);
  };
  for (int i = 0; i < frames; ++i) {
    Bytes adu(max_rtu_adu);
    const Bytes pdu(std::size_t(uniform(1, 253)), std::uint8_t(uniform(0, 255)));
    adu.resize(write_rtu_frame(std::uint8_t(uniform(0, 247)), pdu, adu));
    const std::string expected = fmt::format("{:02X} [{}]", adu[0], hex(pdu));
    for (std::span<const std::uint8_t> rest(adu); !rest.empty();) {
      const std::size_t size = std::min(rest.size(), std::size_t(uniform(1, 40)));
      feed(rest.first(size));
      rest = rest.subspan(size);
      wait(microseconds(uniform(0, int(silence.count()) - 1)));
      EXPECT_EQ(ended(), "nothing");
    }
    wait(silence);
    EXPECT_EQ(ended(), expected);
  }
  EXPECT_EQ(framer.dropped(), 0U);
}

TEST(WriteRtuFrame, RefusesWhatDoesNotFit) {
  Bytes out(max_rtu_adu);
  EXPECT_EQ(write_rtu_frame(1, Bytes(253), out), 256U);
  EXPECT_THROW((void)write_rtu_frame(1, Bytes(254), out), std::length_error);
  EXPECT_THROW((void)write_rtu_frame(1, {}, out), std::length_error);
  EXPECT_THROW((void)write_rtu_frame(1, Bytes(2), std::span(out).first(4)), std::length_error);
}

}  // namespace
}  // namespace gonio::modbus
