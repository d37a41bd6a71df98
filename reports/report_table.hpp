#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/standard/decision.hpp"
#include "reports/page.hpp"

namespace gonio {

/// What stands in a cell: text, or a verdict.
struct ReportCell {
  // NOLINTNEXTLINE(google-explicit-constructor): rows are written as lists of texts
  ReportCell(std::string words) : text(std::move(words)) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  ReportCell(const char* words) : text(words) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  ReportCell(ConformanceVerdict of);

  std::string text;
  std::optional<ConformanceVerdict> verdict = {};
};

/// A table in words, the same on a terminal and on a page.
struct ReportTable {
  std::string caption = {};
  std::vector<std::string> heads = {};  ///< one that begins with '>' aligns its column to the right
  std::vector<std::vector<ReportCell>> rows = {};  ///< the first cell names the row
};

/// For a terminal: the caption, in bold if `styled`, and the rows below it.
[[nodiscard]] std::string table_text(const ReportTable& table, bool styled);
/// A caption, or another line that stands out.
[[nodiscard]] std::string heading_text(const std::string& text, bool styled);
/// For the template `table`.
[[nodiscard]] PageData table_data(const ReportTable& table);

}  // namespace gonio
