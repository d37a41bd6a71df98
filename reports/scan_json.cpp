#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/core/unit_value.hpp"
#include "emulator/goniometry/scan_samples.hpp"
#include "reports/json_values.hpp"
#include "reports/scan_report.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

std::vector<double> list_of(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

ordered_json opening_json(const ScanOpening& opening) {
  const bool is_circle = opening.outline == Aperture::Outline::circle;
  return {{"outline", opening.is_collimated() ? "none" : (is_circle ? "circle" : "rectangle")},
          {"in_plane_deg", stated_degrees(opening.in_plane)},
          {"perpendicular_deg", stated_degrees(opening.perpendicular)},
          {"solid_angle_sr", solid_angle(opening)}};
}

ordered_json lobe_json(const ScanReport& report, std::size_t k) {
  const ScanLobe& lobe = report.lobes[k];
  const ScanPosition& peak = report.result.positions[std::size_t(lobe.peak)];
  ordered_json json{{"theta_i_deg", stated_degrees(lobe.theta_i)},
                    {"rotation_deg", stated_degrees(lobe.rotation)},
                    {"peak",
                     {{"theta_r_deg", stated_degrees(peak.theta_r)},
                      {"phi_r_deg", stated_degrees(peak.phi_r)},
                      {"from_mirror_deg", lobe.from_mirror.degrees()},
                      {"f_r", report.result.weighted(lobe.peak)}}},
                    {"reflectance", nullptr},
                    {"integrated_reflectance", nullptr}};
  if (lobe.hemispherical) {
    json["reflectance"] = list_of(*lobe.hemispherical);
  }
  if (!report.integrated.empty()) {
    json["integrated_reflectance"] = report.integrated[k];
  }
  return json;
}

ordered_json position_json(const ScanResult& result, Eigen::Index p) {
  const ScanPosition& at = result.positions[std::size_t(p)];
  const PositionState state = result.state[std::size_t(p)];
  ordered_json json{{"theta_i_deg", stated_degrees(at.theta_i)},
                    {"rotation_deg", stated_degrees(at.rotation)},
                    {"theta_r_deg", stated_degrees(at.theta_r)},
                    {"phi_r_deg", stated_degrees(at.phi_r)},
                    {"state", state == PositionState::measured     ? "measured"
                              : state == PositionState::reciprocal ? "reciprocal"
                                                                   : "blocked"},
                    {"omega_r_sr", result.omega_r(p)}};
  if (state != PositionState::blocked) {
    json["f_r_weighted"] = result.weighted(p);
    json["error"] = result.error(p);
    json["f_r"] = list_of(result.f_r.col(p));
    json["flux"] = list_of(result.flux(p));
  }
  return json;
}

ordered_json head_json(const ScanReport& report) {
  const ScanPlan& plan = report.plan;
  ordered_json json{
      {"schema", "gonio/scan_result/1"},
      {"sample", report.sample},
      {"sample_title", report.sample_title},
      {"scan", plan.id},
      {"scan_title", plan.title},
      {"source_aperture", opening_json(plan.source)},
      {"receptor_aperture", opening_json(plan.receptor)},
      {"instrument", plan.instrument ? ordered_json(*plan.instrument) : ordered_json(nullptr)},
      {"source_spectrum", plan.spectrum.empty() ? "D65" : plan.spectrum.filename().string()},
      {"integrator", integrator_words(plan)},
      {"tolerance", plan.tolerance},
      {"missed_tolerance", report.result.missed},
      {"heads_apart_deg", stated_degrees(plan.heads_apart)},
      {"isotropic", report.result.is_isotropic},
      {"evaluations", report.result.evaluations},
      {"weighted_by", report.result.light.by_luminance ? "source times V(lambda)" : "source"},
      {"wavelength_nm", list_of(plan.grid.nanometres())},
      {"incident_flux", list_of(report.result.light.source)},
      {"lobes", ordered_json::array()}};
  for (std::size_t k = 0; k < report.lobes.size(); ++k) {
    json["lobes"].push_back(lobe_json(report, k));
  }
  return json;
}

std::string dumped(const ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

/// Positions are written a line each: of a large scan they do not stand in memory as JSON.
void write_scan_json(const ScanReport& report, const TextSink& write) {
  std::string head = dumped(head_json(report), 1);
  head.erase(head.find_last_not_of("\n}") + 1);
  write(head + ",\n \"positions\": [\n");
  for (Eigen::Index p = 0; p < report.result.size(); ++p) {
    write(fmt::format("  {}{}\n", dumped(position_json(report.result, p), -1),
                      p + 1 < report.result.size() ? "," : ""));
  }
  write(" ]\n}\n");
}

}  // namespace gonio
