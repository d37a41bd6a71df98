#include "emulator/core/delimited_text.hpp"

#include <algorithm>

#include "emulator/core/input_error.hpp"

namespace gonio {

namespace {

/// Goes through a text, and knows where it is.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return place_ == text_.size(); }
  [[nodiscard]] char peek() const { return at_end() ? '\n' : text_[place_]; }
  [[nodiscard]] int line() const { return line_; }
  [[nodiscard]] int column() const { return column_; }

  char take() {
    const char c = text_[place_++];
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if (place_ == text_.size() ||
               (static_cast<unsigned char>(text_[place_]) & 0xC0u) != 0x80u) {
      ++column_;  // the next byte begins a character
    }
    return c;
  }

 private:
  std::string_view text_;
  std::size_t place_ = 0;
  int line_ = 1, column_ = 1;
};

class Rows {
 public:
  Rows(std::string_view text, char delimiter, const std::string& file)
      : cursor_(text), delimiter_(delimiter), file_(file) {}

  [[nodiscard]] bool at_end() const { return cursor_.at_end(); }

  /// The cells up to the end of a line, which is taken as well.
  void take(std::vector<DelimitedCell>& cells) {
    cells.clear();
    cells.push_back(cell());
    while (!at_end() && cursor_.peek() == delimiter_) {
      cursor_.take();
      cells.push_back(cell());
    }
    if (!at_end()) {
      cursor_.take();
    }
  }

 private:
  [[nodiscard]] bool is_blank(char c) const {
    return c != delimiter_ && (c == ' ' || c == '\t' || c == '\r');
  }
  [[nodiscard]] bool is_at_cell_end() const {
    return cursor_.at_end() || cursor_.peek() == delimiter_ || cursor_.peek() == '\n';
  }
  void skip_blanks() {
    while (!is_at_cell_end() && is_blank(cursor_.peek())) {
      cursor_.take();
    }
  }

  DelimitedCell cell() {
    skip_blanks();
    DelimitedCell cell{.text = {}, .line = cursor_.line(), .column = cursor_.column()};
    if (cursor_.peek() == '"') {
      take_quoted(cell);
      return cell;
    }
    while (!is_at_cell_end()) {
      cell.text += cursor_.take();
    }
    while (!cell.text.empty() && is_blank(cell.text.back())) {
      cell.text.pop_back();
    }
    return cell;
  }

  void take_quoted(DelimitedCell& cell) {
    cursor_.take();
    for (;;) {
      if (cursor_.at_end()) {
        throw InputError({.file = file_, .line = cell.line, .column = cell.column},
                         "a quote at the end of the cell too", "the end of the file");
      }
      const char c = cursor_.take();
      if (c != '"') {
        cell.text += c;
      } else if (cursor_.peek() == '"' && !cursor_.at_end()) {
        cell.text += cursor_.take();
      } else {
        break;
      }
    }
    skip_blanks();
    if (!is_at_cell_end()) {
      throw InputError({.file = file_, .line = cursor_.line(), .column = cursor_.column()},
                       "the end of the cell after its closing quote",
                       std::string(1, cursor_.peek()));
    }
  }

  Cursor cursor_;
  char delimiter_;
  const std::string& file_;
};

}  // namespace

void for_each_delimited_row(std::string_view text, char delimiter, const std::string& file,
                            const std::function<void(const std::vector<DelimitedCell>&)>& row) {
  Rows rows(text, delimiter, file);
  std::vector<DelimitedCell> cells;
  while (!rows.at_end()) {
    rows.take(cells);
    const bool is_blank = std::all_of(cells.begin(), cells.end(),
                                      [](const DelimitedCell& cell) { return cell.text.empty(); });
    if (!is_blank) {
      row(cells);
    }
  }
}

}  // namespace gonio
