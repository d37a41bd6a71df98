#include <fmt/format.h>

#include "reports/chart_rows.hpp"
#include "reports/fit_report.hpp"
#include "reports/fit_tables.hpp"
#include "reports/page.hpp"

namespace gonio {

namespace {

bool is_spectrum(const FitReport& report) {
  return report.observations.abscissa.starts_with("wavelength");
}

/// Rows (abscissa, value) of one group.
Rows rows_of(const FitGroup& group, const Eigen::VectorXd& values, bool is_logarithmic) {
  Rows rows;
  for (Eigen::Index j = 0; j < group.size(); ++j) {
    const double value = values(group.first + j);
    rows.push_back({group.abscissa(j), is_logarithmic && !(value > 0.0) ? gap : value});
  }
  return or_gap(rows, 2);
}

AxisSpan span_of(const std::vector<Rows>& groups, std::size_t column) {
  AxisSpan span = nothing_yet();
  for (const Rows& rows : groups) {
    for (const auto& row : rows) {
      span.include(row[column]);
    }
  }
  constexpr double least = 1e-12;
  return finished(span, least);
}

Chart fit_chart(FixedName name, const FitReport& report, const std::vector<Rows>& groups) {
  const AxisSpan x = span_of(groups, 0), y = span_of(groups, 1);
  Chart chart(name);
  chart.set("is_spectrum", is_spectrum(report) ? 1.0 : 0.0);
  chart.set("x_low", x.low).set("x_high", x.high).set("y_low", y.low).set("y_high", y.high);
  chart.set("count", double(report.fits.size())).block("values", groups);
  return chart;
}

/// Figures 11 and 12: what was measured and what the models give, in one geometry.
PageData data_figure(Figures& figures, const FitReport& report, const FitGroup& group) {
  const bool is_logarithmic = !is_spectrum(report);
  std::vector<Rows> groups{rows_of(group, report.observations.observed, is_logarithmic)};
  std::vector<std::string> keys{"observed"};
  for (const SurfaceFit& fit : report.fits) {
    groups.push_back(rows_of(group, fit.fitted, is_logarithmic));
    keys.push_back(fit.model);
  }
  return figures.figure(
      fit_chart("fit_curves", report, groups),
      fmt::format("{} at {} deg: observed and fitted", report.observations.quantity, group.id),
      keys);
}

PageData residual_figure(Figures& figures, const FitReport& report, const FitGroup& group) {
  std::vector<Rows> groups;
  std::vector<std::string> keys;
  for (const SurfaceFit& fit : report.fits) {
    groups.push_back(rows_of(group, fit.residual / fit.sigma, false));
    keys.push_back(fit.model);
  }
  return figures.figure(
      fit_chart("fit_residuals", report, groups),
      fmt::format("Residuals at {} deg, in units of the standard uncertainty", group.id), keys);
}

}  // namespace

std::string fit_page(const FitReport& report) {
  Figures figures;
  PageList data_figures, residual_figures, parameters;
  for (const FitGroup& group : report.observations.groups) {
    data_figures.push_back(data_figure(figures, report, group));
    residual_figures.push_back(residual_figure(figures, report, group));
  }
  for (const RankedFit& ranked : report.comparison.ranking) {
    parameters.push_back(table_data(parameter_table(report.fits[ranked.fit])));
  }
  PageData data("heading", report.title);
  data.set("method", PageData(text_list(fit_method(report))));
  set_list(data, "warnings", text_list(fit_warnings(report)));
  data.set("tables", PageData(PageList{table_data(comparison_table(report)),
                                       table_data(deviation_table(report))}));
  data.set("parameters", PageData(parameters));
  data.set("figures", PageData(data_figures));
  data.set("residuals", PageData(residual_figures));
  return render_page("fit", report.title, data);
}

}  // namespace gonio
