#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/calibration_words.hpp"

namespace gonio {

namespace {

std::string lines(const std::vector<std::string>& sentences) {
  return fmt::format("\n{}\n", fmt::join(sentences, "\n"));
}

}  // namespace

std::string calibration_text(const CalibrationReport& report, bool styled) {
  std::string text = heading_text(fmt::format("Calibration of {}", report.instrument), styled) +
                     fmt::format("{}\nrelative to {}\n", fmt::join(report.measured, "\n"),
                                 reference_words(report.reference));
  if (report.grid) {
    text += table_text(grid_table(*report.grid), styled);
    text += table_text(subdivision_table(findings_of(*report.grid)), styled);
    text += lines(grid_sentences(*report.grid));
  }
  if (report.fit) {
    text += table_text(parameter_table(*report.fit), styled);
    text += table_text(spectrum_table(*report.fit), styled);
    text += lines(fit_sentences(report));
  }
  return text;
}

}  // namespace gonio
