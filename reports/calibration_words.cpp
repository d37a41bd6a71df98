#include "reports/calibration_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/qa_words.hpp"
#include "reports/uncertain_words.hpp"

namespace gonio {

namespace {

constexpr std::size_t rows_shown = 8;
/// A chance below which a model does not explain its data.
constexpr double small_chance = 1e-3;

std::string patches_text(std::optional<int> patches) {
  return patches ? fmt::format("{} patches", *patches) : "aperture";
}

std::string rmse_text(double rmse) {
  return std::isfinite(rmse) ? fmt::format("{:.6f}", rmse) : "-";
}

std::vector<ReportCell> row_cells(const std::string& name, const GridRow& row) {
  return {
      name,
      fmt::format("{:+.2f}", row.angle_offset.degrees()),
      fmt::format("{:.2f}", row.source.degrees()),
      fmt::format("{:.2f}", row.receptor.degrees()),
      patches_text(row.patches),
      rmse_text(row.rmse),
      std::isfinite(row.relative_rmse) ? fmt::format("{:.3f}", 100.0 * row.relative_rmse) : "-"};
}

/// e.g. "0.71 source_diameter - 0.70 receptor_diameter"; small parts are left out.
std::string direction_words(const Confusion& confusion, const SetupCalibration& fit) {
  constexpr double small = 0.1;
  std::string text;
  for (std::size_t i = 0; i < confusion.direction.size(); ++i) {
    const double part = confusion.direction[i];
    if (std::abs(part) >= small) {
      text += text.empty() ? (part < 0.0 ? "-" : "") : (part < 0.0 ? " - " : " + ");
      text += fmt::format("{:.2f} {}", std::abs(part), fit.parameters[i].parameter.name);
    }
  }
  return text;
}

std::size_t parts_of(const Confusion& confusion) {
  return std::size_t(std::ranges::count_if(confusion.direction,
                                           [](double part) { return std::abs(part) >= 0.1; }));
}

std::string confusion_sentence(const Confusion& confusion, const SetupCalibration& fit) {
  const std::string left =
      fmt::format("{:.0f} % of what was assumed of it is left", 100.0 * confusion.remaining);
  if (parts_of(confusion) == 1) {
    const auto most = std::ranges::max_element(confusion.direction, {},
                                               [](double part) { return std::abs(part); });
    const CalibratedParameter& one =
        fit.parameters[std::size_t(most - confusion.direction.begin())];
    return one.effect < 1.0
               ? fmt::format("{} has no effect on these spectra and stays where it was: {}",
                             one.parameter.name, left)
               : fmt::format("the spectra tell {} badly: {}", one.parameter.name, left);
  }
  return fmt::format("the spectra cannot tell apart {}: of that sum, in ranges, {}",
                     direction_words(confusion, fit), left);
}

std::string growth_sentence(const SetupCalibration& fit) {
  double low = 1.0;
  double high = 1.0;
  for (const RegionAxis& axis : fit.axes) {
    for (const double growth : {axis.growth_low, axis.growth_high}) {
      if (std::isfinite(growth)) {
        low = std::min(low, growth);
        high = std::max(high, growth);
      }
    }
  }
  const bool is_linear = low > 0.8 && high < 1.25;
  return fmt::format(
      "at the ends of its axes chi squared grows by {:.2f} to {:.2f} of what a linear model says: "
      "the region {}",
      low, high, is_linear ? "holds" : "is bent, and only rough");
}

std::string other_sentence(const OtherSetup& other, const SetupCalibration& fit) {
  std::string text;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    text += fmt::format("{}{} {}", i > 0 ? ", " : "", fit.parameters[i].parameter.name,
                        measured_text(other.estimate(Eigen::Index(i)), fit.parameters[i].u));
  }
  return fmt::format("another set-up explains the spectra as well (chi squared {:.1f}): {}",
                     other.chi_squared, text);
}

void add_mirror_sentences(std::vector<std::string>& sentences, const CalibrationReport& report) {
  constexpr double all = 0.9999;
  std::vector<std::string> told;
  for (const CalibratedSpectrum& one : report.fit->spectra) {
    const std::string& geometry = one.measured.geometry;
    if (one.mirror_share < all && report.reference == MirrorReference::source &&
        std::ranges::find(told, geometry) == told.end()) {
      told.push_back(geometry);
      sentences.push_back(fmt::format(
          "{}: the receptor takes {:.2f} % of a mirror's light; spectra that were measured "
          "relative to a mirror in the same set-up need --relative-to receptor",
          geometry, 100.0 * one.mirror_share));
    }
  }
}

}  // namespace

std::string reference_words(MirrorReference reference) {
  return reference == MirrorReference::source
             ? "all light of the source, for which a perfect mirror stands"
             : "what a perfect mirror sends into the same receptor";
}

ReportTable grid_table(const SetupGrid& grid) {
  ReportTable table{.caption = "Set-ups of the grid, the smallest RMSE first",
                    .heads = {"set-up", ">angles deg", ">source deg", ">receptor deg", "integrator",
                              ">RMSE", ">relative %"}};
  table.rows.push_back(row_cells("as built", grid.as_built));
  std::vector<const GridRow*> rows;
  for (const GridRow& row : grid.rows) {
    rows.push_back(&row);
  }
  std::ranges::stable_sort(rows, {}, &GridRow::rmse);
  for (std::size_t i = 0; i < std::min(rows.size(), rows_shown); ++i) {
    table.rows.push_back(row_cells(fmt::format("{}", i + 1), *rows[i]));
  }
  return table;
}

