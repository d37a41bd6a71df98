#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

#include "emulator/measured/brdf_samples.hpp"

namespace gonio {

// Text as of ASTM E1392 and E2387, as goniometers write it: lines of a key and a value
// (SAMPLE_NAME, MEAS_DATE ...), NUM_POINTS, then VARS with the names of columns, then rows of
// numbers between commas. Angles are in radians, f_r in 1/sr.

/// Reads samples as they stand: angles and f_r unchanged, negative ones too.
/// VARS may name theta_i, phi_i, theta_s, phi_s in any order; phi_i and phi_s may be missing, and
/// then light comes from azimuth pi, and is reflected in the plane of incidence: towards azimuth 0
/// for theta_s > 0. Channels are those of brdf_channel.hpp, or one of any name, a luminance.
/// @throws InputError  for what is not so, among it points that are not as many as NUM_POINTS says.
[[nodiscard]] BrdfSamples read_astm(const std::filesystem::path& path);
/// The same of a text at hand. @param file  stands in messages.
[[nodiscard]] BrdfSamples parse_astm(std::string_view text, const std::string& file);

/// Writes samples such that reading gives every number back to the last bit.
void write_astm(const BrdfSamples& samples, std::ostream& out);
[[nodiscard]] std::string astm_text(const BrdfSamples& samples);

}  // namespace gonio
