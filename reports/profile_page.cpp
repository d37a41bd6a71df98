#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/device_page.hpp"
#include "reports/measurement_words.hpp"
#include "reports/profile_report.hpp"
#include "reports/profile_words.hpp"

namespace gonio {

namespace {

/// So many decades below the highest point are shown.
constexpr double decades = 6.0;

Rows curve_rows(const Profile& profile, const Profile& reference, double floor) {
  const Eigen::ArrayXd angles = profile_angles(profile);
  const Eigen::ArrayXd density = profile_density(profile, reference);
  Rows rows;
  for (Eigen::Index k = 0; k < angles.size(); ++k) {
    rows.push_back({angles(k), std::max(density(k), floor)});
  }
  return rows;
}

/// The fields of the haze rules at this angle, each once: low and high edge, degrees.
Rows field_rows(const ProfileHeader& header) {
  Rows rows;
  for (const ProfileRule& rule : header.rules) {
    const bool is_here = rule.theta_i && degrees_for_output(*rule.theta_i) ==
                                             degrees_for_output(header.setup.theta_i);
    if (rule.kind != ProfileRule::Kind::haze || !is_here) {
      continue;
    }
    for (const ProfileField& field : rule.fields) {
      const double half = 0.5 * field.width.value_or(header.assumptions.haze_field).degrees();
      const std::vector<double> row{field.offset.degrees() - half, field.offset.degrees() + half};
      const bool is_new = std::none_of(rows.begin(), rows.end(), [&](const auto& other) {
        return std::abs(other[0] - row[0]) + std::abs(other[1] - row[1]) < 1e-9;
      });
      if (is_new) {
        rows.push_back(row);
      }
    }
  }
  return rows;
}

PageData profile_figure(Figures& figures, const ProfileHeader& header,
                        const std::vector<ProfileMeasurement>& measurements) {
  double highest = profile_density(header.reference, header.reference).maxCoeff();
  for (const ProfileMeasurement& measurement : measurements) {
    highest = std::max(highest, profile_density(measurement.profile, header.reference).maxCoeff());
  }
  const double floor = highest * std::pow(10.0, -decades);
  std::vector<Rows> groups;
  std::vector<std::string> keys;
  for (const ProfileMeasurement& measurement : measurements) {
    groups.push_back(curve_rows(measurement.profile, header.reference, floor));
    keys.push_back(measurement.sample);
  }
  groups.push_back(curve_rows(header.reference, header.reference, floor));
  keys.emplace_back("the reference glass: the image of the slit");
  const Rows fields = field_rows(header);
  const double reach = degrees_for_output(header.setup.reach);
  Chart chart("profile");
  chart.set("reach", reach).set("y_low", floor).set("y_high", 2.0 * highest);
  chart.set("count", double(groups.size())).set("has_fields", fields.empty() ? 0.0 : 1.0);
  chart.block("fields", {fields}).block("curves", groups);
  return figures.figure(
      chart,
      fmt::format("Light about the mirror direction at {:g} deg, as GU per degree{}",
                  degrees_for_output(header.setup.theta_i),
                  fields.empty() ? "" : "; shaded: the fields of haze"),
      keys);
}

}  // namespace

std::string profile_page(const ProfileHeader& header,
                         const std::vector<ProfileMeasurement>& measurements) {
  Figures figures;
  const bool is_one = measurements.size() == 1;
  const PageList sections{device_section("Profile",
                                         "Positive angles lie away from the normal, negative ones "
                                         "between the mirror direction and it. "
                                         "The axis is logarithmic, over six decades.",
                                         {profile_figure(figures, header, measurements)})};
  return device_page(
      {.title = is_one ? fmt::format("In-plane profile of {}", measurements.front().sample)
                       : fmt::format("In-plane profiles of {} samples", measurements.size()),
       .subtitle = is_one ? measurements.front().sample_title
                          : std::string("Haze, distinctness of image and image clarity"),
       .facts = profile_facts(header),
       .tables = {profile_table(measurements)},
       .notes = profile_notes(measurements)},
      sections);
}

}  // namespace gonio
