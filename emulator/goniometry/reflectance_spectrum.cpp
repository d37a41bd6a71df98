#include "emulator/goniometry/reflectance_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "emulator/core/csv_cell.hpp"
#include "emulator/core/quantity.hpp"
#include "emulator/core/text_file.hpp"

namespace gonio {

namespace {

constexpr std::string_view wavelength_column = "wavelength_nm";
constexpr std::string_view uncertainty_prefix = "u_";

Eigen::ArrayXd array_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), Eigen::Index(values.size()));
}

/// Collects spectra row by row.
class SpectraReader {
 public:
  explicit SpectraReader(std::string file) : file_(std::move(file)) {}

  void row(const std::vector<CsvCell>& cells, int line) {
    if (names_.empty()) {
      header(cells, line);
      return;
    }
    if (cells.size() != names_.size()) {
      throw InputError(mark(line, cells.back().column), fmt::format("{} cells", names_.size()),
                       fmt::format("{} cells", cells.size()));
    }
    take_wavelength(cells[wavelength_], line);
    for (Columns& columns : geometries_) {
      take(columns, cells, line);
    }
  }

  std::vector<ReflectanceSpectrum> finish() {
    if (names_.empty() || last_wavelength_ == 0.0) {
      throw InputError(mark(0, 0), names_.empty() ? "a header and a spectrum" : "a spectrum",
                       "none");
    }
    std::vector<ReflectanceSpectrum> spectra;
    for (const Columns& columns : geometries_) {
      if (columns.wavelength_nm.empty()) {
        throw InputError(columns.mark, "a value at one wavelength at least", "none");
      }
      spectra.push_back({.geometry = names_[columns.value],
                         .wavelength_nm = array_of(columns.wavelength_nm),
                         .reflectance = array_of(columns.reflectance),
                         .u = array_of(columns.u),
                         .mark = columns.mark});
    }
    return spectra;
  }

 private:
  /// Where the values of one geometry stand, and what has been read of them.
  struct Columns {
    std::size_t value = 0;
    std::optional<std::size_t> uncertainty = {};
    SourceMark mark = {};
    std::vector<double> wavelength_nm = {}, reflectance = {}, u = {};
  };

  [[nodiscard]] SourceMark mark(int line, int column, std::string key = "") const {
    return {.file = file_, .line = line, .column = column, .key = std::move(key)};
  }

  void header(const std::vector<CsvCell>& cells, int line) {
    for (const CsvCell& cell : cells) {
      const std::string name(cell.text);
      if (name.empty()) {
        throw InputError(mark(line, cell.column), "the name of a column", "nothing");
      }
      if (std::ranges::find(names_, name) != names_.end()) {
        throw InputError(mark(line, cell.column), "each column once", name + " a second time");
      }
      names_.push_back(name);
    }
    const auto found = std::ranges::find(names_, wavelength_column);
    if (found == names_.end()) {
      throw InputError(mark(line, 1), fmt::format("a column {}", wavelength_column),
                       names_.front());
    }
    wavelength_ = std::size_t(found - names_.begin());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i != wavelength_ && !names_[i].starts_with(uncertainty_prefix)) {
        geometries_.push_back({.value = i, .mark = mark(line, cells[i].column, names_[i])});
      }
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (names_[i].starts_with(uncertainty_prefix)) {
        assign_uncertainty(i, mark(line, cells[i].column));
      }
    }
    if (geometries_.empty()) {
      throw InputError(mark(line, 1), "a column of a geometry", "none");
    }
  }

  void assign_uncertainty(std::size_t column, const SourceMark& place) {
    const std::string geometry = names_[column].substr(uncertainty_prefix.size());
    const auto found = std::ranges::find_if(
        geometries_, [&](const Columns& columns) { return names_[columns.value] == geometry; });
    if (found == geometries_.end()) {
      throw InputError(place, "an uncertainty of a geometry that has a column", names_[column]);
    }
    found->uncertainty = column;
  }

  [[nodiscard]] double number(const CsvCell& cell, int line, std::size_t column,
                              const Range& range) const {
    const auto value = parse_quantity(cell.text, Dimension::number);
    if (!value || !range.contains(*value)) {
      throw InputError(mark(line, cell.column, names_[column]), "a number" + range.text(),
                       cell.text.empty() ? "nothing" : std::string(cell.text));
    }
    return *value;
  }

  void take_wavelength(const CsvCell& cell, int line) {
    const double lambda = number(cell, line, wavelength_, Range::positive());
    if (lambda <= last_wavelength_) {
      throw InputError(mark(line, cell.column, names_[wavelength_]),
                       fmt::format("more than the wavelength before, {}", last_wavelength_),
                       std::string(cell.text));
    }
    last_wavelength_ = lambda;
  }

  void take(Columns& columns, const std::vector<CsvCell>& cells, int line) const {
    const CsvCell& value = cells[columns.value];
    if (value.text.empty()) {
      return;
    }
    columns.wavelength_nm.push_back(last_wavelength_);
    columns.reflectance.push_back(number(value, line, columns.value, Range::any()));
    if (columns.uncertainty) {
      columns.u.push_back(
          number(cells[*columns.uncertainty], line, *columns.uncertainty, Range::positive()));
    }
  }

  std::string file_;
  std::vector<std::string> names_ = {};
  std::size_t wavelength_ = 0;
  double last_wavelength_ = 0.0;
  std::vector<Columns> geometries_ = {};
};

/// Where a spectrum has a value at that wavelength; its size if it has none.
Eigen::Index place_of(const ReflectanceSpectrum& spectrum, double lambda) {
  const auto& wavelengths = spectrum.wavelength_nm;
  const auto found = std::lower_bound(wavelengths.begin(), wavelengths.end(), lambda);
  return found != wavelengths.end() && *found == lambda ? found - wavelengths.begin()
                                                        : wavelengths.size();
}

void append_cells(std::string& text, const ReflectanceSpectrum& spectrum, double lambda) {
  const Eigen::Index j = place_of(spectrum, lambda);
  const bool has_value = j < spectrum.wavelength_nm.size();
  text += has_value ? fmt::format(",{}", spectrum.reflectance(j)) : ",";
  if (spectrum.u.size() > 0) {
    text += has_value ? fmt::format(",{}", spectrum.u(j)) : ",";
  }
}

}  // namespace

std::vector<ReflectanceSpectrum> load_reflectance_spectra(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  SpectraReader reader(path.string());
  for_each_csv_row(text,
                   [&](const std::vector<CsvCell>& cells, int line) { reader.row(cells, line); });
  return reader.finish();
}

std::string reflectance_spectra_csv(const std::vector<ReflectanceSpectrum>& spectra) {
  std::string text(wavelength_column);
  std::set<double> wavelengths;
  for (const ReflectanceSpectrum& spectrum : spectra) {
    wavelengths.insert(spectrum.wavelength_nm.begin(), spectrum.wavelength_nm.end());
    text += "," + spectrum.geometry;
    if (spectrum.u.size() > 0) {
      text += fmt::format(",{}{}", uncertainty_prefix, spectrum.geometry);
    }
  }
  text += '\n';
  for (const double lambda : wavelengths) {
    fmt::format_to(std::back_inserter(text), "{}", lambda);
    for (const ReflectanceSpectrum& spectrum : spectra) {
      append_cells(text, spectrum, lambda);
    }
    text += '\n';
  }
  return text;
}

}  // namespace gonio
