#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// Text as one cell of a CSV file: in quotes, its own quotes doubled, if it holds a comma, a quote
/// or a line break; unchanged else. @see RFC 4180
[[nodiscard]] std::string csv_cell(const std::string& text);

/// A cell of an input file.
struct CsvCell {
  std::string_view text;  ///< without the blanks around it
  int column = 1;         ///< of its first character, from 1
};

/// Calls row(cells, number of the line, from 1) for each line of a CSV file that is neither blank
/// nor a comment, which `#` begins. Commas separate cells; a quote is a character like any other.
void for_each_csv_row(std::string_view text,
                      const std::function<void(const std::vector<CsvCell>&, int)>& row);

}  // namespace gonio
