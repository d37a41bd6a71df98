#pragma once

#include "reports/page.hpp"
#include "reports/scan_report.hpp"

// The charts of a scan. Of many lobes they show the first.

namespace gonio {

/// Lobes in the plane of measurement; nothing if the receptor was in it at fewer than three places.
[[nodiscard]] PageList in_plane_figures(Figures& figures, const ScanReport& report);
/// A hemisphere for each lobe of which the receptor went round.
[[nodiscard]] PageList hemisphere_figures(Figures& figures, const ScanReport& report);
/// f_r over wavelength at the peaks.
[[nodiscard]] PageList spectrum_figures(Figures& figures, const ScanReport& report);

}  // namespace gonio
