#include "emulator/goniometry/counts.hpp"

#include <gtest/gtest.h>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

std::string refusal_of(std::string_view text, const CountsFormat& format = {}) {
  const TemporaryFolder folder;
  const auto path = folder.file("c.csv", text);
  const std::string message = message_of([&] { (void)load_counts(path, format); });
  return message.substr(message.find("c.csv"));
}

TEST(LoadCounts, ReadsRepeatsBelowAHeader) {
  const TemporaryFolder folder;
  const Counts counts =
      load_counts(folder.file("c.csv", "# dark\npixel,first,second\n0,10,12\n1,20,22\n"), {});
  EXPECT_EQ(counts.axis(1), 1.0);
  EXPECT_EQ(counts.repeats.rows(), 2);
  EXPECT_EQ(counts.repeats.cols(), 2);
  EXPECT_EQ(counts.repeats(1, 0), 20.0);
}

TEST(LoadCounts, ReadsSemicolonsTabsAndDecimalCommas) {
  const TemporaryFolder folder;
  const auto semicolons = folder.file("s.csv", "400,5;10,25\r\n401;20\r\n");
  EXPECT_EQ(load_counts(semicolons, {.delimiter = ';', .decimal = ','}).repeats(0, 0), 10.25);
  const auto tabs = folder.file("t.csv", "400.5\t10.25\n401\t20\n");
  EXPECT_EQ(load_counts(tabs, {.delimiter = '\t'}).axis(0), 400.5);
}

TEST(LoadCounts, SaysWhereAFileIsWrong) {
  EXPECT_EQ(refusal_of("0,1\n"), "c.csv: expected two rows of numbers at least, found '1'");
  EXPECT_EQ(refusal_of("0\n1\n"),
            "c.csv:1:1: expected a column of the axis and one of counts, found '1 column'");
  EXPECT_EQ(refusal_of("0,1\n1,2,3\n"), "c.csv:2:5: expected 2 cells, found '3 cells'");
  EXPECT_EQ(refusal_of("0,1\n0,2\n"),
            "c.csv:2:1: expected more than in the row before, 0, found '0'");
  EXPECT_EQ(refusal_of("0,1\n1,\n"),
            "c.csv:2:3: expected a number with a decimal point, found nothing");
  EXPECT_EQ(refusal_of("0;1\n1;2.5\n", {.delimiter = ';', .decimal = ','}),
            "c.csv:2:3: expected a number with a decimal comma, found '2.5'");
  EXPECT_EQ(refusal_of("0,1\nnext,1\n"),
            "c.csv:2:1: expected a number with a decimal point, found 'next'");
}

}  // namespace
}  // namespace gonio::test
