#include "reports/text_table.hpp"

#include <algorithm>

#include "reports/escape.hpp"

namespace gonio {

namespace {

/// Letters of clean UTF-8: bytes that do not continue another one.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  }));
}

}  // namespace

TextTable::TextTable(const std::vector<std::string>& heads) {
  std::vector<std::string> cells;
  for (const std::string& head : heads) {
    is_right_.push_back(head.starts_with('>'));
    cells.push_back(is_right_.back() ? head.substr(1) : head);
  }
  add(cells);
}

void TextTable::add(const std::vector<std::string>& cells) {
  std::vector<std::string> row(is_right_.size());
  for (std::size_t i = 0; i < std::min(row.size(), cells.size()); ++i) {
    row[i] = one_line(cells[i]);
  }
  rows_.push_back(std::move(row));
}

std::string TextTable::text(std::size_t indent) const {
  std::vector<std::size_t> widths(is_right_.size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], width_of(row[i]));
    }
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line(indent, ' ');
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string gap(widths[i] - width_of(row[i]), ' ');
      line += is_right_[i] ? gap + row[i] : row[i] + gap;
      line += "  ";
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace gonio
