#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/surface/coating.hpp"
#include "emulator/surface/panel_layout.hpp"
#include "emulator/surface/sample.hpp"
#include "emulator/surface/sample_deviation.hpp"

namespace gonio {

struct PanelStatement;

/// All samples that one file describes when its parameters vary. The file and what it names are
/// read once; samples may then be made from several threads at once.
class SampleFamily {
 public:
  /// Reads a file of schema gonio/sample/1.
  /// @param grid  the wavelengths of the measurement; every spectrum of the sample must cover it.
  /// @throws InputError  for anything that is not as the schema says.
  [[nodiscard]] static SampleFamily load(const std::filesystem::path& path,
                                         const WavelengthGrid& grid);

  /// The sample of the file is the one without deviation. All regions deviate alike, besides what
  /// maps say.
  /// @throws std::domain_error  if the deviation leaves the range of a model, or is NaN.
  [[nodiscard]] Sample sample(const SampleDeviation& deviation = {}) const;

  /// Of the regions of the file; 1 for a homogeneous sample.
  [[nodiscard]] std::size_t regions() const { return coatings_.size(); }
  /// The surface of one region, without what maps say.
  /// @throws std::domain_error  as sample().
  /// @throws std::out_of_range  if there is no such region.
  [[nodiscard]] Surface surface(std::size_t region, const SampleDeviation& deviation = {}) const;

  /// What lies where; null if the file states no panel.
  [[nodiscard]] const PanelLayout* layout() const { return layout_.get(); }

  /// Whether a deviation of this parameter changes any region.
  [[nodiscard]] bool has(SampleParameter parameter) const;

 private:
  SampleFamily(Sample without_surface, PanelStatement statement);

  Sample plain_;  // all of the sample but its surface
  std::vector<Coating> coatings_;
  std::shared_ptr<const PanelLayout> layout_;
  std::vector<SpotShare> whole_;  // of the panel; one if there is none
};

}  // namespace gonio
