#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"
#include "emulator/core/wavelength_grid.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// A table of numbers from a CSV file: comma separated, a header line of column names if its first
/// cell is not a number, `#` starts a comment line. An empty cell is NaN.
struct CsvTable {
  std::string file;
  std::vector<std::string> columns;  ///< names; "1", "2", ... without a header
  Eigen::ArrayXXd values;            ///< shape (n_rows, n_columns)

  /// @throws InputError  with line and column for a cell that is not a number, a row of another
  ///                     length, or no rows at all.
  [[nodiscard]] static CsvTable load(const std::filesystem::path& path);
  /// @throws InputError  if there is no such column.
  [[nodiscard]] Eigen::ArrayXd column(const std::string& name) const;
};

/// A quantity tabulated over wavelength; linear between its points, nothing outside them.
class SpectralTable {
 public:
  /// @param wavelength_nm  shape (n), in any order, no value twice.
  /// @param value          shape (n).
  /// @param mark           what to blame when a wavelength is not covered.
  /// @throws InputError  for no points, a doubled wavelength, or a value that is not finite.
  SpectralTable(Eigen::ArrayXd wavelength_nm, Eigen::ArrayXd value, SourceMark mark);

  /// A CSV file whose first column is the wavelength in nm. Rows where the value is empty are left
  /// out. Without a column name the file must have one column of values.
  [[nodiscard]] static SpectralTable load(const std::filesystem::path& path,
                                          const std::optional<std::string>& column = {});
  /// `{file: path.csv, column: name}` in a YAML file.
  [[nodiscard]] static SpectralTable load(const YamlNode& node);

  /// @throws InputError  at the mark if the wavelength lies outside the table.
  [[nodiscard]] double at(Wavelength lambda) const;
  /// Values on a grid, shape (grid.size()).
  /// @throws InputError  at the mark if the table does not cover the grid.
  [[nodiscard]] Eigen::ArrayXd sample(const WavelengthGrid& grid) const;

  [[nodiscard]] Wavelength first() const { return nanometres(wavelength_nm_(0)); }
  [[nodiscard]] Wavelength last() const {
    return nanometres(wavelength_nm_(wavelength_nm_.size() - 1));
  }
  [[nodiscard]] const Eigen::ArrayXd& wavelength_nm() const { return wavelength_nm_; }
  [[nodiscard]] const Eigen::ArrayXd& value() const { return value_; }
  [[nodiscard]] const SourceMark& mark() const { return mark_; }

 private:
  Eigen::ArrayXd wavelength_nm_;  // ascending
  Eigen::ArrayXd value_;
  SourceMark mark_;
};

/// @throws InputError  at `mark` unless [first, last] covers the grid.
void expect_coverage(const WavelengthGrid& grid, Wavelength first, Wavelength last,
                     const SourceMark& mark);

}  // namespace gonio
