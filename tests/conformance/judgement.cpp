#include "tests/conformance/judgement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gonio::conformance {

namespace {

using ByGeometry = Expectation::ByGeometry;

Observation observation_of(const Finding& finding, const Case& stated) {
  return {.quantity = stated.quantity,
          .geometry = finding.geometry,
          .subject = finding.subject,
          .unit = finding.unit,
          .found = finding.text,
          .value = finding.value,
          .expanded_uncertainty = finding.expanded_uncertainty,
          .origin = stated.expectation.source,
          .note = finding.note};
}

/// What a number is held against.
struct Expected {
  std::optional<double> value = {};
  std::string origin = {};
  bool is_nothing_expected = false;  ///< of this geometry
};

Expected expected_number(const Finding& finding, const Case& stated, const Clause& clause,
                         const ClauseSet& set) {
  const auto& value = stated.expectation.value;
  if (const auto* number = std::get_if<UnitValue>(&value)) {
    return {.value = number->value};
  }
  if (const auto* by_geometry = std::get_if<ByGeometry>(&value)) {
    const auto found = by_geometry->find(finding.geometry);
    return found == by_geometry->end() ? Expected{.is_nothing_expected = true}
                                       : Expected{.value = found->second.value};
  }
  if (const auto* artefact = std::get_if<PolishedArtefact>(&value)) {
    const Angle theta_i = set.standard->geometry(finding.geometry).theta_i.nominal;
    return {.value = closed_form_gloss(*artefact, theta_i, set.standard->scale),
            .origin = "closed form of Fresnel"};
  }
  if (finding.expected) {
    return {.value = finding.expected, .origin = finding.origin};
  }
  const LimitRow* limit = clause.limit(stated.quantity);
  return {.value = limit == nullptr ? std::nullopt : limit->nominal};
}

std::optional<double> own_tolerance(const Case& stated, const std::string& geometry) {
  const auto& tolerance = stated.expectation.tolerance;
  if (const auto* number = std::get_if<UnitValue>(&tolerance)) {
    return number->value;
  }
  if (const auto* by_geometry = std::get_if<ByGeometry>(&tolerance)) {
    const auto found = by_geometry->find(geometry);
    return found == by_geometry->end() ? std::nullopt : std::optional(found->second.value);
  }
  return std::nullopt;
}

Interval limits_on(const Expected& expected, const Finding& finding, const Case& stated,
                   const Clause& clause) {
  std::optional<double> tolerance = own_tolerance(stated, finding.geometry);
  const LimitRow* limit = clause.limit(stated.quantity);
  if (!tolerance && limit != nullptr) {
    if (!limit->tolerance || !expected.value) {
      return {.low = limit->low, .high = limit->high};
    }
    tolerance = limit->tolerance;
  }
  if (!tolerance || !expected.value) {
    throw InputError(stated.mark, "a limit: `then.tolerance`, or one of the clause",
                     "none of " + stated.quantity);
  }
  return {.low = *expected.value - *tolerance, .high = *expected.value + *tolerance};
}

void judge_text(const std::vector<std::string>& expected, Observation& seen) {
  seen.expected_text = fmt::format("{}", fmt::join(expected, " or "));
  const bool is_expected =
      std::find(expected.begin(), expected.end(), seen.found) != expected.end();
  seen.verdict = is_expected ? ConformanceVerdict::pass : ConformanceVerdict::fail;
}

/// A device may say that it cannot tell, where the value lies above its full scale.
void judge_without_number(const Finding& finding, Observation& seen) {
  const bool may_be = seen.found == "over_range" && seen.expected && finding.full_scale &&
                      *seen.expected > *finding.full_scale;
  if (may_be) {
    seen.note = fmt::format("above the full scale of {:g} {}", *finding.full_scale, seen.unit);
  }
  seen.verdict = may_be ? ConformanceVerdict::pass : ConformanceVerdict::fail;
}

}  // namespace

std::optional<Observation> judge(const Finding& finding, const Case& stated, const Clause& clause,
                                 const ClauseSet& set, DecisionRule rule) {
  Observation seen = observation_of(finding, stated);
  if (const auto* texts = std::get_if<std::vector<std::string>>(&stated.expectation.value)) {
    judge_text(*texts, seen);
    return seen;
  }
  const Expected expected = expected_number(finding, stated, clause, set);
  if (expected.is_nothing_expected) {
    return std::nullopt;
  }
  seen.expected = expected.value;
  if (seen.origin.empty()) {
    seen.origin = expected.origin;
  }
  const Interval limits = limits_on(expected, finding, stated, clause);
  seen.low = limits.low;
  seen.high = limits.high;
  if (seen.value) {
    seen.verdict = decide(*seen.value, seen.expanded_uncertainty, limits, rule);
  } else {
    judge_without_number(finding, seen);
  }
  return seen;
}

}  // namespace gonio::conformance
