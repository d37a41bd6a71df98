#include "reports/validation_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gonio {

namespace {

constexpr double percent = 100.0;

std::string percent_text(double share) { return fmt::format("{:.2f}", percent * share); }

std::string printed_text(const ValidationMaterial& material, const std::string& geometry) {
  const auto printed = material.printed_percent.find(geometry);
  return printed == material.printed_percent.end() ? "-" : fmt::format("{:.2f}", printed->second);
}

std::string slope_text(const std::optional<double>& slope) {
  return slope ? fmt::format("{:.4f}", *slope) : "none";
}

const SimulatedSpectrum& by_apertures(const ValidationGeometry& geometry, ValidationModel model) {
  for (const SimulatedSpectrum& spectrum : geometry.simulated) {
    if (spectrum.model == model && spectrum.integrator == ValidationIntegrator::aperture) {
      return spectrum;
    }
  }
  throw std::logic_error("a validation without the aperture integrator");
}

long patches_of(int resolution) { return 3L * resolution * resolution; }

}  // namespace

std::string model_words(ValidationModel model) {
  switch (model) {
    case ValidationModel::smooth:
      return "smooth, eq. (17)";
    case ValidationModel::energy_conserving:
      return "energy conserving";
    case ValidationModel::as_printed:
      break;
  }
  return "as printed, eq. (15)";
}

std::string integrator_words(ValidationIntegrator integrator) {
  return integrator == ValidationIntegrator::aperture ? "apertures" : "patches";
}

std::vector<std::string> validation_method(const ValidationPlan& plan) {
  return {
      fmt::format("{}: {}.", plan.instrument.id, plan.instrument.title),
      fmt::format(
          "Reflectance is the flux into the receptor, relative to that of a perfect mirror; "
          "by the aperture integrator, and by {} patches of the hemisphere.",
          patches_of(plan.patches)),
      "Exact is Fresnel's reflectance of a smooth surface at the angle of incidence. A ratio is "
      "that "
      "of means over wavelength; a relative RMSE is the root of the mean squared difference over "
      "the "
      "mean of the exact reflectance, and its shape what is left of it after one factor.",
      "As printed, eq. (15) reflects four times what an energy conserving surface of that "
      "roughness "
      "would. The matching slope is the one at which it reads as much as the exact reflectance."};
}

std::vector<std::string> validation_findings(const ValidationPlan& plan,
                                             const ValidationResult& result) {
  std::vector<std::string> findings;
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    const ValidationMaterial& material = plan.materials[m];
    std::vector<std::string> slopes, ratios;
    for (const ValidationGeometry& geometry : result.materials[m].authors.front().geometries) {
      slopes.push_back(slope_text(geometry.matching_slope));
      ratios.push_back(fmt::format(
          "{:.2f}", by_apertures(geometry, ValidationModel::as_printed).deviation.ratio));
    }
    findings.push_back(fmt::format(
        "{}: at the printed slope {:g} eq. (15) reads {} of the exact reflectance at {} deg; it "
        "reads all of it at the slopes {}.",
        material.title, material.rms_slope, fmt::join(ratios, ", "),
        fmt::join(result.geometries, ", "), fmt::join(slopes, ", ")));
  }
  const int used = plan.patches;
  double worst = 0.0;
  for (const MaterialValidation& material : result.materials) {
    for (const ConvergencePoint& point : material.convergence) {
      for (const double difference : point.difference) {
        worst = point.resolution == used ? std::max(worst, std::abs(difference)) : worst;
      }
    }
  }
  if (std::ranges::count(plan.convergence, used) > 0) {
    findings.push_back(fmt::format("{} patches are wrong by up to {:.1f} % of the reflectance.",
                                   patches_of(used), percent * worst));
  }
  return findings;
}

ReportTable printed_table(const ValidationPlan& plan, const ValidationResult& result) {
  ReportTable table{.caption = "Printed relative RMSE, and ours against the exact reflectance",
                    .heads = {"material", "at / deg", ">printed / %", "model", "by",
                              ">ratio to exact", ">relative RMSE / %", ">shape / %"}};
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    const ValidationMaterial& material = plan.materials[m];
    for (const ValidationGeometry& geometry : result.materials[m].authors.front().geometries) {
      for (const SimulatedSpectrum& spectrum : geometry.simulated) {
        const SpectralDeviation& deviation = spectrum.deviation;
        table.rows.push_back(
            {fmt::format("{}, m = {:g}", material.title, material.rms_slope), geometry.id,
             printed_text(material, geometry.id), model_words(spectrum.model),
             integrator_words(spectrum.integrator), fmt::format("{:.4f}", deviation.ratio),
             percent_text(deviation.relative_rmse), percent_text(deviation.shape_rmse)});
      }
    }
  }
  return table;
}

ReportTable author_table(const ValidationPlan& plan, const ValidationResult& result,
                         std::size_t material) {
  ReportTable table{.caption = fmt::format("{}: what the refractive index changes",
                                           plan.materials[material].title),
                    .heads = {"refractive index", "at / deg", ">exact reflectance, mean",
                              ">as printed, relative RMSE / %",
                              ">energy conserving, relative RMSE / %", ">matching slope"}};
  for (const ValidationAuthor& author : result.materials[material].authors) {
    for (const ValidationGeometry& geometry : author.geometries) {
      table.rows.push_back(
          {author.author, geometry.id, fmt::format("{:.5f}", geometry.exact.mean()),
           percent_text(
               by_apertures(geometry, ValidationModel::as_printed).deviation.relative_rmse),
           percent_text(
               by_apertures(geometry, ValidationModel::energy_conserving).deviation.relative_rmse),
           slope_text(geometry.matching_slope)});
    }
  }
  return table;
}

ReportTable convergence_table(const ValidationPlan& plan, const ValidationResult& result) {
  ReportTable table{.caption =
                        "The patch method against the aperture integrator: mean reflectance, "
                        "difference / %",
                    .heads = {">patches", ">N"}};
  for (const ValidationMaterial& material : plan.materials) {
    for (const std::string& geometry : result.geometries) {
      table.heads.push_back(fmt::format(">{}, {}", material.id, geometry));
    }
  }
  for (std::size_t i = 0; i < plan.convergence.size(); ++i) {
    const int resolution = plan.convergence[i];
    std::vector<ReportCell> row{fmt::format("{}", patches_of(resolution)),
                                fmt::format("{}", resolution)};
    for (const MaterialValidation& material : result.materials) {
      for (const double difference : material.convergence.at(i).difference) {
        row.emplace_back(std::isnan(difference) ? "no patch"
                                                : fmt::format("{:+.3f}", percent * difference));
      }
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace gonio
