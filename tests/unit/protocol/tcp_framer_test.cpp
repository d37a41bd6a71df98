#include "emulator/protocol/tcp_framer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/hex.hpp"

namespace gonio::modbus {
namespace {

using test::Bytes;
using test::bytes_of_hex;
using test::hex;

/// Transaction, unit and PDU of each frame, and what became of the stream.
std::string describe(const TcpFrame& frame) {
  return fmt::format("{:04X} {:02X} [{}]; ", frame.transaction, frame.unit, hex(frame.pdu));
}
std::string describe_end(const TcpFramer& framer) {
  return framer.is_corrupt() ? "corrupt" : framer.is_partial() ? "partial" : "whole";
}

void feed(TcpFramer& framer, std::span<const std::uint8_t> bytes) {
  const std::span<std::uint8_t> space = framer.space();
  ASSERT_GE(space.size(), bytes.size());
  std::copy(bytes.begin(), bytes.end(), space.begin());
  framer.received(bytes.size());
}

/// Feeds `stream` in chunks of the sizes that `next_size` gives; stops at a corrupt header.
template <class NextSize>
std::string cut(std::span<const std::uint8_t> stream, NextSize&& next_size) {
  TcpFramer framer;
  std::string seen;
  while (!stream.empty() && !framer.is_corrupt()) {
    const std::size_t size = std::min<std::size_t>(next_size(), stream.size());
    feed(framer, stream.first(size));
    stream = stream.subspan(size);
    while (const auto frame = framer.next()) {
      seen += describe(*frame);
    }
  }
  return seen + describe_end(framer);
}

std::string cut_at_once(const std::string& stream) {
  return cut(bytes_of_hex(stream), [] { return 4096; });
}

TEST(TcpFramer, CutsOneRequest) {
  EXPECT_EQ(cut_at_once("1234 0000 0006 01 03 0000 000A"), "1234 01 [03 00 00 00 0A]; whole");
}

TEST(TcpFramer, CutsSeveralRequestsOfOneSegment) {
  EXPECT_EQ(cut_at_once("0001 0000 0003 01 03 04  0002 0000 0002 FF 07  0003 0000 0006 01"),
            "0001 01 [03 04]; 0002 FF [07]; partial");
}

TEST(TcpFramer, TakesLengths2To254) {
  EXPECT_EQ(cut_at_once("0001 0000 0002 01 03"), "0001 01 [03]; whole");
  Bytes longest = bytes_of_hex("0001 0000 00FE 01");
  longest.resize(max_tcp_adu, 0x55);
  TcpFramer framer;
  feed(framer, longest);
  const auto frame = framer.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->pdu.size(), max_pdu);
  EXPECT_FALSE(framer.is_partial());
}

TEST(TcpFramer, CallsAHeaderCorruptAtTheByteThatSpoilsIt) {
  for (const char* header : {"0001 01", "0001 0001", "0001 80", "0001 0000 01", "0001 0000 0000",
                             "0001 0000 0001", "0001 0000 00FF", "0001 0000 FF"}) {
    EXPECT_EQ(cut_at_once(header), "corrupt") << header;
    const Bytes bytes = bytes_of_hex(header);
    const std::string without_last = hex(std::span(bytes).first(bytes.size() - 1));
    EXPECT_EQ(cut_at_once(without_last), "partial") << header;
  }
}

TEST(TcpFramer, GivesTheFramesBeforeACorruptHeader) {
  EXPECT_EQ(cut_at_once("0001 0000 0002 01 03  0002 0000 0000"), "0001 01 [03]; corrupt");
}

TEST(TcpFramer, StaysCorrupt) {
  TcpFramer framer;
  feed(framer, bytes_of_hex("0001 0001"));
  EXPECT_FALSE(framer.next());
  feed(framer, bytes_of_hex("0001 0000 0002 01 03"));
  EXPECT_FALSE(framer.next());
  EXPECT_TRUE(framer.is_corrupt());
}

TEST(TcpFramer, HasSpaceUntilItHoldsAWholeFrame) {
  TcpFramer framer;
  feed(framer, bytes_of_hex("0001 0000 00FE 01"));
  while (!framer.next()) {
    ASSERT_FALSE(framer.space().empty());
    feed(framer, Bytes(1));
  }
  EXPECT_FALSE(framer.is_partial());
}

TEST(TcpFramer, TakesNoMoreThanItsSpace) {
  TcpFramer framer;
  const std::size_t room = framer.space().size();
  EXPECT_THROW(framer.received(room + 1), std::length_error);
  framer.received(room);
  EXPECT_TRUE(framer.space().empty());
  EXPECT_THROW(framer.received(1), std::length_error);
}

TEST(TcpFramer, CutsTheSameFramesHoweverTheStreamIsChunked) {
  constexpr unsigned seed = 1;
  constexpr int streams = 300;
  std::mt19937 random(seed);
  const auto uniform = [&](int low, int high) {
    return std::uniform_int_distribution(low, high)(random);
  };
  int corrupt = 0;
  for (int i = 0; i < streams; ++i) {
    Bytes stream;
    for (int frames = uniform(1, 12); frames > 0; --frames) {
      Bytes pdu(std::size_t(uniform(1, 253)), std::uint8_t(uniform(0, 255)));
      Bytes adu(max_tcp_adu);
      adu.resize(write_tcp_frame(std::uint16_t(uniform(0, 65535)), 1, pdu, adu));
      if (uniform(0, 40) == 0) {
        adu[std::size_t(uniform(2, 5))] ^= std::uint8_t(uniform(1, 255));
      }
      stream.insert(stream.end(), adu.begin(), adu.end());
    }
    const std::string expected = cut(stream, [] { return 4096; });
    EXPECT_EQ(cut(stream, [] { return 1; }), expected);
    EXPECT_EQ(cut(stream, [&] { return uniform(1, 700); }), expected);
    corrupt += expected.ends_with("corrupt") ? 1 : 0;
  }
  EXPECT_GT(corrupt, 0);
  EXPECT_LT(corrupt, streams);
}

TEST(WriteTcpFrame, PutsTheHeaderBeforeThePdu) {
  Bytes out(max_tcp_adu);
  const std::size_t size = write_tcp_frame(0x1234, 0xFF, bytes_of_hex("83 02"), out);
  EXPECT_EQ(hex(std::span(out).first(size)), "12 34 00 00 00 03 FF 83 02");
}

TEST(WriteTcpFrame, RefusesWhatDoesNotFit) {
  Bytes out(max_tcp_adu);
  EXPECT_EQ(write_tcp_frame(1, 1, Bytes(253), out), 260U);
  EXPECT_THROW((void)write_tcp_frame(1, 1, Bytes(254), out), std::length_error);
  EXPECT_THROW((void)write_tcp_frame(1, 1, {}, out), std::length_error);
  EXPECT_THROW((void)write_tcp_frame(1, 1, Bytes(2), std::span(out).first(8)), std::length_error);
}

}  // namespace
}  // namespace gonio::modbus
