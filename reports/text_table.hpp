#pragma once

#include <string>
#include <vector>

namespace gonio {

/// A table of aligned columns for a terminal.
class TextTable {
 public:
  /// @param heads  of the columns; one that begins with '>' aligns its column to the right.
  explicit TextTable(const std::vector<std::string>& heads);

  /// Text of others becomes one line; a cell that is missing is empty.
  void add(const std::vector<std::string>& cells);
  /// Each row indented by `indent` and ended by a line break, without spaces at its end.
  [[nodiscard]] std::string text(std::size_t indent = 0) const;

 private:
  std::vector<bool> is_right_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace gonio
