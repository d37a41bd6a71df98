#include "reports/report_table.hpp"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(ReportTable, IsTheSameInWordsOnATerminal) {
  const ReportTable table{
      .caption = "Lots",
      .heads = {">Lot", "Verdict", ">Mean"},
      .rows = {{"1", ConformanceVerdict::pass, "60.5"}, {"12", ConformanceVerdict::fail, "9.5"}}};
  EXPECT_EQ(table_text(table, false),
            "\nLots\n  Lot  Verdict  Mean\n    1  pass     60.5\n   12  fail      9.5\n");
  EXPECT_EQ(table_text(table, true).substr(0, 14), "\n\033[1mLots\033[0m\n");
}

TEST(ReportTable, KeepsTextOfOthersInItsLine) {
  EXPECT_EQ(heading_text("a\nb\x1B[31m", false), "\na b[31m\n");
}

}  // namespace
}  // namespace gonio
