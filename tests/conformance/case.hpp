#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "emulator/core/unit_value.hpp"
#include "emulator/standard/clause.hpp"
#include "reports/conformance_report.hpp"
#include "tests/conformance/bench.hpp"
#include "tests/conformance/closed_form.hpp"

namespace gonio::conformance {

/// What was found, of one geometry or of none in particular.
struct Finding {
  std::string geometry = {};
  std::string subject = {};  ///< what was measured
  std::string unit = {};
  std::optional<double> value = {};
  double expanded_uncertainty = 0.0;
  std::string text = {};                  ///< what is no number, e.g. over_range
  std::optional<double> expected = {};    ///< where the procedure knows it, e.g. the tile's value
  std::string origin = {};                ///< of that
  std::optional<double> full_scale = {};  ///< readings above it may be over range
  std::string note = {};
};

/// What a measurement has to work with.
struct MeasurementContext {
  const ClauseSet& set;
  const Clause& clause;
  Bench& bench;  ///< of the device; evaluations do not touch it
};

/// Does what a case says under `when`.
using Measurement = std::function<std::vector<Finding>(const MeasurementContext&)>;

/// What must be found, before the limits of the clause are looked at.
struct Expectation {
  using ByGeometry = std::map<std::string, UnitValue>;
  /// Nothing: the nominal value of the clause, or what the procedure knows.
  std::variant<std::monostate, UnitValue, std::vector<std::string>, ByGeometry, PolishedArtefact>
      value = {};
  std::variant<std::monostate, UnitValue, ByGeometry> tolerance = {};  ///< nothing: the clause's
  std::string source = {};
};

/// The instrument of a control, in an order: the base, what is laid over it, what deviates.
struct GivenInstrument {
  std::string base;  ///< nominal, or a file
  std::optional<YamlNode> overlay = {};
  std::map<SetupQuantity, double> deviations = {};     ///< in tolerances of the clause's geometry
  std::map<SetupQuantity, double> uncertainties = {};  ///< expanded, in tolerances
};

/// A case of a clause, as its file states it.
struct Case {
  std::string id, clause_family, intent;
  SourceMark mark;
  CaseRole role = CaseRole::device;
  std::optional<GivenInstrument> given = {};
  std::uint64_t seed = 1;
  std::string quantity;  ///< what is measured
  Measurement measure;
  std::optional<YamlNode> exchange = {};  ///< for a protocol: what is sent and expected
  Expectation expectation = {};
  ConformanceVerdict expected = ConformanceVerdict::pass;
  std::set<std::string> samples = {};  ///< that have to be at hand
};

/// Reads a file of schema gonio/cases/1.
/// @param set  whose clauses they belong to; cases of other clauses are left out.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] std::vector<Case> load_cases(const std::filesystem::path& file, const ClauseSet& set,
                                           const Catalog& catalog);

/// The instrument of a control for a clause.
[[nodiscard]] Instrument given_instrument(const GivenInstrument& given, const ClauseSet& set,
                                          const Clause& clause, const Catalog& catalog);

}  // namespace gonio::conformance
