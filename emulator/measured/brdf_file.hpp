#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

enum class BrdfFormat { rgl, merl, astm, zemax, ddr };

/// As people call it: "RGL", "MERL", "ASTM E1392", "Zemax" or "Integra DDR".
[[nodiscard]] std::string_view brdf_format_name(BrdfFormat format);

/// A measured BRDF from a file.
struct BrdfFile {
  std::filesystem::path file;
  BrdfFormat format;
  std::string description = {};            ///< as the file says
  std::vector<std::string> warnings = {};  ///< what it does not keep to, and was made the best of
  std::shared_ptr<const MeasuredBrdf> brdf;
};

/// What a file is, by its content; its name counts for nothing.
/// @throws InputError  if it is none of them.
[[nodiscard]] BrdfFormat brdf_format(const std::filesystem::path& path);
/// The same by how a file begins, or nothing. @param size  of all of it, in bytes.
[[nodiscard]] std::optional<BrdfFormat> brdf_format_of(std::string_view beginning,
                                                       std::uintmax_t size);

/// Reads a measured BRDF of any format.
/// @throws InputError  for anything that is not as the format says: for text with line and column,
///                     for binary formats with the byte offset in the message. What a header
///                     claims is held against the size of the file before anything is allocated.
[[nodiscard]] BrdfFile load_brdf(const std::filesystem::path& path);

}  // namespace gonio
