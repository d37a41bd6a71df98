#include "emulator/core/input_error.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gonio {
namespace {

const SourceMark place{.file = "a.yaml", .line = 14, .column = 9, .key = "surface.rms_slope"};

TEST(InputError, SaysWhereWhatWasExpectedAndWhatWasFound) {
  EXPECT_STREQ(InputError(place, "a number > 0", "-0.1").what(),
               "a.yaml:14:9: surface.rms_slope: expected a number > 0, found '-0.1'");
}

TEST(InputError, KeepsItsPlace) {
  const InputError error(place, "this", "that");
  EXPECT_EQ(error.mark().file, "a.yaml");
  EXPECT_EQ(error.mark().line, 14);
  EXPECT_EQ(error.mark().column, 9);
  EXPECT_EQ(error.mark().key, "surface.rms_slope");
}

TEST(InputError, DoesNotQuoteNothing) {
  EXPECT_STREQ(InputError(place, "text", "nothing").what(),
               "a.yaml:14:9: surface.rms_slope: expected text, found nothing");
}

TEST(InputError, QuotesALongTextInPart) {
  const std::string message = InputError(place, "text", std::string(5000, 'x')).what();
  EXPECT_LT(message.size(), 200U);
  EXPECT_TRUE(message.ends_with("xxx...'")) << message;
}

TEST(InputError, SendsNoControlCharactersToTheTerminal) {
  const std::string message = InputError(place, "text", "\x1b[31mred\nnext\x7f").what();
  EXPECT_TRUE(message.ends_with("found ' [31mred next '")) << message;
}

TEST(SourceMark, LeavesOutThePartsThatAreNotThere) {
  EXPECT_EQ(place.text(), "a.yaml:14:9: surface.rms_slope");
  EXPECT_EQ((SourceMark{.file = "a.csv", .line = 2, .column = 5, .key = {}}.text()), "a.csv:2:5");
  EXPECT_EQ((SourceMark{.file = "a.csv", .line = 0, .column = 0, .key = {}}.text()), "a.csv");
}

}  // namespace
}  // namespace gonio
