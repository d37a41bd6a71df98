#include "emulator/core/delimited_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

/// Each cell as line:column=text; rows end in a bar.
std::string cells_in(std::string_view text, char delimiter = ';') {
  std::string found;
  for_each_delimited_row(text, delimiter, "table.csv", [&](const auto& cells) {
    for (const DelimitedCell& cell : cells) {
      found += fmt::format("{}:{}={} ", cell.line, cell.column, cell.text);
    }
    found += "|";
  });
  return found;
}

std::string error_of(std::string_view text) {
  return test::message_of([&] { (void)cells_in(text); });
}

TEST(DelimitedText, IsRowsOfCellsWithTheirPlaces) {
  EXPECT_EQ(cells_in("a;b\n1;22\n"), "1:1=a 1:3=b |2:1=1 2:3=22 |");
  EXPECT_EQ(cells_in("a\tb", '\t'), "1:1=a 1:3=b |");
  EXPECT_EQ(cells_in("a,b;c", ','), "1:1=a 1:3=b;c |");
}

TEST(DelimitedText, EndsLinesInLfOrCrlf) {
  EXPECT_EQ(cells_in("a;b\r\n1;2\r\n"), cells_in("a;b\n1;2"));
}

TEST(DelimitedText, LeavesOutBlankRows) {
  EXPECT_EQ(cells_in("\n\r\na\n \n;; \n\nb\n\n"), "3:1=a |7:1=b |");
}

TEST(DelimitedText, KeepsEmptyCells) {
  EXPECT_EQ(cells_in(";;a;"), "1:1= 1:2= 1:3=a 1:5= |");
  EXPECT_EQ(cells_in("\t\ta", '\t'), "1:1= 1:2= 1:3=a |");
}

TEST(DelimitedText, HasNoBlanksRoundItsCells) {
  EXPECT_EQ(cells_in(" a ;\tb c\t"), "1:2=a 1:6=b c |");
}

TEST(DelimitedText, HoldsAnythingInQuotes) {
  EXPECT_EQ(cells_in("\"a;b\";c"), "1:1=a;b 1:7=c |");
  EXPECT_EQ(cells_in("\"say \"\"a\"\"\" ;c"), "1:1=say \"a\" 1:14=c |");
  EXPECT_EQ(cells_in("\"two\nlines\";c\nd"), "1:1=two\nlines 2:8=c |3:1=d |");
  EXPECT_EQ(cells_in("\" a \";\"\""), "1:1= a  1:7= |");
}

TEST(DelimitedText, TakesAQuoteWithinACellAsItIs) {
  EXPECT_EQ(cells_in("5\" wide;6"), "1:1=5\" wide 1:9=6 |");
}

TEST(DelimitedText, CountsCharactersNotBytes) {
  EXPECT_EQ(cells_in("\u2116;\u0422\u0438\u043F;x"), "1:1=\u2116 1:3=\u0422\u0438\u043F 1:7=x |");
}

TEST(DelimitedText, SaysWhereAQuoteIsNotClosed) {
  EXPECT_EQ(error_of("a;b\n1;\"2\n3;4\n"),
            "table.csv:2:3: expected a quote at the end of the cell too, found 'the end of the "
            "file'");
  EXPECT_EQ(error_of("\"a\"b;c"),
            "table.csv:1:4: expected the end of the cell after its closing quote, found 'b'");
}

}  // namespace
}  // namespace gonio
