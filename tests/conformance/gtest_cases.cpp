#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/conformance/run.hpp"

namespace gonio::conformance {

namespace {

class CaseTest : public testing::Test {
 public:
  CaseTest(ConformanceRun& run, const SuiteCase& entry) : run_(run), entry_(entry) {}

  void TestBody() override {
    const CaseResult& result = run_.run(entry_);
    const Clause& clause = run_.suite().clause_of(entry_);
    RecordProperty("clause", result.clause);
    RecordProperty("level", clause.level);
    RecordProperty("evidence", clause.evidence.level);
    RecordProperty("role", role_name(result.role));
    RecordProperty("verdict", verdict_name(result.verdict));
    RecordProperty("expected", verdict_name(result.expected));
    if (result.verdict == ConformanceVerdict::skipped ||
        (result.verdict == ConformanceVerdict::not_applicable && result.is_as_expected())) {
      GTEST_SKIP() << result.message;
    }
    const bool speaks = result.role != CaseRole::device || run_.counts(clause) ||
                        result.verdict == ConformanceVerdict::error;
    if (!result.is_as_expected() && speaks) {
      ADD_FAILURE_AT(result.mark.file.c_str(), result.mark.line)
          << fmt::format("{}: {}, expected {}\n{}", result.address, verdict_name(result.verdict),
                         verdict_name(result.expected), result.message);
    }
  }

 private:
  ConformanceRun& run_;
  const SuiteCase& entry_;
};

}  // namespace

void register_tests(ConformanceRun& run, const std::string& prefix) {
  for (const SuiteCase& entry : run.suite().cases) {
    if (!is_selected(entry.address, prefix)) {
      continue;
    }
    const Case& stated = run.suite().case_of(entry);
    const std::string suite = entry.address.substr(0, entry.address.rfind('/'));
    testing::RegisterTest(suite.c_str(), stated.id.c_str(), nullptr, nullptr,
                          stated.mark.file.c_str(), stated.mark.line,
                          [&run, &entry]() -> testing::Test* { return new CaseTest(run, entry); });
  }
}

}  // namespace gonio::conformance
