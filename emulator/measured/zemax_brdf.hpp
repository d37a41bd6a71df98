#pragma once

#include <filesystem>
#include <string_view>

#include "emulator/measured/brdf_file.hpp"

namespace gonio {

/// Reads a BRDF in the tabular format of Zemax OpticStudio: degrees about the mirror direction,
/// azimuth 0 towards the normal. A TIS that is far from the integral of its table gives a warning.
/// @throws InputError  for what is not so; for a BTDF; for the similar format of LightTools.
[[nodiscard]] BrdfFile read_zemax(const std::filesystem::path& path);
/// The same of a text at hand.
[[nodiscard]] BrdfFile parse_zemax(std::string_view text, const std::filesystem::path& file);

}  // namespace gonio
