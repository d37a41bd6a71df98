#pragma once

#include <complex>
#include <optional>

#include "emulator/core/yaml_map.hpp"
#include "emulator/standard/standard.hpp"

namespace gonio::conformance {

/// What a plane polished artefact is made of.
struct PolishedArtefact {
  std::complex<double> index{1.0, 0.0};    ///< n + ik
  std::optional<double> reflectance = {};  ///< of an ideal mirror, instead of the index
};

/// Reads `{n: 1.5}`, `{n: 0.6, k: 2.6}` or `{reflectance: 1}`.
[[nodiscard]] PolishedArtefact read_polished_artefact(const YamlNode& node);

/// What it reads on the scale of a standard, on the axis of the geometry. Computed here, so that
/// the suite does not judge the emulator by the emulator.
///
///   R_s = |(c - q) / (c + q)|^2,  R_p = R_s |(q - s t) / (q + s t)|^2,  q = sqrt(n^2 - s^2),
///   with c, s, t the cosine, sine and tangent of theta_i;  G = value * R / R_reference.
///
/// @see Fresnel's equations in the form of Azzam and Bashara, Ellipsometry and Polarized Light
[[nodiscard]] double closed_form_gloss(const PolishedArtefact& artefact, Angle theta_i,
                                       const Scale& scale);

}  // namespace gonio::conformance
