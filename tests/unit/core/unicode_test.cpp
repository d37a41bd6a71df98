#include "emulator/core/unicode.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace gonio {
namespace {

using namespace std::string_view_literals;

/// "position: what", or "text".
std::string bad_text_in(std::string_view bytes) {
  const auto bad = find_bad_text(bytes);
  return bad ? std::to_string(bad->position) + ": " + bad->what : "text";
}

TEST(FindBadText, TakesCharactersOfOneToFourBytes) {
  for (const auto text : {""sv, "a"sv, "a\tb\r\nc"sv, "\u00a0\u07ff"sv,
                          "\u0800\ud7ff\ue000\uffff"sv, "\U00010000\U0010ffff"sv}) {
    EXPECT_EQ(bad_text_in(text), "text") << text;
  }
}

TEST(FindBadText, PlacesBytesThatAreNotUtf8) {
  EXPECT_EQ(bad_text_in("ab\xff"), "2: the byte 0xFF");
  EXPECT_EQ(bad_text_in("\x80"), "0: the byte 0x80");              // not a first byte
  EXPECT_EQ(bad_text_in("a\xc3"), "1: the byte 0xC3");             // cut off
  EXPECT_EQ(bad_text_in("a\xe2\x82 b"), "1: the byte 0xE2");       // cut off by others
  EXPECT_EQ(bad_text_in("\xc0\xaf"), "0: the byte 0xC0");          // longer than need be
  EXPECT_EQ(bad_text_in("\xe0\x80\xaf"), "0: the byte 0xE0");      // longer than need be
  EXPECT_EQ(bad_text_in("\xf0\x80\x80\xaf"), "0: the byte 0xF0");  // longer than need be
  EXPECT_EQ(bad_text_in("\xed\xa0\x80"), "0: the byte 0xED");      // half of a pair of UTF-16
  EXPECT_EQ(bad_text_in("\xf4\x90\x80\x80"), "0: the byte 0xF4");  // beyond U+10FFFF
}

TEST(FindBadText, PlacesControlCharacters) {
  EXPECT_EQ(bad_text_in("ab\0"sv), "2: the control character U+0000");
  EXPECT_EQ(bad_text_in("\x1b[31m"), "0: the control character U+001B");
  EXPECT_EQ(bad_text_in("a\x7f"), "1: the control character U+007F");
  EXPECT_EQ(bad_text_in("a\u009b"), "1: the control character U+009B");
}

}  // namespace
}  // namespace gonio
