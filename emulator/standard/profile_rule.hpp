#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/angle.hpp"
#include "emulator/core/catalog.hpp"
#include "emulator/standard/evidence.hpp"

namespace gonio {

/// A part of an in-plane profile, by its angle from the mirror direction, positive away from the
/// normal.
struct ProfileField {
  Angle offset;
  std::optional<Angle> width = {};  ///< nothing: the standard's was not found
  Evidence evidence = {};
};

/// What a standard makes of an in-plane profile.
struct ProfileRule {
  enum class Kind {
    haze,         ///< 100 times the flux in the fields over the reference's at the mirror direction
    logarithmic,  ///< factor * log10(H / divisor + 1) of a haze H before it
    doi,          ///< 100 (1 - R(off) / R(0)), the mean of both sides
    clarity       ///< 100 (M - m) / (M + m) behind a comb
  };
  std::string standard;  ///< id
  std::string id, title;
  Kind kind = Kind::haze;
  std::optional<Angle> theta_i = {};  ///< nothing: at any angle of incidence
  std::vector<ProfileField> fields = {};
  bool is_mean = false;                           ///< of the fields; else their sum
  std::string of = {};                            ///< logarithmic: id of the haze
  std::optional<Stated<double>> factor, divisor;  ///< logarithmic
  std::vector<double> comb_mm = {};               ///< clarity: widths of a band
  Evidence evidence = {};                         ///< weakest of all its numbers
};

/// The rules of a standard on profiles, from standards/<family>/<edition>/profile.yaml.
struct ProfileRules {
  std::string id, title, notes;
  std::vector<ProfileRule> rules = {};
};

/// Reads a file of schema gonio/profile_rules/1; geometries are those of the standard.yaml beside.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] ProfileRules load_profile_rules(const std::filesystem::path& path,
                                              const Catalog& catalog);

/// H on the logarithmic scale of a rule. @param haze  > -divisor.
[[nodiscard]] double logarithmic_haze(const ProfileRule& rule, double haze);

}  // namespace gonio
