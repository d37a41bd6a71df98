#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/standard/standard.hpp"

namespace gonio {

/// A limit of a clause, as a reader sees it.
struct LimitRow {
  std::string quantity = {}, geometry = {}, unit = {};
  std::optional<double> nominal = {}, tolerance = {}, low = {}, high = {};
  Evidence evidence = {};
  SourceMark mark = {};
};

/// A demand of a standard, for one geometry if it is made of each.
struct Clause {
  std::string id = {};      ///< e.g. geometry/incidence_60
  std::string family = {};  ///< as its file and its cases call it, e.g. geometry/incidence
  std::optional<std::string> geometry = {};
  std::string level = {};  ///< shall, should, may, informative
  std::string requirement = {};
  std::string coverage = {};  ///< cases, inspection, out_of_scope
  std::string reason = {};
  std::vector<LimitRow> limits = {};
  Evidence evidence = {};  ///< the weakest of the clause and its limits
  SourceMark mark = {};
  /// Why it cannot be judged, e.g. since its number is unknown; empty if it can.
  std::string not_applicable = {};

  /// @return  the limit of that quantity, or null.
  [[nodiscard]] const LimitRow* limit(const std::string& quantity) const;
};

/// What a standard demands: standards/<family>/<edition>/clauses.yaml, with standard.yaml beside it
/// where it measures something.
struct ClauseSet {
  std::string id = {}, title = {}, edition = {}, transcription = {}, notes = {};
  std::optional<Standard> standard = {};  ///< nothing for a protocol
  std::vector<Clause> clauses = {};
  std::vector<std::filesystem::path> case_files = {};
  SourceMark mark = {};
};

/// @throws InputError  for anything that is not as schema gonio/clauses/1 says.
[[nodiscard]] ClauseSet load_clauses(const std::filesystem::path& file, const Catalog& catalog);

/// What the keys of evidence stand for, from standards/sources.yaml.
[[nodiscard]] std::map<std::string, std::string> load_sources(const std::filesystem::path& file);

}  // namespace gonio
