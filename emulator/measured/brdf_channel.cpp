#include "emulator/measured/brdf_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace gonio {

namespace {

using Band = BrdfChannel::Band;

constexpr std::array<std::pair<Band, std::string_view>, 7> bands{{{Band::luminance, "Luminance"},
                                                                  {Band::red, "R"},
                                                                  {Band::green, "G"},
                                                                  {Band::blue, "B"},
                                                                  {Band::x, "X"},
                                                                  {Band::y, "Y"},
                                                                  {Band::z, "Z"}}};

bool same_but_for_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char left, unsigned char right) {
    return std::tolower(left) == std::tolower(right);
  });
}

}  // namespace

bool comes_before(const BrdfChannel& a, const BrdfChannel& b) {
  if (a.band != b.band || !a.wavelength || !b.wavelength) {
    return a.band < b.band;
  }
  return a.wavelength->nanometres() < b.wavelength->nanometres();
}

std::string channel_name(const BrdfChannel& channel) {
  if (channel.band == Band::wavelength) {
    return fmt::format("{}nm", channel.wavelength.value().nanometres());
  }
  return std::string(
      std::ranges::find(bands, channel.band, &decltype(bands)::value_type::first)->second);
}

std::optional<BrdfChannel> channel_named(std::string_view name) {
  for (const auto& [band, text] : bands) {
    if (same_but_for_case(name, text)) {
      return BrdfChannel{.band = band};
    }
  }
  double value_nm = 0.0;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data(), end, value_nm);
  if (error != std::errc{} || !std::isfinite(value_nm) || value_nm <= 0.0 ||
      !same_but_for_case({rest, end}, "nm")) {
    return std::nullopt;
  }
  return BrdfChannel{.band = Band::wavelength, .wavelength = nanometres(value_nm)};
}

}  // namespace gonio
