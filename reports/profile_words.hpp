#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/profile_report.hpp"
#include "reports/report_table.hpp"

// Profiles in words, the same for a terminal and for a page.

namespace gonio {

/// Name and value of what was done and assumed.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> profile_facts(
    const ProfileHeader& header);
[[nodiscard]] ReportTable profile_table(const std::vector<ProfileMeasurement>& measurements);
/// What rests on memory, and why values are missing.
[[nodiscard]] std::vector<std::string> profile_notes(
    const std::vector<ProfileMeasurement>& measurements);

/// Middles of the elements [deg], from the mirror direction.
[[nodiscard]] Eigen::ArrayXd profile_angles(const Profile& profile);
/// Of 100 for all that the reference reflects, per degree: its integral over a receptor is gloss.
[[nodiscard]] Eigen::ArrayXd profile_density(const Profile& profile, const Profile& reference);

}  // namespace gonio
