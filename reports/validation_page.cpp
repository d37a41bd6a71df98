#include <fmt/format.h>

#include <cmath>

#include "reports/chart_rows.hpp"
#include "reports/page.hpp"
#include "reports/page_charts.hpp"
#include "reports/validation_report.hpp"
#include "reports/validation_tables.hpp"

namespace gonio {

namespace {

SpectralCurve curve(const std::string& title, const WavelengthGrid& grid,
                    const Eigen::ArrayXd& value) {
  const Eigen::ArrayXd& nanometres = grid.nanometres();
  return {.title = title,
          .wavelength_nm = {nanometres.begin(), nanometres.end()},
          .value = {value.begin(), value.end()}};
}

/// Figures 10 to 12: what the virtual instrument records of one material in one geometry.
PageData simulated_figure(Figures& figures, const ValidationMaterial& material,
                          const ValidationGeometry& geometry, const WavelengthGrid& grid) {
  std::vector<SpectralCurve> curves{curve("exact", grid, geometry.exact)};
  for (const SimulatedSpectrum& spectrum : geometry.simulated) {
    curves.push_back(curve(
        fmt::format("{}, {}", model_words(spectrum.model), integrator_words(spectrum.integrator)),
        grid, spectrum.reflectance));
  }
  return curves_figure(
      figures, CurveKind::reflectance,
      fmt::format("{} at {} deg, m = {:g}", material.title, geometry.id, material.rms_slope),
      curves);
}

/// Figure 9: the exact reflectance by all authors, in one geometry.
PageData author_figure(Figures& figures, const ValidationMaterial& material,
                       const MaterialValidation& found, std::size_t g, const WavelengthGrid& grid) {
  std::vector<SpectralCurve> curves;
  for (const ValidationAuthor& author : found.authors) {
    curves.push_back(curve(author.author, grid, author.geometries[g].exact));
  }
  return curves_figure(
      figures, CurveKind::reflectance,
      fmt::format("{} at {} deg: exact reflectance by author of the refractive index",
                  material.title, found.authors.front().geometries[g].id),
      curves);
}

PageData convergence_figure(Figures& figures, const ValidationPlan& plan,
                            const ValidationResult& result) {
  constexpr double percent = 100.0;
  std::vector<Rows> groups;
  std::vector<std::string> keys;
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    for (std::size_t g = 0; g < result.geometries.size(); ++g) {
      Rows rows;
      for (const ConvergencePoint& point : result.materials[m].convergence) {
        const double difference = percent * std::abs(point.difference[g]);
        rows.push_back(
            {3.0 * point.resolution * point.resolution, difference > 0.0 ? difference : gap});
      }
      groups.push_back(rows);
      keys.push_back(fmt::format("{}, {} deg", plan.materials[m].title, result.geometries[g]));
    }
  }
  Chart chart("convergence");
  chart.set("count", double(groups.size())).block("curves", groups);
  return figures.figure(chart,
                        "Error of the patch method by the number of patches on the hemisphere, "
                        "against the aperture integrator",
                        keys);
}

PageData material_data(Figures& figures, const ValidationPlan& plan, const ValidationResult& result,
                       std::size_t m) {
  const ValidationMaterial& material = plan.materials[m];
  PageData data("material", material.title);
  PageList spectra;
  for (const ValidationGeometry& geometry : result.materials[m].authors.front().geometries) {
    spectra.push_back(simulated_figure(figures, material, geometry, result.grid));
  }
  PageList authors;
  for (std::size_t g = 0; g < result.geometries.size(); ++g) {
    authors.push_back(author_figure(figures, material, result.materials[m], g, result.grid));
  }
  data.set("author", result.materials[m].authors.front().author);
  data.set("spectra", PageData(spectra));
  data.set("authors", PageData(authors));
  data.set("table", PageData(PageList{table_data(author_table(plan, result, m))}));
  return data;
}

}  // namespace

std::string validation_page(const ValidationPlan& plan, const ValidationResult& result) {
  Figures figures;
  PageList materials;
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    materials.push_back(material_data(figures, plan, result, m));
  }
  PageData data("heading", plan.title);
  data.set("source", plan.source);
  data.set("method", PageData(text_list(validation_method(plan))));
  data.set("findings", PageData(text_list(validation_findings(plan, result))));
  data.set("printed", PageData(PageList{table_data(printed_table(plan, result))}));
  data.set("materials", PageData(materials));
  data.set("convergence_table", PageData(PageList{table_data(convergence_table(plan, result))}));
  data.set("convergence_figure", PageData(PageList{convergence_figure(figures, plan, result)}));
  set_list(data, "limits", text_list(plan.limits));
  return render_page("validation", plan.title, data);
}

}  // namespace gonio
