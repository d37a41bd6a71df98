#pragma once

#include <string>
#include <vector>

#include "emulator/measured/brdf_file.hpp"

namespace gonio {

/// What a measured BRDF is, and how far it can be trusted.
struct BrdfSummary {
  struct Row {
    Angle theta_i;
    Angle step;                  ///< as MeasuredBrdf::step
    Eigen::ArrayXd reflectance;  ///< directional-hemispherical, shape (n_channels)
  };
  BrdfFormat format;
  std::string file, description;
  std::vector<BrdfChannel> channels;
  Angle largest_theta;
  std::vector<Row> rows;              ///< 0, 20, 45, 60, 75, 85 deg, as far as they were measured
  std::vector<std::string> warnings;  ///< of reading; and of a reflectance above 1
};

[[nodiscard]] BrdfSummary summarize(const BrdfFile& file);

}  // namespace gonio
