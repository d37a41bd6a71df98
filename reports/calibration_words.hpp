#pragma once

#include <string>
#include <vector>

#include "reports/calibration_report.hpp"
#include "reports/report_table.hpp"

// A calibration in words, the same on a terminal and on a page.

namespace gonio {

[[nodiscard]] std::string reference_words(MirrorReference reference);

[[nodiscard]] ReportTable grid_table(const SetupGrid& grid);
[[nodiscard]] ReportTable subdivision_table(const GridFindings& findings);
[[nodiscard]] std::vector<std::string> grid_sentences(const SetupGrid& grid);

[[nodiscard]] ReportTable parameter_table(const SetupCalibration& fit);
[[nodiscard]] ReportTable spectrum_table(const SetupCalibration& fit);
[[nodiscard]] std::vector<std::string> fit_sentences(const CalibrationReport& report);

}  // namespace gonio
