#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/optics/refractive_index.hpp"

namespace gonio {

/// A refractive index that somebody measured, or assumed.
struct NamedIndex {
  std::string author;
  RefractiveIndex index;
};

/// A material of a publication: the slope that was found for it, and how well it did.
struct ValidationMaterial {
  std::string id;
  std::string title;
  double rms_slope = 0.0;  ///< m of Cook-Torrance, > 0
  /// Printed relative RMSE [%], by geometry.
  std::map<std::string, double> printed_percent = {};
  std::vector<NamedIndex> indices = {};  ///< at least one
};

/// What a publication did, to be done again.
struct ValidationPlan {
  std::filesystem::path file;
  std::string id;
  std::string title;
  std::string source;  ///< the publication
  Instrument instrument;
  int patches = 0;                    ///< resolution N of the patch method, of 3 N^2 patches
  std::vector<int> convergence = {};  ///< resolutions, ascending
  std::vector<ValidationMaterial> materials = {};
  /// What the publication says that cannot be computed again, in words.
  std::vector<std::string> limits = {};
};

/// Reads a file of schema gonio/validation/1.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] ValidationPlan load_validation_plan(const std::filesystem::path& path,
                                                  const Catalog& catalog);

}  // namespace gonio
