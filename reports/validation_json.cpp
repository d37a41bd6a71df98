#include <nlohmann/json.hpp>

#include "reports/json_values.hpp"
#include "reports/validation_report.hpp"
#include "reports/validation_tables.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

ordered_json spectrum_json(const SimulatedSpectrum& spectrum) {
  return {{"model", model_words(spectrum.model)},
          {"integrator", integrator_words(spectrum.integrator)},
          {"ratio", spectrum.deviation.ratio},
          {"relative_rmse", spectrum.deviation.relative_rmse},
          {"shape_rmse", spectrum.deviation.shape_rmse},
          {"reflectance", json_of(spectrum.reflectance)}};
}

ordered_json validated_geometry_json(const ValidationGeometry& geometry) {
  ordered_json json{{"id", geometry.id},
                    {"exact", json_of(geometry.exact)},
                    {"matching_slope", json_of(geometry.matching_slope)},
                    {"spectra", ordered_json::array()}};
  for (const SimulatedSpectrum& spectrum : geometry.simulated) {
    json["spectra"].push_back(spectrum_json(spectrum));
  }
  return json;
}

ordered_json material_json(const ValidationMaterial& stated, const MaterialValidation& found,
                           const std::vector<std::string>& geometries) {
  ordered_json json{{"id", stated.id},
                    {"title", stated.title},
                    {"rms_slope", stated.rms_slope},
                    {"printed_percent", stated.printed_percent},
                    {"authors", ordered_json::array()},
                    {"convergence", ordered_json::array()}};
  for (const ValidationAuthor& author : found.authors) {
    ordered_json entry{{"author", author.author}, {"geometries", ordered_json::array()}};
    for (const ValidationGeometry& geometry : author.geometries) {
      entry["geometries"].push_back(validated_geometry_json(geometry));
    }
    json["authors"].push_back(entry);
  }
  for (const ConvergencePoint& point : found.convergence) {
    ordered_json entry{{"patches", 3L * point.resolution * point.resolution}};
    for (std::size_t g = 0; g < geometries.size(); ++g) {
      entry["difference"][geometries[g]] = point.difference[g];
    }
    json["convergence"].push_back(entry);
  }
  return json;
}

}  // namespace

std::string validation_json(const ValidationPlan& plan, const ValidationResult& result) {
  ordered_json json{{"schema", "gonio/validation_result/1"},
                    {"id", plan.id},
                    {"title", plan.title},
                    {"source", plan.source},
                    {"instrument", plan.instrument.id},
                    {"patches", 3L * plan.patches * plan.patches},
                    {"wavelength_nm", json_of(result.grid.nanometres())},
                    {"materials", ordered_json::array()},
                    {"limits", plan.limits}};
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    json["materials"].push_back(
        material_json(plan.materials[m], result.materials[m], result.geometries));
  }
  return json_text(json);
}

}  // namespace gonio
