#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/goniometry/scan_lobe.hpp"
#include "reports/report_table.hpp"

namespace gonio {

/// A scan and what is told of it.
struct ScanReport {
  std::string sample;  ///< id
  std::string sample_title;
  const ScanPlan& plan;
  const ScanResult& result;
  std::vector<ScanLobe> lobes;
  /// Reflectance into the hemisphere by the integrator, weighted, in the order of lobes; empty if
  /// it was not computed.
  std::vector<double> integrated = {};
};

/// Takes text piece by piece: a large scan is never a text at once.
using TextSink = std::function<void(std::string_view)>;

/// The lobes, in a table for people.
[[nodiscard]] std::string scan_text(const ScanReport& report, bool styled);
/// Schema gonio/scan_result/1, numbers at full precision; positions of the same order as CSV.
void write_scan_json(const ScanReport& report, const TextSink& write);
/// One row for each position, numbers at full precision; how it was done stands in comments.
void write_scan_csv(const ScanReport& report, const TextSink& write);
/// A page of its own: lobes, hemispheres, and spectra as charts.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string scan_page(const ScanReport& report);

/// How the scan was done: what and its value.
struct ScanFact {
  std::string what, value;
};
[[nodiscard]] std::vector<ScanFact> scan_facts(const ScanReport& report);
/// A row for each lobe.
[[nodiscard]] ReportTable scan_table(const ScanReport& report);

}  // namespace gonio
