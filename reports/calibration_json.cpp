#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/core/unit_value.hpp"
#include "reports/calibration_words.hpp"
#include "reports/json_values.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

ordered_json row_json(const GridRow& row) {
  return {{"angle_offset_deg", stated_degrees(row.angle_offset)},
          {"source_deg", stated_degrees(row.source)},
          {"receptor_deg", stated_degrees(row.receptor)},
          {"integrator", row.patches ? "patches" : "aperture"},
          {"patches", row.patches ? ordered_json(*row.patches) : ordered_json(nullptr)},
          {"rmse", row.rmse},
          {"relative_rmse", row.relative_rmse}};
}

ordered_json grid_json(const SetupGrid& grid) {
  const GridFindings found = findings_of(grid);
  ordered_json json{{"as_built", row_json(grid.as_built)},
                    {"best", row_json(grid.best())},
                    {"best_by_aperture", row_json(grid.best(std::nullopt))},
                    {"smallest_rmse_receptor_at_least_source", found.receptor_at_least_source},
                    {"smallest_rmse_receptor_smaller", found.receptor_smaller},
                    {"as_good_by_aperture", found.as_good}};
  json["enough_patches"] =
      found.enough_patches ? ordered_json(*found.enough_patches) : ordered_json(nullptr);
  for (const GridFindings::BySubdivision& one : found.subdivisions) {
    json["subdivisions"].push_back(
        {{"patches", one.patches ? ordered_json(*one.patches) : ordered_json(nullptr)},
         {"rmse_at_best", one.at_best},
         {"smallest_rmse", one.smallest}});
  }
  json["findings"] = grid_sentences(grid);
  json["rows"] = ordered_json::array();
  for (const GridRow& row : grid.rows) {
    json["rows"].push_back(row_json(row));
  }
  return json;
}

ordered_json parameter_json(const CalibratedParameter& one) {
  return {{"name", one.parameter.name},
          {"unit", one.parameter.unit},
          {"geometries", one.parameter.geometries},
          {"assumed", one.parameter.assumed},
          {"range", one.parameter.range},
          {"start", one.start},
          {"estimate", one.estimate},
          {"u", one.u},
          {"interval_95", {one.low, one.high}},
          {"effect", one.effect},
          {"is_determined", one.is_determined}};
}

ordered_json spectrum_json(const CalibratedSpectrum& one) {
  ordered_json json{{"sample", one.sample},
                    {"geometry", one.measured.geometry},
                    {"rmse_at_start", one.rmse_at_start},
                    {"rmse", one.rmse},
                    {"relative_rmse", one.relative_rmse},
                    {"mirror_share", one.mirror_share},
                    {"wavelength_nm", json_of(one.measured.wavelength_nm)},
                    {"measured", json_of(one.measured.reflectance)}};
  json["u"] = one.measured.u.size() > 0 ? ordered_json(json_of(one.measured.u)) : nullptr;
  json["at_start"] = json_of(one.at_start);
  json["simulated"] = json_of(one.simulated);
  return json;
}

ordered_json fit_json(const CalibrationReport& report) {
  const SetupCalibration& fit = *report.fit;
  ordered_json json{{"has_converged", fit.has_converged},
                    {"is_weighted", fit.is_weighted},
                    {"rmse_at_start", fit.rmse_at_start},
                    {"rmse", fit.rmse},
                    {"chi_squared", fit.chi_squared},
                    {"degrees_of_freedom", fit.degrees_of_freedom},
                    {"p_value", fit.p_value},
                    {"u_of_residuals", fit.u_of_residuals},
                    {"region_quantile", fit.region_quantile}};
  for (const CalibratedParameter& one : fit.parameters) {
    json["parameters"].push_back(parameter_json(one));
  }
  for (Eigen::Index i = 0; i < fit.covariance.rows(); ++i) {
    json["covariance"].push_back(json_of(fit.covariance.row(i).transpose().array()));
  }
  for (const RegionAxis& axis : fit.axes) {
    json["region_axes"].push_back({{"direction", axis.direction},
                                   {"growth_low", axis.growth_low},
                                   {"growth_high", axis.growth_high}});
  }
  json["confusions"] = ordered_json::array();
  for (const Confusion& one : fit.confusions) {
    json["confusions"].push_back({{"direction", one.direction}, {"remaining", one.remaining}});
  }
  json["other_setups"] = ordered_json::array();
  for (const OtherSetup& other : report.others) {
    json["other_setups"].push_back(
        {{"estimate", json_of(other.estimate.array())}, {"chi_squared", other.chi_squared}});
  }
  json["findings"] = fit_sentences(report);
  for (const CalibratedSpectrum& one : fit.spectra) {
    json["spectra"].push_back(spectrum_json(one));
  }
  return json;
}

}  // namespace

std::string calibration_json(const CalibrationReport& report) {
  ordered_json json{
      {"schema", "gonio/setup_calibration/1"},
      {"version", report.version},
      {"instrument", report.instrument},
      {"relative_to", report.reference == MirrorReference::source ? "source" : "receptor"},
      {"measured", report.measured}};
  json["grid"] = report.grid ? grid_json(*report.grid) : ordered_json(nullptr);
  json["fit"] = report.fit ? fit_json(report) : ordered_json(nullptr);
  return json_text(json);
}

}  // namespace gonio
