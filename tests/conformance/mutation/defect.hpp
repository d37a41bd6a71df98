#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/conformance/mutation/defective_optics.hpp"
#include "tests/conformance/mutation/defective_port.hpp"
#include "tests/conformance/mutation/defective_standard.hpp"

namespace gonio::conformance {

/// Something that is wrong with an instrument, or with how its readings are evaluated. What is
/// not wrong is empty.
struct Defect {
  std::string id;
  std::string wrong;  ///< in words
  SourceMark mark;
  std::vector<std::string> standards;     ///< on which it is tried
  std::vector<std::string> clauses;       ///< families, one of which must catch it; empty: any
  std::optional<YamlNode> set = {};       ///< laid over the instrument, which says so
  std::optional<YamlNode> unstated = {};  ///< laid over it, while its papers say that all is well
  std::optional<double> certificate_index = {};  ///< whose values the tile is taken to have
  OpticsDefect optics = nullptr;
  PortDefect device = nullptr;
  StandardDefect standard = {};
};

/// What is to be tried.
struct Defects {
  std::vector<std::string> standards;    ///< on which the healthy instrument is tried
  std::optional<YamlNode> healthy = {};  ///< laid over the nominal instrument
  std::vector<Defect> defects;

  [[nodiscard]] Instrument healthy_instrument(const Standard& standard,
                                              const Catalog& catalog) const;
};

/// Reads a file of schema gonio/defects/1.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Defects load_defects(const std::filesystem::path& file, const Catalog& catalog);

}  // namespace gonio::conformance
