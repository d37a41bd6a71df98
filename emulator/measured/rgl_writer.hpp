#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// How finely a BRDF is written as a tensor file of the RGL.
struct RglOptions {
  std::string description = {};
  /// Polar angles of incidence, ascending from 0, at most 90 deg; empty: every 5 deg, from 45 deg
  /// on every 2.5 deg, up to where the source was measured.
  std::vector<Angle> theta_i = {};
  /// Azimuths of incidence from -180 to 180 deg, ascending, both ends included; empty: isotropic.
  std::vector<Angle> phi_i = {};
  int size = 64;  ///< of the grids of half directions that hold the values, 8 to 1024
};

/// Writes a BRDF so that read_rgl() and the RGL's own reader read it: as rgb (from R, G, B, from
/// X, Y, Z of IEC 61966-2-1, or from Luminance for all three) or as spectra. All incidences share
/// one warp of the half directions, which puts half of the grid where the BRDF changes fastest, so
/// that incidences between those written are interpolated at the same half direction.
/// @throws std::invalid_argument  if the options are not as said above.
/// @throws std::system_error      if the file cannot be written.
void write_rgl(const std::filesystem::path& path, const MeasuredBrdf& source,
               const RglOptions& options = {});

}  // namespace gonio
