#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "emulator/measured/brdf_file.hpp"

namespace gonio {

/// Whether a file begins as a tensor file of the RGL does.
/// @param head  its first bytes, 12 or more if it has them.
[[nodiscard]] bool is_rgl(std::span<const std::byte> head);

/// Reads a material of the database of the Realistic Graphics Lab (EPFL): RGB or spectral,
/// isotropic or anisotropic.
/// @throws InputError  with the byte offset, for anything that is not as the format says.
/// @see J. Dupuy, W. Jakob, "An adaptive parameterization for efficient material acquisition and
///      rendering", ACM Transactions on Graphics 37 (2018), and the reader of the database,
///      rgl-epfl/brdf-loader
[[nodiscard]] BrdfFile read_rgl(const std::filesystem::path& path);

/// The same from the bytes of a file.
/// @param file  its name, for messages.
[[nodiscard]] BrdfFile parse_rgl(std::span<const std::byte> bytes, const std::string& file);

}  // namespace gonio
