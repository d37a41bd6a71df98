#include "emulator/measured/brdf_summary.hpp"

#include <fmt/format.h>

#include "emulator/measured/brdf_reflectance.hpp"

namespace gonio {

BrdfSummary summarize(const BrdfFile& file) {
  BrdfSummary summary{.format = file.format,
                      .file = file.file.string(),
                      .description = file.description,
                      .channels = file.brdf->channels(),
                      .largest_theta = file.brdf->largest_theta(),
                      .rows = {},
                      .warnings = file.warnings};
  constexpr double rounding_deg = 1e-3;
  for (const double theta_deg : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0}) {
    if (theta_deg > 0.0 && theta_deg > summary.largest_theta.degrees() + rounding_deg) {
      break;
    }
    const Angle theta_i = degrees(theta_deg);
    const BrdfSummary::Row& row = summary.rows.emplace_back(
        BrdfSummary::Row{theta_i, file.brdf->step(theta_i),
                         directional_hemispherical_reflectance(*file.brdf, theta_i)});
    constexpr double tolerated = 1.02;  // what errors of measurement make of white
    if (const double most = row.reflectance.maxCoeff(); most > tolerated) {
      summary.warnings.push_back(
          fmt::format("at {} deg it would reflect {:.3g} of the light: a lobe is narrower than the "
                      "step of {:.3g} deg, or the scale is wrong",
                      theta_deg, most, row.step.degrees()));
    }
  }
  return summary;
}

}  // namespace gonio
