#include "reports/profile_report.hpp"

#include <fmt/format.h>

#include "emulator/core/csv_cell.hpp"
#include "reports/json_values.hpp"
#include "reports/measurement_words.hpp"
#include "reports/profile_words.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

ordered_json quantity_json(const ProfileQuantity& quantity) {
  const auto text = [](const std::string& words) {
    return words.empty() ? ordered_json(nullptr) : ordered_json(words);
  };
  return {{"standard", quantity.standard},           {"id", quantity.id},
          {"value", json_of(quantity.value)},        {"unit", text(quantity.unit)},
          {"evidence", quantity.evidence.level},     {"informative", quantity.is_informative()},
          {"assumption", text(quantity.assumption)}, {"missing", text(quantity.missing)}};
}

ordered_json setup_json(const ProfileHeader& header) {
  const ProfileSetup& setup = header.setup;
  return {{"theta_i_deg", degrees_for_output(setup.theta_i)},
          {"step_deg", degrees_for_output(setup.step)},
          {"source_in_plane_deg", degrees_for_output(setup.source_in_plane)},
          {"source_perpendicular_deg", degrees_for_output(setup.source_perpendicular)},
          {"receptor_perpendicular_deg", degrees_for_output(setup.receptor_perpendicular)},
          {"haze_field_deg", degrees_for_output(header.assumptions.haze_field)},
          {"doi_field_deg", degrees_for_output(header.assumptions.doi_field)},
          {"comb_distance_mm", header.assumptions.comb_distance_mm}};
}

}  // namespace

std::string profile_text(const ProfileHeader& header,
                         const std::vector<ProfileMeasurement>& measurements, bool styled) {
  std::string text = "In-plane profile about the mirror direction\n";
  for (const auto& [name, value] : profile_facts(header)) {
    text += fmt::format("{}: {}\n", name, value);
  }
  text += table_text(profile_table(measurements), styled);
  const std::vector<std::string> notes = profile_notes(measurements);
  text += notes.empty() ? "" : "\n";
  for (const std::string& note : notes) {
    text += note + "\n";
  }
  return text;
}

std::string profile_json(const ProfileHeader& header,
                         const std::vector<ProfileMeasurement>& measurements) {
  ordered_json json{{"schema", "gonio/profile/1"},
                    {"scale", header.standard.id},
                    {"setup", setup_json(header)},
                    {"angle_deg", json_of(profile_angles(header.reference))},
                    {"measurements", ordered_json::array()}};
  for (const ProfileMeasurement& measurement : measurements) {
    ordered_json quantities = ordered_json::array();
    for (const ProfileQuantity& quantity : measurement.quantities) {
      quantities.push_back(quantity_json(quantity));
    }
    json["measurements"].push_back(
        {{"sample", measurement.sample},
         {"quantities", quantities},
         {"gu_per_deg", json_of(profile_density(measurement.profile, header.reference))}});
  }
  return json_text(json);
}

std::string profile_csv(const ProfileHeader& header,
                        const std::vector<ProfileMeasurement>& measurements) {
  std::string text = "# in-plane profile, GU per degree\nangle_deg";
  std::vector<Eigen::ArrayXd> columns;
  for (const ProfileMeasurement& measurement : measurements) {
    text += fmt::format(",{}", csv_cell(measurement.sample));
    columns.push_back(profile_density(measurement.profile, header.reference));
  }
  text += "\n";
  const Eigen::ArrayXd angles = profile_angles(header.reference);
  for (Eigen::Index k = 0; k < angles.size(); ++k) {
    text += fmt::format("{}", angles(k));
    for (const Eigen::ArrayXd& column : columns) {
      text += fmt::format(",{}", column(k));
    }
    text += "\n";
  }
  return text;
}

}  // namespace gonio
