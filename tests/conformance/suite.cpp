#include "tests/conformance/suite.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "emulator/instrument/setup.hpp"

namespace gonio::conformance {

namespace fs = std::filesystem;

namespace {

/// A case of a shared file may be about a quantity that this geometry has not.
bool concerns(const Case& stated, const Clause& clause) {
  return stated.clause_family == clause.family &&
         (!setup_quantity(stated.quantity) || clause.limit(stated.quantity) != nullptr);
}

void add_cases(ConformanceSuite& suite) {
  for (std::size_t c = 0; c < suite.set.clauses.size(); ++c) {
    const Clause& clause = suite.set.clauses[c];
    std::set<std::string> ids;
    for (std::size_t j = 0; j < suite.stated.size(); ++j) {
      const Case& stated = suite.stated[j];
      if (!concerns(stated, clause)) {
        continue;
      }
      if (!ids.insert(stated.id).second) {
        throw InputError(stated.mark, "each case of a clause once", stated.id);
      }
      suite.cases.push_back({.address = fmt::format("{}/{}/{}", suite.set.id, clause.id, stated.id),
                             .clause = c,
                             .stated = j});
    }
  }
}

/// How a clause is covered by its cases.
struct Cover {
  bool accepts = false, rejects = false;
  [[nodiscard]] bool any() const { return accepts || rejects; }
};

Cover cover_of(const ConformanceSuite& suite, std::size_t clause) {
  Cover cover;
  for (const SuiteCase& entry : suite.cases) {
    if (entry.clause == clause) {
      const ConformanceVerdict expected = suite.case_of(entry).expected;
      cover.accepts = cover.accepts || expected == ConformanceVerdict::pass;
      cover.rejects = cover.rejects || expected == ConformanceVerdict::fail;
    }
  }
  return cover;
}

void expect_coverage(const ConformanceSuite& suite) {
  for (std::size_t c = 0; c < suite.set.clauses.size(); ++c) {
    const Clause& clause = suite.set.clauses[c];
    if (clause.coverage != "cases" || !clause.not_applicable.empty()) {
      continue;
    }
    const Cover cover = cover_of(suite, c);
    // A case of a protocol is one exchange, right or wrong: the servers that fail it reject.
    const bool needs_both = clause.level == "shall" && suite.set.standard.has_value();
    if (!cover.any() || (needs_both && !(cover.accepts && cover.rejects))) {
      throw InputError(
          clause.mark,
          needs_both ? "a case that accepts and one that rejects" : "a case of this clause",
          !cover.any()    ? "none"
          : cover.accepts ? "none that rejects"
                          : "none that accepts");
    }
  }
}

std::string ids_of(const std::vector<Catalog::Entry>& entries) {
  std::vector<std::string> ids{"all"};
  for (const Catalog::Entry& entry : entries) {
    ids.push_back(entry.id);
  }
  return fmt::format("{}", fmt::join(ids, ", "));
}

}  // namespace

std::vector<std::string> ConformanceSuite::device_samples() const {
  std::set<std::string> ids;
  for (const SuiteCase& entry : cases) {
    if (case_of(entry).role == CaseRole::device) {
      ids.insert(case_of(entry).samples.begin(), case_of(entry).samples.end());
    }
  }
  return {ids.begin(), ids.end()};
}

ConformanceSuite load_suite(const fs::path& clauses_file, const Catalog& catalog) {
  ConformanceSuite suite{.set = load_clauses(clauses_file, catalog)};
  for (const fs::path& file : suite.set.case_files) {
    for (Case& stated : load_cases(file, suite.set, catalog)) {
      suite.stated.push_back(std::move(stated));
    }
  }
  add_cases(suite);
  expect_coverage(suite);
  const fs::path sources = clauses_file.parent_path().parent_path().parent_path() / "sources.yaml";
  if (fs::is_regular_file(sources)) {
    suite.sources = load_sources(sources);
  }
  return suite;
}

bool is_selected(const std::string& address, const std::string& prefix) {
  return prefix.empty() || address == prefix || address.starts_with(prefix + "/");
}

std::vector<SuiteSelection> select_suites(const std::string& id, const Catalog& catalog) {
  const std::vector<Catalog::Entry> entries = catalog.list(Catalog::Kind::clauses);
  std::vector<SuiteSelection> selections;
  for (const Catalog::Entry& entry : entries) {
    if (id == "all" || (!id.empty() && is_selected(entry.id, id))) {
      selections.push_back({.clauses_file = entry.file, .prefix = {}});
    } else if (is_selected(id, entry.id)) {
      selections.push_back({.clauses_file = entry.file, .prefix = id});
    }
  }
  if (selections.empty()) {
    throw InputError({.file = id}, "one of the ids " + ids_of(entries) + ", or a clause of one",
                     "something else");
  }
  return selections;
}

std::string coverage_table(const std::vector<ConformanceSuite>& suites) {
  std::string table =
      "| standard | clauses | of them shall | by cases | accepted and rejected | by inspection | "
      "out of scope | not known | counted |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const ConformanceSuite& suite : suites) {
    int shall = 0, by_cases = 0, both = 0, inspection = 0, out = 0, unknown = 0, counted = 0;
    for (std::size_t c = 0; c < suite.set.clauses.size(); ++c) {
      const Clause& clause = suite.set.clauses[c];
      const Cover cover = cover_of(suite, c);
      const bool is_judged = clause.coverage == "cases" && clause.not_applicable.empty();
      shall += clause.level == "shall";
      by_cases += is_judged;
      both += is_judged && cover.accepts && cover.rejects;
      inspection += clause.coverage == "inspection";
      out += clause.coverage == "out_of_scope";
      unknown += !clause.not_applicable.empty();
      counted += is_judged && clause.level == "shall" && !clause.evidence.is_informative();
    }
    table += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} | {} | {} |\n", suite.set.id,
                         suite.set.clauses.size(), shall, by_cases, both, inspection, out, unknown,
                         counted);
  }
  return table;
}

}  // namespace gonio::conformance
