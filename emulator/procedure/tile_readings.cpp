#include "emulator/procedure/tile_readings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "emulator/core/csv_cell.hpp"
#include "emulator/core/quantity.hpp"
#include "emulator/core/text_file.hpp"

namespace gonio {

namespace {

enum Column { sample, geometry, gloss, uncertainty };
constexpr std::array<const char*, 4> column_names{"sample", "geometry", "gloss_gu",
                                                  "expanded_uncertainty_gu"};
constexpr std::size_t required_columns = 3;  // the first ones

class TileReadingsReader {
 public:
  explicit TileReadingsReader(std::string file) : file_(std::move(file)) {}

  void row(const std::vector<CsvCell>& cells, int line) {
    if (columns_.empty()) {
      header(cells, line);
      return;
    }
    if (cells.size() != columns_.size()) {
      throw InputError(mark(line, cells.back().column), fmt::format("{} cells", columns_.size()),
                       fmt::format("{} cells", cells.size()));
    }
    TileReading reading;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      take(reading, columns_[i], cells[i], line);
    }
    readings_.push_back(std::move(reading));
  }

  std::vector<TileReading> finish() {
    if (readings_.empty()) {
      throw InputError(mark(0, 0), columns_.empty() ? "a header and readings" : "readings", "none");
    }
    return std::move(readings_);
  }

 private:
  [[nodiscard]] SourceMark mark(int line, int column, const char* key = "") const {
    return {.file = file_, .line = line, .column = column, .key = key};
  }

  void header(const std::vector<CsvCell>& cells, int line) {
    for (const CsvCell& cell : cells) {
      const auto name = std::ranges::find(column_names, cell.text);
      if (name == column_names.end()) {
        throw InputError(mark(line, cell.column),
                         fmt::format("one of the columns {}", fmt::join(column_names, ", ")),
                         cell.text.empty() ? "nothing" : std::string(cell.text));
      }
      const auto column = Column(name - column_names.begin());
      if (std::ranges::find(columns_, column) != columns_.end()) {
        throw InputError(mark(line, cell.column), "each column once",
                         fmt::format("{} a second time", *name));
      }
      columns_.push_back(column);
    }
    for (std::size_t i = 0; i < required_columns; ++i) {
      if (std::ranges::find(columns_, Column(i)) == columns_.end()) {
        throw InputError(mark(line, 1), fmt::format("a column {}", column_names[i]), "nothing");
      }
    }
  }

  void take(TileReading& reading, Column column, const CsvCell& cell, int line) const {
    const SourceMark place = mark(line, cell.column, column_names[column]);
    switch (column) {
      case sample:
        reading.sample = text_in(cell, place, "a file or an id of a sample");
        reading.mark = place;
        return;
      case geometry:
        reading.geometry = text_in(cell, place, "the id of a geometry");
        reading.geometry_mark = place;
        return;
      case gloss:
        reading.gloss_gu = number_in(cell, place, Range::any());
        return;
      case uncertainty:
        if (!cell.text.empty()) {
          reading.expanded_uncertainty_gu = number_in(cell, place, Range::positive());
        }
        return;
    }
  }

  static std::string text_in(const CsvCell& cell, const SourceMark& place, const char* expected) {
    if (cell.text.empty()) {
      throw InputError(place, expected, "nothing");
    }
    return std::string(cell.text);
  }

  static double number_in(const CsvCell& cell, const SourceMark& place, const Range& range) {
    const auto value = parse_quantity(cell.text, Dimension::number);
    if (!value || !range.contains(*value)) {
      throw InputError(place, "a number" + range.text(),
                       cell.text.empty() ? "nothing" : std::string(cell.text));
    }
    return *value;
  }

  std::string file_;
  std::vector<Column> columns_ = {};
  std::vector<TileReading> readings_ = {};
};

}  // namespace

std::vector<TileReading> load_tile_readings(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  TileReadingsReader reader(file.string());
  for_each_csv_row(text,
                   [&](const std::vector<CsvCell>& cells, int line) { reader.row(cells, line); });
  return reader.finish();
}

}  // namespace gonio
