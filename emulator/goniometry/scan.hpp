#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "emulator/goniometry/scan_plan.hpp"
#include "emulator/integration/flux.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// How what is told of a position became known.
enum class PositionState {
  measured,
  reciprocal,  ///< at the position with source and receptor exchanged
  blocked      ///< not at all: source and receptor would collide
};

/// The light of a scan.
struct ScanLight {
  Eigen::ArrayXd source;       ///< spectral flux onto the sample, of sum 1, shape (n_lambda)
  Eigen::ArrayXd weight = {};  ///< of wavelengths, of sum 1, shape (n_lambda)
  bool by_luminance = true;    ///< weight is the source times V(lambda); else the source alone
};

/// What a goniometer recorded. The BRDF that it reports is a mean over both apertures,
///
///   f_r = Phi_r / (Phi_i Omega_r),  Phi_i = int_source cos i d omega,  Omega_r = int_receptor cos
///   r d omega,
///
/// with the flux Phi_r of eq. (16), for a source of radiance 1. What of an aperture lies below the
/// horizon of the stage is cut.
struct ScanResult {
  std::vector<ScanPosition> positions;
  std::vector<PositionState> state = {};
  Eigen::ArrayXXd f_r = {};  ///< [1/sr], shape (n_lambda, n_positions); NaN where blocked
  /// Of f_r, weighted by wavelength, as the integrator states it [1/sr], shape (n_positions).
  Eigen::ArrayXd error = {};
  Eigen::ArrayXd omega_r = {};  ///< projected solid angle of the receptor [sr], shape (n_positions)
  ScanLight light = {};
  bool is_isotropic = false;    ///< the sample, as it was found
  std::size_t evaluations = 0;  ///< positions integrated
  std::size_t missed = 0;       ///< of them, how many missed the tolerance

  [[nodiscard]] Eigen::Index size() const { return Eigen::Index(positions.size()); }
  /// f_r weighted by wavelength [1/sr].
  [[nodiscard]] double weighted(Eigen::Index position) const {
    return (light.weight * f_r.col(position)).sum();
  }
  /// Spectral flux into the receptor, as a share of all that falls on the sample, shape (n_lambda).
  [[nodiscard]] Eigen::ArrayXd flux(Eigen::Index position) const {
    return light.source * f_r.col(position) * omega_r(position);
  }
};

/// Turning the sample changes nothing: tried on directions all over the hemisphere.
[[nodiscard]] bool is_isotropic(const Surface& surface);
/// f_r is the same if the directions are exchanged: tried in the same way.
[[nodiscard]] bool is_reciprocal(const Surface& surface);

/// The source of a plan on its wavelengths. Where nobody sees them, the source alone is the weight.
/// @throws InputError  for a spectrum that does not cover the wavelengths, or has no power there.
[[nodiscard]] ScanLight scan_light(const ScanPlan& plan, const Catalog& catalog);

/// Scans a sample, on all cores; the result does not depend on their number. Of a panel it sees the
/// mean surface.
/// @param sample   on the wavelengths of the plan.
/// @param advance  called after each position with how many are done, and of how many; from any
///                 thread, one at a time.
/// @throws std::invalid_argument  for more positions than a scan may hold, reciprocity asked for
///                                where it does not hold, a receptor without extent before a smooth
///                                interface, or apertures in which no patch lies.
[[nodiscard]] ScanResult scan(
    const Sample& sample, const ScanPlan& plan, const ScanLight& light,
    const std::function<void(std::size_t done, std::size_t total)>& advance = {});

}  // namespace gonio
