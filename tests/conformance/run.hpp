#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/standard/decision.hpp"
#include "tests/conformance/suite.hpp"

namespace gonio::conformance {

/// What came of an exchange on the wire, for the cases of a protocol.
struct ExchangeOutcome {
  std::string failure = {};  ///< what was not as expected; empty if all was
  std::string skipped = {};  ///< why it could not be tried
};

/// The device under test, as a run sees it.
struct DeviceUnderTest {
  /// A bench of its own for each case, or always the same: as the device allows.
  std::function<std::shared_ptr<Bench>()> bench;
  /// Carries out what `when` says; nothing where the device is not on a wire.
  std::function<ExchangeOutcome(const YamlNode& when)> exchange = {};
  /// The instrument behind it, as far as it is known; for charts and effects.
  std::optional<Instrument> instrument = {};
  bool is_spectrum_known = true;  ///< of the instrument: a wire does not tell it
  std::string title = {}, detail = {};
};

struct RunOptions {
  DecisionRule rule = DecisionRule::guarded;
  bool should_counts = false;
  std::uint64_t seed = 1;
  std::string version, date;
};

/// One run of one standard on one device.
class ConformanceRun {
 public:
  ConformanceRun(ConformanceSuite suite, DeviceUnderTest device, RunOptions options,
                 Catalog catalog);

  [[nodiscard]] const ConformanceSuite& suite() const { return suite_; }
  /// Tries a case; what goes wrong is its verdict.
  const CaseResult& run(const SuiteCase& entry);
  /// Whether a case that does not come out as expected speaks against the device.
  [[nodiscard]] bool counts(const Clause& clause) const;
  /// What was found so far; clauses outside of `prefix` are left out.
  [[nodiscard]] ConformanceReport report(const std::string& prefix) const;

 private:
  void measure(const SuiteCase& entry, CaseResult& result);
  void exchange(const Case& stated, CaseResult& result) const;
  [[nodiscard]] std::shared_ptr<Bench> bench_of(const Case& stated, const Clause& clause);
  [[nodiscard]] ClauseResult result_of(const Clause& clause) const;
  void add_cases_of(std::size_t clause, ConformanceReport& report, ClauseResult& result) const;
  [[nodiscard]] std::map<std::string, std::string> sources_of(const ConformanceReport&) const;

  ConformanceSuite suite_;
  DeviceUnderTest device_;
  RunOptions options_;
  Catalog catalog_;
  std::vector<std::pair<std::size_t, CaseResult>> results_ = {};  ///< clause, result
};

/// Adds what the set-up of the device does: effects of each limit in GU, footprints, weightings.
void add_optics(ConformanceReport& report, const ConformanceSuite& suite,
                const DeviceUnderTest& device);

/// Registers the cases with GoogleTest, so that filters, lists and XML know them, and point at the
/// line of the YAML file. @param run  must live until the tests have run.
void register_tests(ConformanceRun& run, const std::string& prefix);

}  // namespace gonio::conformance
