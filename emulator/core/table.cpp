#include "emulator/core/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "emulator/core/csv_cell.hpp"
#include "emulator/core/text_file.hpp"

namespace gonio {

namespace {

/// Wavelengths closer than this are the same: a grid built by steps may miss an end by rounding.
constexpr double same_wavelength_nm = 1e-6;

/// Collects rows of cells.
class CsvReader {
 public:
  explicit CsvReader(const std::string& file) { table_.file = file; }

  void row(const std::vector<CsvCell>& cells, int number) {
    if (table_.columns.empty() && header(cells, number)) {
      return;
    }
    if (cells.size() != table_.columns.size()) {
      throw InputError(place(number, 1), fmt::format("{} cells", table_.columns.size()),
                       fmt::format("{} cells", cells.size()));
    }
    for (const CsvCell& cell : cells) {
      cells_.push_back(number_in(cell, number));
    }
  }

  CsvTable finish() {
    const auto columns = Eigen::Index(table_.columns.size());
    if (cells_.empty()) {
      throw InputError(place(0, 0), "rows of numbers", "none");
    }
    using RowMajor = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    table_.values =
        Eigen::Map<const RowMajor>(cells_.data(), Eigen::Index(cells_.size()) / columns, columns);
    return std::move(table_);
  }

 private:
  [[nodiscard]] SourceMark place(int line, int column) const {
    return {.file = table_.file, .line = line, .column = column, .key = {}};
  }

  /// Takes the names from the first line. @return  whether that line was a header.
  bool header(const std::vector<CsvCell>& cells, int line) {
    const CsvCell& first = cells.front();
    const bool named = !parse_quantity(first.text, Dimension::number);
    if (named && first.text.find_first_of("+-.0123456789") == 0) {
      throw InputError(place(line, first.column), "a number or the name of a column",
                       std::string(first.text));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      table_.columns.push_back(named ? std::string(cells[i].text) : std::to_string(i + 1));
    }
    return named;
  }

  [[nodiscard]] double number_in(const CsvCell& cell, int line) const {
    if (cell.text.empty()) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const auto value = parse_quantity(cell.text, Dimension::number);
    if (!value) {
      throw InputError(place(line, cell.column), "a number", std::string(cell.text));
    }
    return *value;
  }

  CsvTable table_;
  std::vector<double> cells_;
};

}  // namespace

CsvTable CsvTable::load(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  CsvReader reader(path.string());
  for_each_csv_row(text,
                   [&](const std::vector<CsvCell>& cells, int line) { reader.row(cells, line); });
  return reader.finish();
}

Eigen::ArrayXd CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) {
    throw InputError({.file = file, .line = 0, .column = 0, .key = {}},
                     fmt::format("one of the columns {}", fmt::join(columns, ", ")), name);
  }
  return values.col(found - columns.begin());
}

SpectralTable::SpectralTable(Eigen::ArrayXd wavelength_nm, Eigen::ArrayXd value, SourceMark mark)
    : mark_(std::move(mark)) {
  const Eigen::Index n = wavelength_nm.size();
  if (n == 0 || n != value.size() || !wavelength_nm.isFinite().all() || !value.isFinite().all()) {
    throw InputError(mark_, "finite values over wavelength", n == 0 ? "none" : "others");
  }
  std::vector<Eigen::Index> order(std::size_t(n), 0);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return wavelength_nm(a) < wavelength_nm(b); });
  wavelength_nm_ = wavelength_nm(order);
  value_ = value(order);
  for (Eigen::Index i = 1; i < n; ++i) {
    if (!(wavelength_nm_(i) > wavelength_nm_(i - 1))) {
      throw InputError(mark_, "each wavelength once",
                       fmt::format("{} nm a second time", wavelength_nm_(i)));
    }
  }
}

SpectralTable SpectralTable::load(const std::filesystem::path& path,
                                  const std::optional<std::string>& column) {
  const CsvTable table = CsvTable::load(path);
  const SourceMark mark{.file = path.string(), .line = 0, .column = 0, .key = {}};
  if (!column && table.columns.size() != 2) {
    throw InputError(mark, "a column of wavelengths and one of values, or the name of a column",
                     fmt::format("{} columns", table.columns.size()));
  }
  const Eigen::ArrayXd value = table.column(column.value_or(table.columns.back()));
  std::vector<Eigen::Index> there;
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    if (!std::isnan(value(i))) {
      there.push_back(i);
    }
  }
  return {Eigen::ArrayXd(table.values.col(0)(there)), Eigen::ArrayXd(value(there)), mark};
}

SpectralTable SpectralTable::load(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    std::optional<std::string> column;
    const YamlNode file = map.required("file");
    if (const auto name = map.optional("column")) {
      column = name->text();
    }
    SpectralTable table = load(file.file(), column);
    table.mark_ = file.mark();
    return table;
  });
}

double SpectralTable::at(Wavelength lambda) const {
  return sample(WavelengthGrid(lambda, Length(), 1))(0);
}

Eigen::ArrayXd SpectralTable::sample(const WavelengthGrid& grid) const {
  expect_coverage(grid, first(), last(), mark_);
  const double* begin = wavelength_nm_.data();
  const double* end = begin + wavelength_nm_.size();
  return grid.nanometres().unaryExpr([&](double nm) {
    const Eigen::Index above = std::lower_bound(begin, end, nm) - begin;
    if (above == 0 || above == wavelength_nm_.size()) {
      return value_(above == 0 ? 0 : above - 1);
    }
    const double t =
        (nm - wavelength_nm_(above - 1)) / (wavelength_nm_(above) - wavelength_nm_(above - 1));
    return std::lerp(value_(above - 1), value_(above), t);
  });
}

void expect_coverage(const WavelengthGrid& grid, Wavelength first, Wavelength last,
                     const SourceMark& mark) {
  if (grid.first().nanometres() < first.nanometres() - same_wavelength_nm ||
      grid.last().nanometres() > last.nanometres() + same_wavelength_nm) {
    throw InputError(
        mark,
        fmt::format("values from {:g} nm to {:g} nm", grid.first().nanometres(),
                    grid.last().nanometres()),
        fmt::format("values from {:g} nm to {:g} nm", first.nanometres(), last.nanometres()));
  }
}

}  // namespace gonio
