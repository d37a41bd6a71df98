#include <fmt/format.h>

#include <iterator>

#include "emulator/core/csv_cell.hpp"
#include "reports/fit_report.hpp"
#include "reports/fit_tables.hpp"

namespace gonio {

std::string fit_text(const FitReport& report, bool styled) {
  std::string text = heading_text(report.title, styled);
  for (const std::string& sentence : fit_method(report)) {
    text += sentence + "\n";
  }
  for (const RankedFit& ranked : report.comparison.ranking) {
    text += table_text(parameter_table(report.fits[ranked.fit]), styled);
  }
  text += table_text(deviation_table(report), styled);
  if (report.fits.size() > 1) {
    text += table_text(comparison_table(report), styled);
  }
  const auto warnings = fit_warnings(report);
  if (!warnings.empty()) {
    text += heading_text("To be careful about", styled);
  }
  for (const std::string& warning : warnings) {
    text += fmt::format("- {}\n", warning);
  }
  return text;
}

std::string fit_csv(const FitReport& report) {
  const FitObservations& observations = report.observations;
  std::string text = fmt::format(
      "model,group,{},observed,fitted,residual,residual_in_u\n",
      observations.abscissa.starts_with("wavelength") ? "wavelength_nm" : "angle_from_mirror_deg");
  for (const SurfaceFit& fit : report.fits) {
    for (const FitGroup& group : observations.groups) {
      for (Eigen::Index j = 0; j < group.size(); ++j) {
        const Eigen::Index i = group.first + j;
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", fit.model,
                       csv_cell(group.id), group.abscissa(j), observations.observed(i),
                       fit.fitted(i), observations.observed(i) - fit.fitted(i),
                       fit.residual(i) / fit.sigma);
      }
    }
  }
  return text;
}

std::string fit_sample(const FitReport& report) {
  const SurfaceFit& fit = report.fits[report.comparison.ranking.front().fit];
  std::string notes =
      fmt::format("Fitted by gonio fit to {} values of {}.", report.observations.observed.size(),
                  report.observations.quantity);
  for (const FittedParameter& parameter : fit.parameters) {
    notes += fmt::format("\n  {} = {:.6g}{}.", parameter.name, parameter.value,
                         parameter.state == FittedParameter::State::free
                             ? fmt::format(", standard uncertainty {:.2g}", parameter.u)
                             : fmt::format(", {}", state_words(parameter.state)));
  }
  const auto index = std::ranges::find(fit.parameters, index_parameter, &FittedParameter::name);
  return fmt::format(
      "schema: gonio/sample/1\nid: fitted_{}\ntitle: Fitted {} model\nnotes: >-\n  {}\n{}",
      fit.model, fit.model, notes,
      fittable_model(fit.model).yaml(fit.values(), index == fit.parameters.end()
                                                       ? report.index
                                                       : fmt::format("{}", index->value)));
}

}  // namespace gonio
