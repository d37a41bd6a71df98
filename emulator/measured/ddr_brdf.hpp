#pragma once

#include <filesystem>
#include <string_view>

#include "emulator/measured/brdf_file.hpp"

namespace gonio {

/// Reads a BRDF in the .ddr format of Integra: degrees about the mirror direction, azimuth 0
/// towards the normal; luminance or intensity, relative to a white Lambertian surface or to a
/// factor kbdf.
///
///   f_r = value kbdf / pi                  Luminance Absolute
///   f_r = value kbdf / cos theta_r         Intensity Absolute
///   integral of f_r cos theta_r = kbdf     Relative
///
/// @throws InputError  for what is not so.
[[nodiscard]] BrdfFile read_ddr(const std::filesystem::path& path);
/// The same of a text at hand.
[[nodiscard]] BrdfFile parse_ddr(std::string_view text, const std::filesystem::path& file);

}  // namespace gonio
