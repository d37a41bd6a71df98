#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "emulator/integration/flux.hpp"
#include "emulator/standard/profile_rule.hpp"
#include "emulator/standard/standard.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// A row of receptor elements in the plane of measurement, flat and centred on the mirror
/// direction, and a slit across that plane as the source. What no standard says is assumed.
struct ProfileSetup {
  Angle theta_i = degrees(20);
  /// Step and reach as of an array of 512 diodes of a maker (Rhopoint IQ).
  Angle step = degrees(0.02832);
  Angle reach = degrees(7.25);                  ///< to either side
  Angle source_in_plane = degrees(0.02);        ///< assumed
  Angle source_perpendicular = degrees(2.5);    ///< of ISO 2813
  Angle receptor_perpendicular = degrees(3.6);  ///< of ISO 2813 at 20 deg
};

/// The flux that each element receives, of the incident flux, weighted by the light.
struct Profile {
  Eigen::ArrayXd edge_rad =
      {};                    ///< from the mirror direction, positive away from the normal, (n+1)
  Eigen::ArrayXd flux = {};  ///< (n)

  /// What falls between two angles [rad]; of an element that they cut, its share.
  [[nodiscard]] double between(double low_rad, double high_rad) const;
  /// Whether a field lies within.
  [[nodiscard]] bool covers(double low_rad, double high_rad) const;
};

/// Source times responsivity, of sum 1, and what 100 is.
struct ProfileScale {
  Eigen::ArrayXd weight;
  Surface reference;
};

/// The scale of a gloss standard on a grid. @throws std::invalid_argument  without a glass.
[[nodiscard]] ProfileScale profile_scale(const Standard& standard, const WavelengthGrid& grid);

/// On all cores. @param tilt  of the sample in the plane of measurement, towards the receptor.
/// @throws std::domain_error  if the row reaches beyond the horizon, or has more than 20,000
///                            elements.
[[nodiscard]] Profile measure_profile(const Surface& surface, const ProfileSetup& setup,
                                      const Eigen::ArrayXd& weight,
                                      const FluxIntegrator& integrator, Angle tilt = {});

/// Image clarity behind a comb whose bands are as wide as its gaps,
///
///   C = 100 (M - m) / (M + m),
///
/// M and m the largest and the least flux through it as it slides. Of the profile, so much is used
/// as a whole number of periods covers: an even one then has none.
/// @param comb_mm      width of a band, > 0.
/// @param distance_mm  focal length: an angle a from the mirror direction lands at distance tan a.
/// @return  nothing where not one period fits, or no light is there.
[[nodiscard]] std::optional<double> image_clarity(const Profile& profile, double comb_mm,
                                                  double distance_mm);

/// What the standards leave open.
struct ProfileAssumptions {
  Angle haze_field = degrees(1.8);  ///< width of a haze field that no standard states
  Angle doi_field = degrees(0.1);   ///< width of the receptor for distinctness of image
  double comb_distance_mm = 100.0;  ///< focal length before the comb
};

/// A number made of a profile.
struct ProfileQuantity {
  std::string standard, id, title;
  std::optional<double> value = {};
  std::string unit = {};     ///< GU, or empty
  std::string missing = {};  ///< why there is no value
  Evidence evidence = {};
  std::string assumption = {};  ///< what it rests on that no standard says; empty if nothing

  /// No verdict may rest on it.
  [[nodiscard]] bool is_informative() const {
    return evidence.is_informative() || !assumption.empty();
  }
};

/// Gloss in the receptor of a geometry, as wide as that is in the plane.
[[nodiscard]] ProfileQuantity profile_gloss(const Profile& sample, const Profile& reference,
                                            const Standard& standard,
                                            const GeometryLimits& geometry);

/// What the rules make of a profile taken at theta_i; those for other angles are left out.
[[nodiscard]] std::vector<ProfileQuantity> profile_quantities(
    const Profile& sample, const Profile& reference, Angle theta_i,
    const std::vector<ProfileRule>& rules, const ProfileAssumptions& assumptions);

}  // namespace gonio
