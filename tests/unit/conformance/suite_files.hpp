#pragma once

#include <vector>

#include "tests/conformance/suite.hpp"
#include "tests/unit/standard/clause_files.hpp"

namespace gonio::test {

/// The same, read as a suite.
class SuiteFiles : public ClauseFiles {
 public:
  using ClauseFiles::ClauseFiles;

  [[nodiscard]] std::vector<conformance::Case> cases() const {
    return conformance::load_cases(folder() / "cases.yaml", clauses(), shipped());
  }
  [[nodiscard]] conformance::ConformanceSuite suite() const {
    return conformance::load_suite(folder() / "clauses.yaml", shipped());
  }
};

}  // namespace gonio::test
