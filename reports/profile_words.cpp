#include "reports/profile_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>

#include "reports/measurement_words.hpp"

namespace gonio {

namespace {

std::string degree_words(Angle angle) { return fmt::format("{:g} deg", degrees_for_output(angle)); }

/// Titles by the reason why they are informative.
std::map<std::string, std::vector<std::string>> informative_quantities(
    const ProfileMeasurement& measurement) {
  std::map<std::string, std::vector<std::string>> found;
  for (const ProfileQuantity& quantity : measurement.quantities) {
    if (!quantity.assumption.empty()) {
      found["assuming " + quantity.assumption].push_back(quantity.title);
    } else if (quantity.evidence.is_informative()) {
      found["known from memory alone"].push_back(quantity.title);
    }
  }
  return found;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> profile_facts(const ProfileHeader& header) {
  const ProfileSetup& setup = header.setup;
  const ProfileAssumptions& assumed = header.assumptions;
  return {
      {"Incidence", degree_words(setup.theta_i)},
      {"Receptor elements",
       fmt::format("{} of {} x {}", header.reference.flux.size(), degree_words(setup.step),
                   degree_words(setup.receptor_perpendicular))},
      {"Source slit, assumed",
       fmt::format("{} x {}; no image is sharper", degree_words(setup.source_in_plane),
                   degree_words(setup.source_perpendicular))},
      {"Haze fields of unknown width, assumed", degree_words(assumed.haze_field)},
      {"Receptor of distinctness, assumed", degree_words(assumed.doi_field)},
      {"Focal length before the comb, assumed", fmt::format("{:g} mm", assumed.comb_distance_mm)},
      {"Scale", fmt::format("{}, glass n = {:g}", header.standard.id,
                            header.standard.scale.refractive_index->nominal)}};
}

ReportTable profile_table(const std::vector<ProfileMeasurement>& measurements) {
  ReportTable table{.caption = "Made of the profile",
                    .heads = {"quantity", "standard", "evidence", "unit"}};
  for (const ProfileMeasurement& measurement : measurements) {
    table.heads.push_back(">" + measurement.sample);
  }
  if (measurements.empty()) {
    return table;
  }
  for (std::size_t q = 0; q < measurements.front().quantities.size(); ++q) {
    const ProfileQuantity& first = measurements.front().quantities[q];
    std::vector<ReportCell> row{first.title, first.standard, first.evidence.level, first.unit};
    for (const ProfileMeasurement& measurement : measurements) {
      const auto& value = measurement.quantities.at(q).value;
      row.emplace_back(value ? fixed_text(*value, 2) : std::string("-"));
    }
    table.rows.push_back(row);
  }
  return table;
}

std::vector<std::string> profile_notes(const std::vector<ProfileMeasurement>& measurements) {
  std::vector<std::string> notes;
  for (const ProfileMeasurement& measurement : measurements) {
    for (const ProfileQuantity& quantity : measurement.quantities) {
      if (!quantity.value) {
        notes.push_back(
            fmt::format("{}: no {}: {}", measurement.sample, quantity.title, quantity.missing));
      }
    }
  }
  if (!measurements.empty()) {
    for (const auto& [reason, titles] : informative_quantities(measurements.front())) {
      notes.push_back(fmt::format("informative, {}: {}", reason, fmt::join(titles, "; ")));
    }
  }
  return notes;
}

Eigen::ArrayXd profile_angles(const Profile& profile) {
  const Eigen::Index n = profile.flux.size();
  return (0.5 * (profile.edge_rad.head(n) + profile.edge_rad.tail(n))).unaryExpr([](double angle) {
    // The last bits, of the middle one too, and its sign, say nothing.
    constexpr double per_degree = 1e9;
    return std::round(radians(angle).degrees() * per_degree) / per_degree + 0.0;
  });
}

Eigen::ArrayXd profile_density(const Profile& profile, const Profile& reference) {
  const Eigen::Index n = profile.flux.size();
  const Eigen::ArrayXd width =
      (profile.edge_rad.tail(n) - profile.edge_rad.head(n)) * radians(1.0).degrees();
  return 100.0 / reference.flux.sum() * profile.flux / width;
}

}  // namespace gonio
