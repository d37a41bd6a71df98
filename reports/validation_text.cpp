#include <fmt/format.h>

#include <iterator>

#include "emulator/core/csv_cell.hpp"
#include "reports/validation_report.hpp"
#include "reports/validation_tables.hpp"

namespace gonio {

std::string validation_text(const ValidationPlan& plan, const ValidationResult& result,
                            bool styled) {
  std::string text = fmt::format("{}{}\n\n", heading_text(plan.title, styled), plan.source);
  for (const std::string& sentence : validation_method(plan)) {
    text += fmt::format("{}\n", sentence);
  }
  text += fmt::format("\n{}", table_text(printed_table(plan, result), styled));
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    text += fmt::format("\n{}", table_text(author_table(plan, result, m), styled));
  }
  text += fmt::format("\n{}", table_text(convergence_table(plan, result), styled));
  text += fmt::format("\n{}", heading_text("What the figures say", styled));
  for (const std::string& finding : validation_findings(plan, result)) {
    text += fmt::format("- {}\n", finding);
  }
  text += fmt::format("\n{}", heading_text("What can be compared and what cannot", styled));
  for (const std::string& limit : plan.limits) {
    text += fmt::format("- {}\n", limit);
  }
  return text;
}

std::string validation_csv(const ValidationPlan& plan, const ValidationResult& result) {
  std::string text =
      "material,rms_slope,author,geometry,printed_percent,model,integrator,ratio,relative_rmse,"
      "shape_rmse\n";
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    const ValidationMaterial& material = plan.materials[m];
    for (const ValidationAuthor& author : result.materials[m].authors) {
      for (const ValidationGeometry& geometry : author.geometries) {
        const auto printed = material.printed_percent.find(geometry.id);
        for (const SimulatedSpectrum& spectrum : geometry.simulated) {
          fmt::format_to(
              std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{}\n", csv_cell(material.id),
              material.rms_slope, csv_cell(author.author), csv_cell(geometry.id),
              printed == material.printed_percent.end() ? "" : fmt::format("{}", printed->second),
              csv_cell(model_words(spectrum.model)), integrator_words(spectrum.integrator),
              spectrum.deviation.ratio, spectrum.deviation.relative_rmse,
              spectrum.deviation.shape_rmse);
        }
      }
    }
  }
  return text;
}

}  // namespace gonio
