#pragma once

#include <string>
#include <vector>

#include "tests/conformance/mutation/defect.hpp"
#include "tests/conformance/suite.hpp"

namespace gonio::conformance {

/// A case that came out otherwise than on the healthy instrument.
struct Catch {
  std::string address;
  bool counts = false;  ///< towards the verdict of its standard
};

/// What the suite has made of a defect.
struct MutationRow {
  std::string id, wrong;
  std::vector<Catch> caught_by = {};
  bool is_caught = false;  ///< by a case of one of the clauses that are meant to
};

struct MutationTable {
  /// Cases on the device, or of an evaluation, that do not accept the healthy instrument.
  std::vector<std::string> healthy_caught_by = {};
  std::size_t tried = 0;  ///< how many such cases there are
  std::vector<MutationRow> rows = {};

  [[nodiscard]] bool is_sound() const;
};

/// Tries the suites on the healthy instrument and on each defect, in parallel. Controls are left
/// out: they try the suite, not the device.
[[nodiscard]] MutationTable run_mutations(const Defects& defects, const Catalog& catalog);

/// As a table in Markdown, with what is wrong below it.
[[nodiscard]] std::string mutation_text(const MutationTable& table);

}  // namespace gonio::conformance
