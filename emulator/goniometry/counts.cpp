#include "emulator/goniometry/counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "emulator/core/delimited_text.hpp"
#include "emulator/core/quantity.hpp"
#include "emulator/core/text_file.hpp"

namespace gonio {

namespace {

using Eigen::Index;

/// The largest number of a detector that is not nonsense.
constexpr double most_counts = 1e12;

class CountsReader {
 public:
  CountsReader(std::string file, const CountsFormat& format)
      : file_(std::move(file)), format_(format) {}

  void row(const std::vector<DelimitedCell>& cells) {
    if (cells.front().text.starts_with('#') || is_header(cells)) {
      return;
    }
    if (columns_ == 0) {
      columns_ = cells.size();
      if (columns_ < 2) {
        fail(cells.back(), "a column of the axis and one of counts", "1 column");
      }
    }
    if (cells.size() != columns_) {
      fail(cells.back(), fmt::format("{} cells", columns_), fmt::format("{} cells", cells.size()));
    }
    for (const DelimitedCell& cell : cells) {
      values_.push_back(number(cell));
    }
    const std::size_t begin = values_.size() - columns_;
    if (rows_ > 0 && !(values_[begin] > values_[begin - columns_])) {
      fail(cells.front(), fmt::format("more than in the row before, {}", values_[begin - columns_]),
           cells.front().text);
    }
    ++rows_;
  }

  Counts finish() {
    if (rows_ < 2) {
      throw InputError({.file = file_}, "two rows of numbers at least", fmt::format("{}", rows_));
    }
    using RowMajor = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::ArrayXXd all =
        Eigen::Map<const RowMajor>(values_.data(), Index(rows_), Index(columns_));
    return {
        .axis = all.col(0), .repeats = all.rightCols(Index(columns_) - 1), .mark = {.file = file_}};
  }

 private:
  [[noreturn]] void fail(const DelimitedCell& cell, const std::string& expected,
                         const std::string& found) const {
    throw InputError({.file = file_, .line = cell.line, .column = cell.column}, expected,
                     found.empty() ? "nothing" : found);
  }

  [[nodiscard]] std::optional<double> parsed(const DelimitedCell& cell) const {
    std::string text = cell.text;
    if (format_.decimal == ',') {
      if (text.find('.') != std::string::npos) {
        return std::nullopt;
      }
      std::ranges::replace(text, ',', '.');
    }
    return parse_quantity(text, Dimension::number);
  }

  [[nodiscard]] double number(const DelimitedCell& cell) const {
    const auto value = parsed(cell);
    if (!value || std::abs(*value) > most_counts) {
      fail(cell,
           fmt::format("a number with a decimal {}", format_.decimal == ',' ? "comma" : "point"),
           cell.text);
    }
    return *value;
  }

  bool is_header(const std::vector<DelimitedCell>& cells) {
    const bool is_first = !has_begun_;
    has_begun_ = true;
    return is_first && !parsed(cells.front());
  }

  std::string file_;
  CountsFormat format_;
  bool has_begun_ = false;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<double> values_ = {};
};

}  // namespace

Counts load_counts(const std::filesystem::path& path, const CountsFormat& format) {
  const std::string text = read_text_file(path);
  CountsReader reader(path.string(), format);
  for_each_delimited_row(text, format.delimiter, path.string(),
                         [&](const std::vector<DelimitedCell>& cells) { reader.row(cells); });
  return reader.finish();
}

}  // namespace gonio
