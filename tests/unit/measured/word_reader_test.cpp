#include "emulator/measured/word_reader.hpp"

#include <gtest/gtest.h>

#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

TEST(WordReader, GoesThroughWordsAndSkipsComments) {
  WordReader words("# first\r\n one two#x\n\t3", "f", '#');
  EXPECT_EQ(words.take().text, "one");
  const Word two = words.take();
  EXPECT_EQ(two.text, "two");
  EXPECT_EQ(two.line, 2);
  EXPECT_EQ(two.column, 6);
  EXPECT_EQ(words.take_number("n"), 3.0);
  EXPECT_TRUE(words.at_end());
  EXPECT_EQ(words.first_comment(), "first");
}

TEST(WordReader, TakesTheRestOfALine) {
  WordReader words("key a value # comment\nnext", "f", '#');
  words.take();
  EXPECT_EQ(words.take_rest_of_line(), "a value");
  EXPECT_EQ(words.take().text, "next");
  EXPECT_EQ(words.take_rest_of_line(), "");
}

TEST(WordReader, TakesFiniteNumbersOnly) {
  EXPECT_EQ(number_of("+1.5e-3"), 1.5e-3);
  for (const char* text : {"", "+", "+-1", "1x", "nan", "inf", "1e999", "0x10"}) {
    EXPECT_FALSE(number_of(text)) << text;
  }
}

TEST(WordReader, HoldsCountsAgainstTheRestOfTheText) {
  const auto error_of = [](const std::string& text) {
    return message_of([&] { (void)WordReader(text, "f", '#').take_count("n"); });
  };
  EXPECT_EQ(error_of("2 0 1"), "no error");
  EXPECT_EQ(error_of("2 0"), "f:1:3: n: expected 2 numbers, found '0'");
  for (const char* count : {"0", "-1", "1.5", "1e18"}) {
    EXPECT_EQ(error_of(count),
              "f:1:1: n: expected a number of values, from 1 to what the file can "
              "hold, found '" +
                  std::string(count) + "'");
  }
}

}  // namespace
}  // namespace gonio::test
