#pragma once

#include <string>
#include <vector>

#include "reports/fit_report.hpp"
#include "reports/report_table.hpp"

// What a fit is told in, the same on a terminal and on a page.

namespace gonio {

/// What was done, a sentence each.
[[nodiscard]] std::vector<std::string> fit_method(const FitReport& report);
/// What to be careful about; none if there is nothing.
[[nodiscard]] std::vector<std::string> fit_warnings(const FitReport& report);

/// "free", "fixed", "at its bound" or "open".
[[nodiscard]] std::string state_words(FittedParameter::State state);

/// The models, the best first.
[[nodiscard]] ReportTable comparison_table(const FitReport& report);
/// The parameters of one model.
[[nodiscard]] ReportTable parameter_table(const SurfaceFit& fit);
/// How near all models come to each group of observations.
[[nodiscard]] ReportTable deviation_table(const FitReport& report);

}  // namespace gonio
