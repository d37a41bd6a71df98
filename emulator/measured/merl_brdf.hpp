#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "emulator/measured/brdf_file.hpp"

namespace gonio {

/// Whether a file is one of MERL: it begins with 90, 90, 180, or with other three counts that its
/// size agrees with.
/// @param head  its first bytes, 12 or more if it has them.
[[nodiscard]] bool is_merl(std::span<const std::byte> head, std::uintmax_t file_size);

/// Reads an isotropic BRDF of the MERL database: R, G, B over half and difference angles,
/// interpolated linearly in each of them. Negative numbers there mean "not measured" and are filled
/// in from their neighbours, with a warning.
/// @throws InputError  with the byte offset, for anything that is not as the format says.
/// @see W. Matusik, H. Pfister, M. Brand, L. McMillan, "A data-driven reflectance model", ACM
///      Transactions on Graphics 22 (2003)
[[nodiscard]] BrdfFile read_merl(const std::filesystem::path& path);

/// The same from the bytes of a file.
/// @param file  its name, for messages.
[[nodiscard]] BrdfFile parse_merl(std::span<const std::byte> bytes, const std::string& file);

}  // namespace gonio
