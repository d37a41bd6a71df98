#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/core/length.hpp"

namespace gonio {

/// What one number of a measured BRDF is of: a wavelength, or a band.
struct BrdfChannel {
  enum class Band { wavelength, luminance, red, green, blue, x, y, z };

  Band band = Band::luminance;
  std::optional<Wavelength> wavelength = {};  ///< of Band::wavelength

  bool operator==(const BrdfChannel& other) const = default;
};

/// The order of channels in a MeasuredBrdf: red, green, blue; X, Y, Z; ascending wavelengths.
[[nodiscard]] bool comes_before(const BrdfChannel& a, const BrdfChannel& b);

/// "550nm" for a wavelength, else "Luminance", "R", "G", "B", "X", "Y" or "Z".
[[nodiscard]] std::string channel_name(const BrdfChannel& channel);
/// The channel of such a name, in any case; nothing if it is none.
[[nodiscard]] std::optional<BrdfChannel> channel_named(std::string_view name);

}  // namespace gonio
