#include "tests/conformance/wire_text.hpp"

#include <gtest/gtest.h>

#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using test::message_of;

TEST(WireText, ReadsHexNamesRepetitionsAndCrcs) {
  const WireText::Addresses addresses = {{"known", 0x012C}};
  WireText text(addresses, 17);
  EXPECT_EQ(hex(text.bytes("0A0b {known} {unit} FF*3")), "0A 0B 01 2C 11 FF FF FF");
  EXPECT_EQ(hex(text.bytes("01 03 0000 0002 {crc}")), "01 03 00 00 00 02 C4 0B");
  EXPECT_EQ(hex(text.bytes("01 03 0000 0002 {bad_crc}")), "01 03 00 00 00 02 3B F4");
  EXPECT_EQ(hex(text.bytes("55 {start} 01 03 0000 0002 {crc}")), "55 01 03 00 00 00 02 C4 0B");
}

TEST(WireText, RefusesWhatItDoesNotKnow) {
  const WireText::Addresses addresses;
  WireText text(addresses, 1);
  const auto message = [&](const std::string& words) {
    return message_of([&] { (void)text.bytes(words); });
  };
  EXPECT_EQ(message("01 {known}"), "expected the name of an address, found 'known'");
  EXPECT_EQ(message("012"), "expected pairs of hex digits, found '012'");
  EXPECT_EQ(message("0x"), "expected pairs of hex digits, found '0x'");
  EXPECT_EQ(message("01 .."), "expected a byte that is known, found '..'");
  EXPECT_EQ(message("01 ..."), "expected a byte to send, found '...'");
  EXPECT_EQ(message("FF*x"), "expected a number of repetitions, found 'x'");
  EXPECT_EQ(message("... 01"), "expected nothing after '...', found '01'");
}

TEST(BytePattern, MatchesAnyByteWhereItIsOpen) {
  const WireText::Addresses addresses;
  const BytePattern closed = WireText(addresses, 1).pattern("01 .. 03");
  EXPECT_TRUE(closed.matches(Bytes{1, 99, 3}));
  EXPECT_FALSE(closed.matches(Bytes{1, 99, 4}));
  EXPECT_FALSE(closed.matches(Bytes{1, 99, 3, 4}));
  EXPECT_FALSE(closed.matches(Bytes{1, 99}));
  const BytePattern open = WireText(addresses, 1).pattern("01 ...");
  EXPECT_TRUE(open.matches(Bytes{1}));
  EXPECT_TRUE(open.matches(Bytes{1, 2, 3}));
  EXPECT_FALSE(open.matches(Bytes{2, 2, 3}));
}

}  // namespace
}  // namespace gonio::conformance
