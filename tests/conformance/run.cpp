#include "tests/conformance/run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "tests/conformance/in_process_port.hpp"
#include "tests/conformance/judgement.hpp"

namespace gonio::conformance {

namespace {

using enum ConformanceVerdict;

/// The part that an intended control plays: it judges the suite, not the device.
ConformanceVerdict weight_of(const CaseResult& result) {
  if (result.verdict == error) {
    return error;
  }
  switch (result.role) {
    case CaseRole::device:
      return result.verdict;
    case CaseRole::evaluation:
      return result.verdict == not_applicable ? not_applicable
             : result.is_as_expected()        ? pass
                                              : fail;
    case CaseRole::control:
      return result.is_as_expected() ? not_applicable : error;
  }
  return error;
}

/// Reports name files below their data folder: they are read on other machines.
void name_files(const Catalog& catalog, ConformanceReport& report) {
  const auto name = [&](std::string& file) { file = catalog.name_of(file); };
  name(report.device_detail);
  for (ClauseResult& clause : report.clauses) {
    name(clause.mark.file);
    for (LimitRow& limit : clause.limits) {
      name(limit.mark.file);
    }
  }
  for (CaseResult& found : report.cases) {
    name(found.mark.file);
  }
}

class NoDevice final : public std::logic_error {
 public:
  NoDevice() : std::logic_error("an evaluation asked for a device") {}
};

}  // namespace

ConformanceRun::ConformanceRun(ConformanceSuite suite, DeviceUnderTest device, RunOptions options,
                               Catalog catalog)
    : suite_(std::move(suite)),
      device_(std::move(device)),
      options_(std::move(options)),
      catalog_(std::move(catalog)) {}

std::shared_ptr<Bench> ConformanceRun::bench_of(const Case& stated, const Clause& clause) {
  const Standard* standard = suite_.set.standard ? &*suite_.set.standard : nullptr;
  switch (stated.role) {
    case CaseRole::device:
      return device_.bench();
    case CaseRole::evaluation:
      return std::make_shared<Bench>(standard, []() -> DevicePort& { throw NoDevice(); });
    case CaseRole::control:
      break;
  }
  Instrument instrument = given_instrument(*stated.given, suite_.set, clause, catalog_);
  instrument.behaviour.seed = stated.seed;
  const auto port = std::make_shared<InProcessPort>(
      std::move(instrument), std::vector(stated.samples.begin(), stated.samples.end()),
      assemble_with(catalog_));
  return std::make_shared<Bench>(standard, [port]() -> DevicePort& { return *port; });
}

void ConformanceRun::exchange(const Case& stated, CaseResult& result) const {
  if (!device_.exchange) {
    throw NotOffered("needs a server: --device modbus://HOST:PORT");
  }
  const ExchangeOutcome outcome = device_.exchange(*stated.exchange);
  if (!outcome.skipped.empty()) {
    throw NotOffered(outcome.skipped);
  }
  result.message = outcome.failure;
  result.verdict = outcome.failure.empty() ? pass : fail;
}

void ConformanceRun::measure(const SuiteCase& entry, CaseResult& result) {
  const Case& stated = suite_.case_of(entry);
  const Clause& clause = suite_.clause_of(entry);
  if (stated.exchange) {
    exchange(stated, result);
    return;
  }
  const std::shared_ptr<Bench> bench = bench_of(stated, clause);
  if (stated.role != CaseRole::evaluation) {
    const Identity& identity = bench->port().identity();
    result.subject = identity.manufacturer + " " + identity.model;
  }
  result.verdict = not_applicable;
  for (const Finding& finding : stated.measure({suite_.set, clause, *bench})) {
    if (auto seen = judge(finding, stated, clause, suite_.set, options_.rule)) {
      result.verdict = worse(result.verdict, seen->verdict);
      result.observations.push_back(std::move(*seen));
    }
  }
  if (result.observations.empty()) {
    result.message = "nothing that the case expects could be measured";
  }
}

const CaseResult& ConformanceRun::run(const SuiteCase& entry) {
  const Case& stated = suite_.case_of(entry);
  const Clause& clause = suite_.clause_of(entry);
  CaseResult result{.id = stated.id,
                    .clause = clause.id,
                    .address = entry.address,
                    .intent = stated.intent,
                    .mark = stated.mark,
                    .role = stated.role,
                    .seed = stated.seed,
                    .expected = stated.expected};
  const auto begin = std::chrono::steady_clock::now();
  try {
    if (clause.not_applicable.empty()) {
      measure(entry, result);
    } else {
      result.verdict = result.expected = not_applicable;
      result.message = clause.not_applicable;
    }
  } catch (const NotOffered& reason) {
    result.verdict = skipped;
    result.message = reason.what();
  } catch (const DeviceRefused& refusal) {
    result.verdict = fail;
    result.message = refusal.what();
  } catch (const std::exception& failure) {
    result.verdict = error;
    result.message = failure.what();
  }
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
  result.duration_s = duration.count();
  return results_.emplace_back(entry.clause, std::move(result)).second;
}

bool ConformanceRun::counts(const Clause& clause) const {
  return clause.coverage == "cases" && !clause.evidence.is_informative() &&
         (clause.level == "shall" || (clause.level == "should" && options_.should_counts));
}

ClauseResult ConformanceRun::result_of(const Clause& clause) const {
  return {.id = clause.id,
          .level = clause.level,
          .requirement = clause.requirement,
          .coverage = clause.coverage,
          .reason = clause.not_applicable.empty() ? clause.reason : clause.not_applicable,
          .mark = clause.mark,
          .evidence = clause.evidence,
          .limits = clause.limits,
          .counts = counts(clause)};
}

void ConformanceRun::add_cases_of(std::size_t clause, ConformanceReport& report,
                                  ClauseResult& result) const {
  for (const auto& [of_clause, found] : results_) {
    if (of_clause == clause) {
      result.cases.push_back(report.cases.size());
      result.verdict = worse(result.verdict, weight_of(found));
      report.cases.push_back(found);
    }
  }
}

std::map<std::string, std::string> ConformanceRun::sources_of(
    const ConformanceReport& report) const {
  std::map<std::string, std::string> used;
  const auto add = [&](const std::string& key) {
    if (const auto found = suite_.sources.find(key); found != suite_.sources.end()) {
      used.insert(*found);
    }
  };
  for (const ClauseResult& clause : report.clauses) {
    for (const std::string& key : clause.evidence.sources) {
      add(key);
    }
    for (const LimitRow& limit : clause.limits) {
      for (const std::string& key : limit.evidence.sources) {
        add(key);
      }
    }
  }
  for (const CaseResult& found : report.cases) {
    for (const Observation& seen : found.observations) {
      add(seen.origin);
    }
  }
  return used;
}

ConformanceReport ConformanceRun::report(const std::string& prefix) const {
  ConformanceReport report{.standard_id = suite_.set.id,
                           .title = suite_.set.title,
                           .edition = suite_.set.edition,
                           .transcription = suite_.set.transcription,
                           .notes = suite_.set.notes,
                           .device = device_.title,
                           .device_detail = device_.detail,
                           .decision_rule = decision_rule_words(options_.rule),
                           .version = options_.version,
                           .date = options_.date,
                           .seed = options_.seed,
                           .should_counts = options_.should_counts,
                           .verdict = not_applicable};
  for (std::size_t c = 0; c < suite_.set.clauses.size(); ++c) {
    ClauseResult result = result_of(suite_.set.clauses[c]);
    const std::size_t before = report.cases.size();
    add_cases_of(c, report, result);
    const std::string address = suite_.set.id + "/" + result.id;
    // What was not asked for is left out, and what a filter has left out.
    const bool has_cases = std::any_of(suite_.cases.begin(), suite_.cases.end(),
                                       [&](const SuiteCase& entry) { return entry.clause == c; });
    if (report.cases.size() == before && (has_cases || !is_selected(address, prefix))) {
      continue;
    }
    // A suite that does not judge as it should is an error whatever rests on it.
    if (result.counts || result.verdict == error) {
      report.verdict = worse(report.verdict, result.verdict);
    }
    report.clauses.push_back(std::move(result));
  }
  report.sources = sources_of(report);
  name_files(catalog_, report);
  return report;
}

}  // namespace gonio::conformance
