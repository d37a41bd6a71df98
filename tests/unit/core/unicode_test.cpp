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

TEST(Utf8FromUtf16, ConvertsCharactersOfOneAndTwoUnits) {
  EXPECT_EQ(utf8_from_utf16("a\0\xe9\0\x22\x04"sv), "a\u00e9\u0422");
  EXPECT_EQ(utf8_from_utf16("\xac\x20\xff\xd7\0\xe0"sv), "\u20ac\ud7ff\ue000");
  EXPECT_EQ(utf8_from_utf16("\0\xd8\0\xdc\xff\xdb\xff\xdf"sv), "\U00010000\U0010ffff");
  EXPECT_EQ(utf8_from_utf16(""), "");
}

TEST(Utf8FromUtf16, RefusesHalves) {
  EXPECT_FALSE(utf8_from_utf16("a\0b"sv));    // of a unit
  EXPECT_FALSE(utf8_from_utf16("\0\xd8"sv));  // of a pair, at the end
  EXPECT_FALSE(
      utf8_from_utf16("\0\xd8"
                      "a\0"sv));  // of a pair, then another character
  EXPECT_FALSE(
      utf8_from_utf16("\0\xdc"
                      "a\0"sv));  // the second of a pair
  EXPECT_FALSE(utf8_from_utf16("\0\xd8\0"sv));
}

TEST(PlaceInText, CountsLinesAndCharacters) {
  const auto place = [](std::string_view text, std::size_t position) {
    const TextPlace found = place_in_text(text, position);
    return std::to_string(found.line) + ":" + std::to_string(found.column);
  };
  EXPECT_EQ(place("ab", 0), "1:1");
  EXPECT_EQ(place("ab", 2), "1:3");
  EXPECT_EQ(place("a\nbc\nd", 4), "2:3");
  EXPECT_EQ(place("a\nbc\nd", 5), "3:1");
  EXPECT_EQ(place("\u0422\u0438x", 4), "1:3");
}

}  // namespace
}  // namespace gonio
