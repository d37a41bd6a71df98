#pragma once

#include <Eigen/Core>
#include <complex>
#include <filesystem>
#include <functional>

#include "emulator/core/input_error.hpp"
#include "emulator/core/length.hpp"
#include "emulator/core/wavelength_grid.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// The complex refractive index n + ik of a material over wavelength, relative to air;
/// n in (0, 1000], k in [0, 1000]. Tables are linear between their points; nothing is extrapolated.
class RefractiveIndex {
 public:
  /// The same index at every wavelength.
  /// @param n_hat  n + ik, n in (0, 1000], k in [0, 1000].
  /// @throws std::domain_error  if n_hat is outside its range.
  [[nodiscard]] static RefractiveIndex constant(std::complex<double> n_hat);

  /// An unchanged file of the refractiveindex.info database. Of its key DATA all block types are
  /// read: `tabulated n`, `tabulated k`, `tabulated nk` and `formula 1` to `formula 9`. One block
  /// gives n and one may give k, else k is 0; the file covers what both cover. Rows of a table may
  /// stand in any order; rows at the same wavelength, which some measured files have, are averaged.
  /// @throws InputError  for a file that is not of this form, at the line in the file.
  [[nodiscard]] static RefractiveIndex load(const std::filesystem::path& path);

  /// A value in a YAML file: a number, `{n: 0.6, k: 2.6}`, or `{file: ../nk/main/Cu/Johnson.yml}`.
  /// What such a file does not cover is later blamed on the place that names it.
  /// @throws InputError  for anything else.
  [[nodiscard]] static RefractiveIndex read(const YamlNode& node);

  /// n + ik at one wavelength.
  /// @throws InputError  as for sample().
  [[nodiscard]] std::complex<double> at(Wavelength lambda) const;
  /// n + ik on a grid, shape (grid.size()).
  /// @throws InputError  if the data do not cover the grid, or give n or k outside its range on it.
  [[nodiscard]] Eigen::ArrayXcd sample(const WavelengthGrid& grid) const;

  [[nodiscard]] Wavelength first() const { return first_; }  ///< 0 for a constant
  [[nodiscard]] Wavelength last() const { return last_; }    ///< infinite for a constant

 private:
  using Curve = std::function<Eigen::ArrayXd(const WavelengthGrid&)>;

  RefractiveIndex() = default;
  static RefractiveIndex load(const std::filesystem::path& path, const SourceMark& blamed);

  Curve n_;
  Curve k_;
  Wavelength first_;
  Wavelength last_;
  SourceMark mark_;  // what to blame for a wavelength that has no value
};

}  // namespace gonio
