#pragma once

#include <Eigen/Core>
#include <filesystem>

namespace gonio {

/// The grey values of a PNG of 8 or 16 bits, from 0 (black) to 1 (white) as they are stored: gamma
/// and profiles are for eyes. Shape (n_rows, n_columns), the top row first.
/// @throws InputError  for a file that is no such image, is damaged, in colour or transparent, or
///                     has more than 4 million pixels.
[[nodiscard]] Eigen::ArrayXXd load_grey_image(const std::filesystem::path& path);

}  // namespace gonio