ReportTable subdivision_table(const GridFindings& findings) {
  ReportTable table{.caption = "Subdivision of the hemisphere",
                    .heads = {"integrator", ">RMSE at the set-up best by aperture",
                              ">smallest RMSE of the grid"}};
  for (const GridFindings::BySubdivision& one : findings.subdivisions) {
    table.rows.push_back(
        {patches_text(one.patches), rmse_text(one.at_best), rmse_text(one.smallest)});
  }
  return table;
}

std::vector<std::string> grid_sentences(const SetupGrid& grid) {
  const GridFindings found = findings_of(grid);
  std::vector<std::string> sentences;
  if (std::isfinite(found.receptor_at_least_source) && std::isfinite(found.receptor_smaller)) {
    sentences.push_back(fmt::format(
        "by aperture, the smallest RMSE is {} with a receptor at least as large as the source and "
        "{} with a smaller one{}",
        rmse_text(found.receptor_at_least_source), rmse_text(found.receptor_smaller),
        found.receptor_at_least_source <= found.receptor_smaller
            ? ": the paper's finding holds for these spectra"
            : ": these spectra ask for a smaller receptor"));
  }
  sentences.push_back(fmt::format(
      "{} of the grid by aperture {} within 1 % of the smallest RMSE: the grid does not tell "
      "them apart",
      count_text(found.as_good, "set-up"), found.as_good == 1 ? "is" : "are"));
  if (found.subdivisions.size() > 1) {
    sentences.push_back(
        found.enough_patches
            ? fmt::format("from {} patches on, further subdivision changes the RMSE by less than "
                          "1 %",
                          *found.enough_patches)
            : "with all of these subdivisions the RMSE is still more than 1 % off that by "
              "aperture");
  }
  return sentences;
}

ReportTable parameter_table(const SetupCalibration& fit) {
  ReportTable table{.caption = "Parameters of the set-up",
                    .heads = {"parameter", "unit", ">assumed", ">range", ">estimate", ">u",
                              ">95 % from", ">to", "told by the spectra"}};
  for (const CalibratedParameter& one : fit.parameters) {
    table.rows.push_back(
        {one.parameter.name, one.parameter.unit.empty() ? "1" : one.parameter.unit,
         measured_text(one.parameter.assumed, one.u), fmt::format("{:g}", one.parameter.range),
         measured_text(one.estimate, one.u), uncertainty_text(one.u), measured_text(one.low, one.u),
         measured_text(one.high, one.u), one.is_determined ? "yes" : "no"});
  }
  return table;
}

ReportTable spectrum_table(const SetupCalibration& fit) {
  ReportTable table{.caption = "Spectra",
                    .heads = {"geometry", "sample", ">values", ">mean", ">RMSE at the start",
                              ">RMSE", ">relative %", ">of a mirror's light %"}};
  for (const CalibratedSpectrum& one : fit.spectra) {
    table.rows.push_back(
        {one.measured.geometry, one.sample, fmt::format("{}", one.measured.reflectance.size()),
         fmt::format("{:.6f}", one.measured.reflectance.mean()), rmse_text(one.rmse_at_start),
         rmse_text(one.rmse), fmt::format("{:.3f}", 100.0 * one.relative_rmse),
         fmt::format("{:.2f}", 100.0 * one.mirror_share)});
  }
  return table;
}

std::vector<std::string> fit_sentences(const CalibrationReport& report) {
  const SetupCalibration& fit = *report.fit;
  std::vector<std::string> sentences{fmt::format("RMSE {} at the start, {} at the estimate",
                                                 rmse_text(fit.rmse_at_start),
                                                 rmse_text(fit.rmse))};
  if (fit.is_weighted) {
    sentences.push_back(fmt::format(
        "chi squared {:.1f} with {} degrees of freedom, p {}{}", fit.chi_squared,
        fit.degrees_of_freedom, probability_text(fit.p_value),
        fit.p_value < small_chance ? ": no such set-up explains the spectra within their "
                                     "uncertainty, and the region is too small"
                                   : ""));
  } else {
    sentences.push_back(fmt::format("the spectra state no uncertainty; their residuals say {}",
                                    uncertainty_text(fit.u_of_residuals)));
  }
  if (!fit.has_converged) {
    sentences.emplace_back("the search did not converge");
  }
  sentences.push_back(fmt::format(
      "joint 95 % region: an ellipsoid of squared distance {:.2f} in the covariance of the {}; {}",
      fit.region_quantile, count_text(fit.parameters.size(), "parameter"), growth_sentence(fit)));
  for (const Confusion& confusion : fit.confusions) {
    sentences.push_back(confusion_sentence(confusion, fit));
  }
  if (fit.confusions.empty()) {
    sentences.emplace_back("the spectra tell all of these parameters apart");
  }
  for (const OtherSetup& other : report.others) {
    sentences.push_back(other_sentence(other, fit));
  }
  add_mirror_sentences(sentences, report);
  return sentences;
}

}  // namespace gonio
