#include "emulator/core/csv_cell.hpp"

#include <algorithm>

namespace gonio {

namespace {

constexpr const char* blanks = " \t\r";

CsvCell cell_of(std::string_view line, std::size_t begin, std::size_t end) {
  const std::size_t first = std::min(line.find_first_not_of(blanks, begin), end);
  if (first == end) {
    return {.text = {}, .column = int(begin) + 1};
  }
  const std::size_t last = line.find_last_not_of(blanks, end - 1);
  return {.text = line.substr(first, last + 1 - first), .column = int(first) + 1};
}

std::vector<CsvCell> cells_of(std::string_view line) {
  std::vector<CsvCell> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(cell_of(line, begin, end));
    if (end == line.size()) {
      return cells;
    }
    begin = end + 1;
  }
}

bool is_blank_or_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(blanks);
  return first == std::string_view::npos || line[first] == '#';
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

void for_each_csv_row(std::string_view text,
                      const std::function<void(const std::vector<CsvCell>&, int)>& row) {
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    ++number;
    if (!is_blank_or_comment(line)) {
      row(cells_of(line), number);
    }
    begin = end + 1;
  }
}

}  // namespace gonio
