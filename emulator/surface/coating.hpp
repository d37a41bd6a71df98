#pragma once

#include <array>
#include <functional>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/core/yaml_map.hpp"
#include "emulator/surface/sample_deviation.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// A surface of a sample file whose parameters may vary. Cheap to copy; what the file names has
/// been read, so that many surfaces can be made of it, from several threads at once.
class Coating {
 public:
  using Maker = std::function<Surface(const SampleDeviation&)>;
  using Parameters = std::array<bool, sample_parameter_count>;  ///< in the order of SampleParameter

  Coating(Maker make, const Parameters& has) : make_(std::move(make)), has_(has) {}

  /// @throws std::domain_error  if the deviation leaves the range of the model, or is NaN.
  [[nodiscard]] Surface surface(const SampleDeviation& deviation = {}) const;
  /// Whether a deviation of this parameter changes the surface.
  [[nodiscard]] bool has(SampleParameter parameter) const { return has_[std::size_t(parameter)]; }

 private:
  Maker make_;
  Parameters has_;
};

/// Reads `surface:` or `lobes:`, one of which the map must hold.
/// @throws InputError  for anything that is not as the schema of samples says.
[[nodiscard]] Coating read_coating(YamlMap& map, const WavelengthGrid& grid);

}  // namespace gonio
