#include <fmt/format.h>

#include <utility>
#include <vector>

#include "reports/conformance_report.hpp"
#include "reports/conformance_words.hpp"
#include "reports/escape.hpp"

namespace gonio {

namespace {

using Properties = std::vector<std::pair<const char*, std::string>>;

/// What JUnit knows of how a test ends.
struct Tally {
  std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
  double seconds = 0.0;

  Tally& operator+=(const Tally& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    skipped += other.skipped;
    seconds += other.seconds;
    return *this;
  }
};

/// One ending of a test case: an element's name; empty if it passed.
const char* ending_of(const CaseResult& result, bool is_counted) {
  if (result.is_as_expected()) {
    return "";
  }
  if (result.verdict == ConformanceVerdict::error) {
    return "error";
  }
  const bool was_tried = result.verdict != ConformanceVerdict::skipped &&
                         result.verdict != ConformanceVerdict::not_applicable;
  // A device may miss what does not count; a control or an evaluation has to come out as it should.
  return was_tried && (is_counted || result.role != CaseRole::device) ? "failure" : "skipped";
}

std::string attribute(const char* name, const std::string& value) {
  return fmt::format(" {}=\"{}\"", name, xml_text(value));
}

std::string properties_element(const Properties& properties, int indent) {
  std::string xml = fmt::format("{:{}}<properties>\n", "", indent);
  for (const auto& [name, value] : properties) {
    if (!value.empty()) {
      xml += fmt::format("{:{}}<property name=\"{}\"{}/>\n", "", indent + 2, name,
                         attribute("value", value));
    }
  }
  return xml + fmt::format("{:{}}</properties>\n", "", indent);
}

std::string tally_attributes(const Tally& tally) {
  return fmt::format(R"( tests="{}" failures="{}" errors="{}" skipped="{}" time="{:.3f}")",
                     tally.tests, tally.failures, tally.errors, tally.skipped, tally.seconds);
}

/// Why a case ended that way, a line for each observation.
std::string explanation(const CaseResult& result) {
  std::string text = result.intent + "\n";
  for (const Observation& observation : result.observations) {
    text +=
        fmt::format("{}: {}\n", verdict_words(observation.verdict), observation_text(observation));
  }
  return text;
}

std::string ending_element(const CaseResult& result, const std::string& ending, bool is_counted) {
  std::string message = found_text(result);
  if (!is_counted) {
    message = "informative, not counted: " + message;
  }
  if (!result.message.empty()) {
    message += ": " + result.message;
  }
  return fmt::format("      <{0}{1}{2}>{3}</{0}>\n", ending, attribute("message", message),
                     ending == "skipped" ? "" : attribute("type", verdict_name(result.verdict)),
                     xml_text(explanation(result)));
}

std::string case_element(const ConformanceReport& report, const ClauseResult& clause,
                         const CaseResult& result, Tally& tally) {
  const bool counts = is_counted(report, clause);
  const std::string ending = ending_of(result, counts);
  tally += {.tests = 1,
            .failures = ending == "failure" ? 1u : 0u,
            .errors = ending == "error" ? 1u : 0u,
            .skipped = ending == "skipped" ? 1u : 0u,
            .seconds = result.duration_s};
  std::string xml = fmt::format(
      "    <testcase{}{}{} line=\"{}\" time=\"{:.3f}\">\n", attribute("name", result.id),
      attribute("classname", report.standard_id + "/" + clause.id),
      attribute("file", result.mark.file), result.mark.line, result.duration_s);
  xml += properties_element({{"address", result.address},
                             {"clause", clause.id},
                             {"level", clause.level},
                             {"evidence", evidence_text(clause.evidence)},
                             {"limit", limits_text(clause)},
                             {"limit_place", limit_places_text(clause)},
                             {"role", role_name(result.role)},
                             {"subject", result.subject},
                             {"seed", fmt::format("{}", result.seed)},
                             {"verdict", verdict_name(result.verdict)},
                             {"expected_verdict", verdict_name(result.expected)}},
                            6);
  return xml + (ending.empty() ? "" : ending_element(result, ending, counts)) + "    </testcase>\n";
}

std::string suite_element(const ConformanceReport& report, const ClauseResult& clause,
                          Tally& total) {
  Tally tally;
  std::string cases;
  for (const std::size_t index : clause.cases) {
    cases += case_element(report, clause, report.cases.at(index), tally);
  }
  total += tally;
  return fmt::format("  <testsuite{}{}{} line=\"{}\">\n",
                     attribute("name", report.standard_id + "/" + clause.id),
                     tally_attributes(tally), attribute("file", clause.mark.file),
                     clause.mark.line) +
         properties_element({{"clause", clause.id},
                             {"requirement", clause.requirement},
                             {"level", clause.level},
                             {"counts", is_counted(report, clause) ? "yes" : "no"},
                             {"verdict", verdict_name(clause.verdict)},
                             {"evidence", evidence_text(clause.evidence)},
                             {"limit", limits_text(clause)},
                             {"coverage", coverage_text(clause)}},
                            4) +
         cases + "  </testsuite>\n";
}

}  // namespace

std::string conformance_junit(const ConformanceReport& report) {
  Tally total;
  std::string suites;
  for (const ClauseResult& clause : report.clauses) {
    suites += suite_element(report, clause, total);
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
         fmt::format("<testsuites{}{}>\n", attribute("name", report.standard_id),
                     tally_attributes(total)) +
         properties_element({{"standard", report.title},
                             {"edition", report.edition},
                             {"transcription", report.transcription},
                             {"device", report.device},
                             {"device_detail", report.device_detail},
                             {"decision_rule", report.decision_rule},
                             {"version", report.version},
                             {"date", report.date},
                             {"seed", fmt::format("{}", report.seed)},
                             {"verdict", verdict_name(report.verdict)}},
                            2) +
         suites + "</testsuites>\n";
}

}  // namespace gonio
