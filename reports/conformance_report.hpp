#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"
#include "emulator/procedure/footprint.hpp"
#include "emulator/procedure/setup_effects.hpp"
#include "emulator/standard/clause.hpp"
#include "emulator/standard/decision.hpp"

// What a run of the conformance suite has found, and how it is written down.

namespace gonio {

/// One number that was judged.
struct Observation {
  std::string quantity = {};  ///< e.g. theta_i, gloss
  std::string geometry = {};  ///< id; empty if it has none
  std::string subject = {};   ///< what was measured, e.g. a sample's id; may be empty
  std::string unit = {};      ///< empty for a number
  std::string found = {};     ///< as text, for what is no number, e.g. "over_range"; else empty
  std::string expected_text = {};             ///< the same of what was expected
  std::optional<double> value = {};           ///< found
  double expanded_uncertainty = 0.0;          ///< of `value`, k = 2; 0 if it was stated without one
  std::optional<double> expected = {};        ///< nominal
  std::optional<double> low = {}, high = {};  ///< limits; nothing: none on that side
  std::string origin = {};                    ///< where the expected value comes from
  ConformanceVerdict verdict = ConformanceVerdict::pass;
  std::string note = {};
};

/// Whom a case tries.
enum class CaseRole {
  device,     ///< the device under test
  control,    ///< an instrument with a known state: shows that the clause accepts and rejects
  evaluation  ///< how readings are evaluated, without any device
};
[[nodiscard]] const char* role_name(CaseRole role);

struct CaseResult {
  std::string id = {};       ///< e.g. offset_beyond_limit
  std::string clause = {};   ///< e.g. geometry/incidence_60
  std::string address = {};  ///< e.g. iso_2813/2014/geometry/incidence_60/offset_beyond_limit
  std::string intent = {};
  SourceMark mark = {};  ///< in its case file
  CaseRole role = CaseRole::device;
  std::string subject = {};  ///< the instrument that was tried, in words
  std::uint64_t seed = 1;
  ConformanceVerdict verdict = ConformanceVerdict::pass;   ///< found
  ConformanceVerdict expected = ConformanceVerdict::pass;  ///< by its file
  std::string message = {};  ///< why it is skipped, not applicable, an error, or not as expected
  std::vector<Observation> observations = {};
  double duration_s = 0.0;

  [[nodiscard]] bool is_as_expected() const { return verdict == expected; }
};

struct ClauseResult {
  std::string id = {};     ///< e.g. geometry/incidence_60
  std::string level = {};  ///< shall, should, may, informative
  std::string requirement = {};
  std::string coverage = {};  ///< cases, inspection, out_of_scope
  std::string reason = {};    ///< why there are no cases
  SourceMark mark = {};
  Evidence evidence = {};  ///< the weakest of the clause and its limits
  std::vector<LimitRow> limits = {};
  std::vector<std::size_t> cases = {};  ///< indices in ConformanceReport::cases
  /// Of its cases that try the device or an evaluation; not_applicable if it has none of them.
  ConformanceVerdict verdict = ConformanceVerdict::not_applicable;
  bool counts = true;  ///< towards the verdict on the device: not if known from memory only
  std::vector<SetupEffects> effects = {};  ///< in GU, of each limit of the set-up
};

/// A spectral weighting: source times responsivity, of sum 1.
struct WeightingCurve {
  std::string title;
  std::vector<double> wavelength_nm, weight;
};

/// All of one run: one standard, one device.
struct ConformanceReport {
  std::string standard_id = {}, title = {}, edition = {}, transcription = {}, notes = {};
  std::string device = {};         ///< in words
  std::string device_detail = {};  ///< where it was found: an instrument file, a URL
  std::string decision_rule = {};  ///< in words
  std::string version = {};        ///< of gonio
  std::string date = {};           ///< YYYY-MM-DD
  std::uint64_t seed = 1;
  bool should_counts = false;
  ConformanceVerdict verdict = ConformanceVerdict::pass;
  std::vector<ClauseResult> clauses = {};
  std::vector<CaseResult> cases = {};
  std::map<std::string, std::string> sources = {};  ///< what the source keys used stand for
  std::vector<WeightingCurve> weightings = {};      ///< of the device, and of the standard
  std::vector<Footprint> footprints = {};           ///< by geometry
};

/// For a terminal: verdict, clauses, and the cases that did not come out as they should.
[[nodiscard]] std::string conformance_text(const ConformanceReport& report, bool styled);
/// One JSON object a line: schema gonio/conformance/1, first the run, then clauses, then cases.
[[nodiscard]] std::string conformance_json_lines(const ConformanceReport& report);
/// JUnit XML: a test suite for each clause, a test case for each case; clause, verdict, level,
/// evidence and place as properties.
[[nodiscard]] std::string conformance_junit(const ConformanceReport& report);
[[nodiscard]] std::string conformance_markdown(const ConformanceReport& report);
/// A page of its own: verdict first, then clauses, then cases; charts inside, no network needed.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string conformance_page(const ConformanceReport& report);

}  // namespace gonio
