#pragma once

#include <string>
#include <vector>

#include "emulator/goniometry/acquisition.hpp"
#include "reports/report_table.hpp"

// An acquisition in words, the same on a terminal and on a page.

namespace gonio {

[[nodiscard]] std::string noise_words(NoiseModel model);
[[nodiscard]] ReportTable acquisition_table(const AcquisitionResult& result);
/// What a reader must know.
[[nodiscard]] std::vector<std::string> acquisition_notes(const AcquisitionResult& result);

}  // namespace gonio
