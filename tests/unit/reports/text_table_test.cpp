#include "reports/text_table.hpp"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(TextTable, AlignsItsColumns) {
  TextTable table({"name", ">value", "unit"});
  table.add({"a", "1.25", "deg"});
  table.add({"longer", "-10"});
  EXPECT_EQ(table.text(2),
            "  name    value  unit\n"
            "  a        1.25  deg\n"
            "  longer    -10\n");
}

TEST(TextTable, CountsLettersNotBytes) {
  TextTable table({"name", "x"});
  table.add({"Stra\u00DFe", "1"});
  table.add({"Strasse", "2"});
  EXPECT_EQ(table.text(), "name     x\nStra\u00DFe   1\nStrasse  2\n");
}

TEST(TextTable, KeepsTextOfOthersInItsCell) {
  TextTable table({"name"});
  table.add({"a\nb\t\x1B[31mc"});
  EXPECT_EQ(table.text(), "name\na b [31mc\n");
}

TEST(TextTable, LeavesOutCellsThatHaveNoColumn) {
  TextTable table({"name"});
  table.add({"a", "b"});
  EXPECT_EQ(table.text(), "name\na\n");
}

}  // namespace
}  // namespace gonio
