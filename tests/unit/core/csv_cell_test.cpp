#include "emulator/core/csv_cell.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace gonio {
namespace {

TEST(CsvCell, LeavesPlainTextAsItIs) {
  EXPECT_EQ(csv_cell(""), "");
  EXPECT_EQ(csv_cell("Polished copper"), "Polished copper");
  EXPECT_EQ(csv_cell("Ďurikovič 60"), "Ďurikovič 60");
}

TEST(CsvCell, QuotesCommasQuotesAndLineBreaks) {
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_cell("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_cell("a\rb"), "\"a\rb\"");
}

/// Each cell as line:column=text.
std::vector<std::string> cells_in(std::string_view text) {
  std::vector<std::string> found;
  for_each_csv_row(text, [&](const std::vector<CsvCell>& cells, int line) {
    for (const CsvCell& cell : cells) {
      found.push_back(fmt::format("{}:{}={}", line, cell.column, cell.text));
    }
  });
  return found;
}

TEST(CsvRows, AreCellsWithTheirPlaces) {
  EXPECT_EQ(cells_in("a,b\n1,22\n"),
            (std::vector<std::string>{"1:1=a", "1:3=b", "2:1=1", "2:3=22"}));
}

TEST(CsvRows, LeaveOutBlankLinesAndComments) {
  EXPECT_EQ(cells_in("# a, b\n\n \t\r\n  # c\na"), (std::vector<std::string>{"5:1=a"}));
}

TEST(CsvRows, HaveNoBlanksRoundTheirCells) {
  EXPECT_EQ(cells_in(" a\t,  b c \r\n"), (std::vector<std::string>{"1:2=a", "1:7=b c"}));
}

TEST(CsvRows, KeepEmptyCells) {
  EXPECT_EQ(cells_in(",,a, \n"), (std::vector<std::string>{"1:1=", "1:2=", "1:3=a", "1:5="}));
}

TEST(CsvRows, TakeAQuoteForACharacterLikeAnyOther) {
  EXPECT_EQ(cells_in("\"a,b\""), (std::vector<std::string>{"1:1=\"a", "1:4=b\""}));
}

}  // namespace
}  // namespace gonio
