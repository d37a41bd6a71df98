#include "emulator/surface/measured_coating.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "emulator/measured/brdf_file.hpp"
#include "emulator/surface/channel_spectra.hpp"
#include "emulator/surface/rotated_brdf.hpp"

namespace gonio {

Coating read_measured(YamlMap& map, const WavelengthGrid& grid) {
  const YamlNode file = map.required("file");
  const BrdfFile read = load_brdf(file.file());
  MeasuredTerm term{.brdf = read.brdf, .warnings = read.warnings};
  try {
    term.spectra = channel_spectra(term.brdf->channels(), grid);
  } catch (const std::invalid_argument&) {
    file.fail("a BRDF at wavelengths, of luminance, or of all of R, G, B or X, Y, Z");
  }
  if (const auto rotation = map.optional("rotation")) {
    constexpr double full_turn_deg = 360.0;
    const Angle by = rotation->angle(Range::closed(-full_turn_deg, full_turn_deg));
    term.brdf = std::make_shared<RotatedBrdf>(term.brdf, by);
  }
  const Surface surface{.grid = grid, .measured = {std::move(term)}};
  return {[surface](const SampleDeviation&) { return surface; }, {false, false, false}};
}

}  // namespace gonio
