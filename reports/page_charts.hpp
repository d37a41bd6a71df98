#pragma once

#include <string>
#include <vector>

#include "emulator/procedure/footprint.hpp"
#include "reports/conformance_report.hpp"
#include "reports/page.hpp"

// The charts that pages share: each with its caption and the names of its curves.

namespace gonio {

[[nodiscard]] PageData footprint_figure(Figures& figures, const Footprint& footprint);

/// A curve over wavelength.
struct SpectralCurve {
  std::string title;
  std::vector<double> wavelength_nm, value;
};
enum class CurveKind { weight, reflectance, radiance_factor };
[[nodiscard]] PageData curves_figure(Figures& figures, CurveKind kind, const std::string& caption,
                                     const std::vector<SpectralCurve>& curves);

/// The largest effect of each quantity, over the samples; the key `samples` has their names.
/// @param effects  all of one geometry.
[[nodiscard]] PageData ladder_figure(Figures& figures,
                                     const std::vector<const SetupEffects*>& effects);

}  // namespace gonio
