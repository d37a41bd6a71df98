#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/procedure/certificate.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// How a set-up is certified.
struct CertifyOptions {
  std::vector<std::string> geometries = {};  ///< ids; empty for all
  DecisionRule decision_rule = DecisionRule::guarded;
  double guard_band_factor = 1.0;  ///< of U, >= 0
  std::uint64_t seed = 1;
  std::optional<std::size_t> trials = {};  ///< nothing: until stable
  double tolerance = 1e-5;                 ///< asked of the integrator, in GU
  /// Called with what is done, of what is to do, and of which work; from any thread, one at a time.
  std::function<void(const char* work, std::size_t done, std::size_t total)> advance = {};
};

/// Certifies an instrument against a standard's clauses.
/// @param instrument  as built; its own standard may be another one than that of the clauses, which
///                    is the one that counts then.
/// @param clauses     of a standard with geometries.
/// @param ladder      samples of one wavelength grid.
/// @throws InputError             for an uncertainty that is not stated, correlations that
///                                contradict each other, an aperture of unknown size.
/// @throws std::invalid_argument  for a geometry that the instrument or the standard has not.
[[nodiscard]] Certificate certify(const Instrument& instrument, const ClauseSet& clauses,
                                  const std::vector<Sample>& ladder, const CertifyOptions& options);

}  // namespace gonio
