#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "emulator/optics/fresnel.hpp"
#include "emulator/procedure/optical_response.hpp"
#include "emulator/procedure/setup_effects.hpp"
#include "tests/unit/procedure/laboratory.hpp"

// What tests of the response of optics share. Few wavelengths, so that they are quick.

namespace gonio::test {

constexpr double tolerance_gu = 1e-6;  // asked of the integrator
inline const WavelengthGrid few_wavelengths(nanometres(450), nanometres(100), 3);
inline const std::vector<std::string> three_angles{"20", "60", "85"};

/// By the standard that the other instruments here are built to, too.
inline Instrument nominal_iso_2813() {
  return nominal_instrument(shipped_standard("iso_2813/2014"));
}
inline Instrument shipped_instrument(const std::string& id) {
  return load_instrument(shipped().find(Catalog::Kind::instrument, id), shipped());
}

/// Rows of the ladder.
inline std::vector<Sample> rungs(const std::vector<std::string>& ids) {
  const std::vector<Sample> ladder = effect_ladder(few_wavelengths);
  std::vector<Sample> result;
  for (const std::string& id : ids) {
    result.push_back(*std::ranges::find(ladder, id, &Sample::id));
  }
  return result;
}

inline Eigen::Index place(const OpticalResponse& response, SetupQuantity quantity) {
  const auto found = std::ranges::find(response.quantities(), quantity);
  EXPECT_NE(found, response.quantities().end());
  return found - response.quantities().begin();
}

/// The nominal parameters with some at another value.
inline Eigen::VectorXd nominal_with(const OpticalResponse& response,
                                    const std::vector<std::pair<SetupQuantity, double>>& changes) {
  Eigen::VectorXd parameters = response.nominal();
  for (const auto& [quantity, value] : changes) {
    parameters(place(response, quantity)) = value;
  }
  return parameters;
}

inline double glass_reflectance(double theta_deg, double n) {
  return fresnel_reflectance(std::cos(degrees(theta_deg).radians()), n);
}

}  // namespace gonio::test
