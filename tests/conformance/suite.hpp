#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "emulator/standard/clause.hpp"
#include "tests/conformance/case.hpp"

namespace gonio::conformance {

/// A case of one clause, with its address.
struct SuiteCase {
  std::string address;  ///< e.g. iso_2813/2014/geometry/incidence_60/offset_beyond_limit
  std::size_t clause;   ///< index in the clauses of its set
  std::size_t stated;   ///< index in ConformanceSuite::stated
};

/// A standard with its clauses and all cases: what the suite can run.
struct ConformanceSuite {
  ClauseSet set;
  std::vector<Case> stated = {};
  std::vector<SuiteCase> cases = {};
  std::map<std::string, std::string> sources = {};

  [[nodiscard]] const Clause& clause_of(const SuiteCase& entry) const {
    return set.clauses[entry.clause];
  }
  [[nodiscard]] const Case& case_of(const SuiteCase& entry) const { return stated[entry.stated]; }
  /// Ids of samples that cases on the device under test need.
  [[nodiscard]] std::vector<std::string> device_samples() const;
};

/// @throws InputError  for files that are not as they should be; for a clause with `coverage:
///                     cases` that has none, and for a `shall` without a case that accepts and one
///                     that rejects.
[[nodiscard]] ConformanceSuite load_suite(const std::filesystem::path& clauses_file,
                                          const Catalog& catalog);

/// What an id names: `all`, a family (modbus), a standard (iso_2813/2014), or a part of one
/// (iso_2813/2014/geometry/receptor_60).
struct SuiteSelection {
  std::filesystem::path clauses_file;
  std::string prefix;  ///< of addresses; empty: the whole standard
};
/// @throws InputError  that lists the ids there are, if it names nothing.
[[nodiscard]] std::vector<SuiteSelection> select_suites(const std::string& id,
                                                        const Catalog& catalog);

/// Whether an address is in a selection: it is the prefix itself or below it.
[[nodiscard]] bool is_selected(const std::string& address, const std::string& prefix);

/// Markdown table of clauses by standard: how many, how many of them shall, and how they are
/// covered.
[[nodiscard]] std::string coverage_table(const std::vector<ConformanceSuite>& suites);

}  // namespace gonio::conformance
