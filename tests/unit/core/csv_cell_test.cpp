#include "emulator/core/csv_cell.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace gonio
