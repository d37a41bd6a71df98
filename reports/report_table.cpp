#include "reports/report_table.hpp"

#include <fmt/format.h>

#include "reports/conformance_words.hpp"
#include "reports/escape.hpp"
#include "reports/page_verdict.hpp"
#include "reports/text_table.hpp"

namespace gonio {

namespace {

bool is_right(const ReportTable& table, std::size_t column) {
  return column < table.heads.size() && table.heads[column].starts_with('>');
}

PageData cell_data(const ReportTable& table, const ReportCell& cell, std::size_t column) {
  PageData data;
  data.set("text", cell.verdict ? "" : typeset(cell.text));
  data.set("is_number", PageData(is_right(table, column)));
  data.set("cell_verdict", cell.verdict ? verdict_data(*cell.verdict) : PageData(false));
  return data;
}

PageData row_data(const ReportTable& table, const std::vector<ReportCell>& row) {
  PageData data;
  PageList cells;
  for (std::size_t i = 1; i < row.size(); ++i) {
    cells.push_back(cell_data(table, row[i], i));
  }
  data.set("name", row.empty() ? "" : typeset(row.front().text));
  data.set("is_number", PageData(is_right(table, 0)));
  data.set("cells", PageData(cells));
  return data;
}

}  // namespace

ReportCell::ReportCell(ConformanceVerdict of) : text(verdict_words(of)), verdict(of) {}

std::string heading_text(const std::string& text, bool styled) {
  const std::string line = one_line(text);
  return styled ? fmt::format("\n\033[1m{}\033[0m\n", line) : fmt::format("\n{}\n", line);
}

std::string table_text(const ReportTable& table, bool styled) {
  constexpr std::size_t indent = 2;
  TextTable text(table.heads);
  for (const std::vector<ReportCell>& row : table.rows) {
    std::vector<std::string> cells;
    for (const ReportCell& cell : row) {
      cells.push_back(cell.text);
    }
    text.add(cells);
  }
  return heading_text(table.caption, styled) + text.text(indent);
}

PageData table_data(const ReportTable& table) {
  PageList heads;
  for (std::size_t i = 0; i < table.heads.size(); ++i) {
    PageData head("text", typeset(is_right(table, i) ? table.heads[i].substr(1) : table.heads[i]));
    head.set("is_number", PageData(is_right(table, i)));
    constexpr std::size_t long_letters = 24;  // more may be text of others, which has to wrap
    head.set("is_long", PageData(table.heads[i].size() > long_letters));
    heads.push_back(head);
  }
  PageList rows;
  for (const std::vector<ReportCell>& row : table.rows) {
    rows.push_back(row_data(table, row));
  }
  PageData data("caption", typeset(table.caption));
  data.set("heads", PageData(heads));
  data.set("rows", PageData(rows));
  constexpr std::size_t fits_on_a_sheet = 30;
  data.set("is_short", PageData(rows.size() <= fits_on_a_sheet));
  return data;
}

}  // namespace gonio
