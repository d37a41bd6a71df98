#include "reports/component_words.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace gonio {

std::string component_words(const std::string& name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 22> words{
      {{"theta_i", "angle of incidence"},
       {"theta_r", "angle of the receptor"},
       {"source_in_plane", "source image, in plane"},
       {"source_perpendicular", "source image, perpendicular"},
       {"source_diameter", "source image, diameter"},
       {"receptor_in_plane", "receptor, in plane"},
       {"receptor_perpendicular", "receptor, perpendicular"},
       {"receptor_diameter", "receptor, diameter"},
       {"polarization", "polarization"},
       {"spectrum", "spectral weighting"},
       {"spectral_mismatch", "spectral mismatch"},
       {"reference_index", "index of the reference glass"},
       {"reference_value", "value of the working standard"},
       {"linearity", "linearity"},
       {"zero", "zero and stray light"},
       {"drift", "drift"},
       {"temperature", "temperature"},
       {"resolution", "resolution"},
       {"repeatability", "repeatability"},
       {"image_offset", "centre of the source image"},
       {"tile_contamination", "contamination of the tile"},
       {"all", "all together"}}};
  for (const auto& [known, text] : words) {
    if (known == name) {
      return std::string(text);
    }
  }
  return name;
}

}  // namespace gonio
