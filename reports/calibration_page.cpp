#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "reports/calibration_words.hpp"
#include "reports/chart_rows.hpp"
#include "reports/page_charts.hpp"

namespace gonio {

namespace {

using Eigen::Index;

std::vector<double> list_of(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

PageData spectrum_figure(Figures& figures, const CalibratedSpectrum& one) {
  const std::vector<double> lambda = list_of(one.measured.wavelength_nm);
  return curves_figure(
      figures, CurveKind::reflectance,
      fmt::format("{}, geometry {}: measured and simulated reflectance relative to the mirror",
                  one.sample, one.measured.geometry),
      {{.title = "measured", .wavelength_nm = lambda, .value = list_of(one.measured.reflectance)},
       {.title = "simulated", .wavelength_nm = lambda, .value = list_of(one.simulated)},
       {.title = "simulated at the start",
        .wavelength_nm = lambda,
        .value = list_of(one.at_start)}});
}

PageData residual_figure(Figures& figures, const SetupCalibration& fit) {
  std::vector<Rows> groups;
  std::vector<std::string> keys;
  AxisSpan x = nothing_yet();
  AxisSpan y{0.0, 0.0};
  for (const CalibratedSpectrum& one : fit.spectra) {
    Rows rows;
    for (Index j = 0; j < one.simulated.size(); ++j) {
      const double u = one.measured.u.size() > 0 ? one.measured.u(j) : fit.u_of_residuals;
      rows.push_back(
          {one.measured.wavelength_nm(j), (one.measured.reflectance(j) - one.simulated(j)) / u});
      x.include(rows.back()[0]);
      y.include(rows.back()[1]);
    }
    groups.push_back(rows);
    keys.push_back(fmt::format("{}, geometry {}", one.sample, one.measured.geometry));
  }
  const AxisSpan x_axis = finished(x, 1.0);
  const AxisSpan y_axis = finished(y, 4.0);
  Chart chart("setup_residuals");
  chart.set("x_low", x_axis.low).set("x_high", x_axis.high);
  chart.set("y_low", y_axis.low).set("y_high", y_axis.high);
  chart.set("count", double(groups.size())).block("residuals", groups);
  return figures.figure(chart, "Residuals, measured minus simulated, in standard uncertainties",
                        keys);
}

/// The smallest RMSE by aperture over the angles, for each pair of sizes.
PageData map_figure(Figures& figures, const SetupGrid& grid) {
  std::map<std::pair<double, double>, double> smallest;
  for (const GridRow& row : grid.rows) {
    if (!row.patches && std::isfinite(row.rmse)) {
      const auto place = std::pair(row.source.degrees(), row.receptor.degrees());
      const auto found = smallest.try_emplace(place, row.rmse).first;
      found->second = std::min(found->second, row.rmse);
    }
  }
  Rows rows;
  AxisSpan x = nothing_yet();
  AxisSpan y = nothing_yet();
  double most = 0.0;
  for (const auto& [place, rmse] : smallest) {
    rows.push_back({place.first, place.second, rmse});
    x.include(place.first);
    y.include(place.second);
    most = std::max(most, rmse);
  }
  const AxisSpan x_axis = finished(x, 0.5);
  const AxisSpan y_axis = finished(y, 0.5);
  Chart chart("rmse_map");
  chart.set("x_low", x_axis.low - 0.3).set("x_high", x_axis.high + 0.3);
  chart.set("y_low", y_axis.low - 0.2).set("y_high", y_axis.high + 0.2);
  chart.set("most", most > 0.0 ? most : 1.0).block("map", {or_gap(rows, 3)});
  return figures.figure(
      chart,
      "RMSE of the grid by aperture over the diameters of source and receptor, each at the angles "
      "that suit it best",
      {});
}

/// The pair of told parameters that goes together most.
std::optional<std::pair<Index, Index>> ellipse_pair(const SetupCalibration& fit) {
  std::optional<std::pair<Index, Index>> pair;
  double most = -1.0;
  for (Index i = 0; i < fit.covariance.rows(); ++i) {
    for (Index j = i + 1; j < fit.covariance.rows(); ++j) {
      const double r =
          std::abs(fit.covariance(i, j)) / std::sqrt(fit.covariance(i, i) * fit.covariance(j, j));
      if (fit.parameters[std::size_t(i)].is_determined &&
          fit.parameters[std::size_t(j)].is_determined && r > most) {
        most = r;
        pair = {i, j};
      }
    }
  }
  return pair;
}

PageData ellipse_figure(Figures& figures, const SetupCalibration& fit,
                        const std::pair<Index, Index>& pair) {
  const auto [i, j] = pair;
  Eigen::Matrix2d part;
  part << fit.covariance(i, i), fit.covariance(i, j), fit.covariance(j, i), fit.covariance(j, j);
  const Eigen::Matrix2d root = part.llt().matrixL();
  const Eigen::Vector2d centre{fit.parameters[std::size_t(i)].estimate,
                               fit.parameters[std::size_t(j)].estimate};
  constexpr int points = 180;
  Rows rows;
  AxisSpan x = nothing_yet();
  AxisSpan y = nothing_yet();
  for (int k = 0; k <= points; ++k) {
    const double angle = 2.0 * std::numbers::pi * double(k) / double(points);
    const Eigen::Vector2d at = centre + std::sqrt(fit.region_quantile) * root *
                                            Eigen::Vector2d(std::cos(angle), std::sin(angle));
    rows.push_back({at.x(), at.y()});
    x.include(at.x());
    y.include(at.y());
  }
  const AxisSpan x_axis = finished(x, 1e-9);
  const AxisSpan y_axis = finished(y, 1e-9);
  Chart chart("confidence_ellipse");
  chart.set("x_low", x_axis.low).set("x_high", x_axis.high);
  chart.set("y_low", y_axis.low).set("y_high", y_axis.high);
  chart.block("ellipse", {rows}).block("estimate", {Rows{{centre.x(), centre.y()}}});
  return figures.figure(
      chart,
      fmt::format("Joint 95 % region of {} (across) and {} (up), whatever the others are",
                  fit.parameters[std::size_t(i)].parameter.name,
                  fit.parameters[std::size_t(j)].parameter.name),
      {"joint 95 % region", "estimate"});
}

PageData grid_data(Figures& figures, const SetupGrid& grid) {
  PageData data;
  PageList tables{table_data(grid_table(grid)), table_data(subdivision_table(findings_of(grid)))};
  data.set("tables", PageData(tables));
  set_list(data, "sentences", text_list(grid_sentences(grid)));
  data.set("figures", PageData(PageList{map_figure(figures, grid)}));
  return data;
}

PageData fit_data(Figures& figures, const CalibrationReport& report) {
  const SetupCalibration& fit = *report.fit;
  PageData data;
  PageList tables{table_data(parameter_table(fit)), table_data(spectrum_table(fit))};
  PageList list;
  for (const CalibratedSpectrum& one : fit.spectra) {
    list.push_back(spectrum_figure(figures, one));
  }
  list.push_back(residual_figure(figures, fit));
  if (const auto pair = ellipse_pair(fit)) {
    list.push_back(ellipse_figure(figures, fit, *pair));
  }
  data.set("tables", PageData(tables));
  set_list(data, "sentences", text_list(fit_sentences(report)));
  data.set("figures", PageData(list));
  return data;
}

}  // namespace

std::string calibration_page(const CalibrationReport& report) {
  Figures figures;
  const std::string title = fmt::format("Calibration of {}", report.instrument);
  PageData data;
  data.set("heading", title);
  data.set("version", report.version);
  data.set("reference", reference_words(report.reference));
  set_list(data, "measured", text_list(report.measured));
  data.set("fit", report.fit ? PageData(PageList{fit_data(figures, report)}) : PageData(false));
  data.set("grid",
           report.grid ? PageData(PageList{grid_data(figures, *report.grid)}) : PageData(false));
  return render_page("calibration", title, data);
}

}  // namespace gonio
