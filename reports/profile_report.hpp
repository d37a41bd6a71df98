#pragma once

#include <string>
#include <vector>

#include "emulator/procedure/profile.hpp"

namespace gonio {

/// How profiles were taken: what stands above their table.
struct ProfileHeader {
  const Standard& standard;  ///< of the scale
  ProfileSetup setup;
  ProfileAssumptions assumptions;
  std::vector<ProfileRule> rules;
  Profile reference;
};

/// A sample, its profile and what is made of it; each with the same quantities.
struct ProfileMeasurement {
  std::string sample, sample_title;
  Profile profile;
  std::vector<ProfileQuantity> quantities;
};

/// A table for people.
[[nodiscard]] std::string profile_text(const ProfileHeader& header,
                                       const std::vector<ProfileMeasurement>& measurements,
                                       bool styled);

/// Schema gonio/profile/1, numbers at full precision.
[[nodiscard]] std::string profile_json(const ProfileHeader& header,
                                       const std::vector<ProfileMeasurement>& measurements);

/// The profiles: a row for each element, a column for each sample.
[[nodiscard]] std::string profile_csv(const ProfileHeader& header,
                                      const std::vector<ProfileMeasurement>& measurements);

/// A page of its own, with the profiles as charts.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string profile_page(const ProfileHeader& header,
                                       const std::vector<ProfileMeasurement>& measurements);

}  // namespace gonio
