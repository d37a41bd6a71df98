#include <fmt/format.h>

#include <algorithm>

#include "emulator/core/unit_value.hpp"
#include "emulator/goniometry/scan_samples.hpp"
#include "reports/scan_report.hpp"

namespace gonio {

namespace {

std::string wavelength_words(const WavelengthGrid& grid) {
  return fmt::format("{} from {:g} nm to {:g} nm", grid.size(), grid.nanometres()(0),
                     grid.nanometres()(grid.size() - 1));
}

std::string position_words(const ScanResult& result) {
  const auto count = [&](PositionState state) { return std::ranges::count(result.state, state); };
  return fmt::format("{}: {} measured, {} known by reciprocity, {} out of reach", result.size(),
                     count(PositionState::measured), count(PositionState::reciprocal),
                     count(PositionState::blocked));
}

}  // namespace

std::vector<ScanFact> scan_facts(const ScanReport& report) {
  const ScanPlan& plan = report.plan;
  std::vector<ScanFact> facts{
      {"sample", report.sample},
      {"scan", plan.id},
      {"source aperture", opening_words(plan.source)},
      {"receptor aperture", opening_words(plan.receptor)},
      {"receptor solid angle", fmt::format("{:.6g} sr", solid_angle(plan.receptor))}};
  if (plan.instrument) {
    facts.push_back({"apertures of", *plan.instrument});
  }
  facts.push_back(
      {"source spectrum", plan.spectrum.empty() ? "D65" : plan.spectrum.filename().string()});
  facts.push_back({"wavelengths", wavelength_words(plan.grid)});
  facts.push_back(
      {"weighted by", report.result.light.by_luminance ? "source times V(lambda)" : "source"});
  facts.push_back({"integrator", integrator_words(plan)});
  facts.push_back({"tolerance", fmt::format("{:g} of f_r + 0.001 / sr", plan.tolerance)});
  facts.push_back(
      {"heads apart", fmt::format("{:g} deg or more", stated_degrees(plan.heads_apart))});
  facts.push_back({"positions", position_words(report.result)});
  return facts;
}

ReportTable scan_table(const ScanReport& report) {
  ReportTable table{.caption = "Peaks, weighted by wavelength",
                    .heads = {">theta_i / deg", ">rotation / deg", ">peak theta_r / deg",
                              ">phi_r / deg", ">from mirror / deg", ">f_r sr", ">reflectance"}};
  const bool is_integrated = !report.integrated.empty();
  if (is_integrated) {
    table.heads.emplace_back(">integrated");
  }
  for (std::size_t k = 0; k < report.lobes.size(); ++k) {
    const ScanLobe& lobe = report.lobes[k];
    const ScanPosition& peak = report.result.positions[std::size_t(lobe.peak)];
    std::vector<ReportCell> row{
        fmt::format("{:g}", stated_degrees(lobe.theta_i)),
        fmt::format("{:g}", stated_degrees(lobe.rotation)),
        fmt::format("{:g}", stated_degrees(peak.theta_r)),
        fmt::format("{:g}", stated_degrees(peak.phi_r)),
        fmt::format("{:.2f}", lobe.from_mirror.degrees()),
        fmt::format("{:.5g}", report.result.weighted(lobe.peak)),
        lobe.hemispherical
            ? fmt::format("{:.4f}", (report.result.light.weight * *lobe.hemispherical).sum())
            : std::string("-")};
    if (is_integrated) {
      row.emplace_back(fmt::format("{:.4f}", report.integrated[k]));
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace gonio
