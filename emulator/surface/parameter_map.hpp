#pragma once

#include <Eigen/Core>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// One number for each place of a panel: a grid stretched over it, whose values stand for the
/// middles of its cells. Between them it is bilinear; beyond the outer ones it keeps their value.
/// The first value of the first row lies at the origin, x runs along the rows.
class ParameterMap {
 public:
  /// @param values  shape (n_rows, n_columns), at least one.
  /// @param length_mm, width_mm  of the panel, > 0.
  ParameterMap(Eigen::ArrayXXd values, double length_mm, double width_mm);

  [[nodiscard]] double at(double x_mm, double y_mm) const;
  [[nodiscard]] double lowest() const { return values_.minCoeff(); }
  [[nodiscard]] double highest() const { return values_.maxCoeff(); }
  /// Of the smaller side of a cell.
  [[nodiscard]] double pitch_mm() const;

 private:
  Eigen::ArrayXXd values_;
  double length_mm_, width_mm_;
};

/// The values of `{file: grid.csv}`, numbers with commas between them and no header, or of
/// `{file: image.png, black: -0.1, white: 0.1}`, a grey image whose values lie between these two.
/// @throws InputError  for anything else, also in the file, at its line and column.
[[nodiscard]] Eigen::ArrayXXd read_map_values(const YamlNode& node);

}  // namespace gonio
