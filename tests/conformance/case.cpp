#include "tests/conformance/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "emulator/core/yaml_map.hpp"
#include "emulator/instrument/overlay.hpp"
#include "emulator/instrument/setup.hpp"
#include "tests/conformance/measurands.hpp"

namespace gonio::conformance {

namespace fs = std::filesystem;

namespace {

std::map<SetupQuantity, double> read_by_quantity(const YamlNode& node, const Range& range) {
  std::map<SetupQuantity, double> values;
  node.for_each_entry([&](const std::string& name, const YamlNode& value) {
    const auto quantity = setup_quantity(name);
    if (!quantity) {
      value.fail("a quantity of the set-up, e.g. theta_i or receptor_in_plane", name);
    }
    values[*quantity] = value.number(range);
  });
  return values;
}

std::optional<GivenInstrument> read_given(const YamlNode& node, const Catalog& catalog,
                                          std::uint64_t& seed) {
  return node.read_map([&](YamlMap& map) {
    std::optional<GivenInstrument> given;
    if (const auto base = map.optional("instrument")) {
      given =
          GivenInstrument{.base = base->text() == "nominal"
                                      ? "nominal"
                                      : catalog.find(Catalog::Kind::instrument, *base).string()};
    }
    const auto expect_instrument = [&](const YamlNode& key) {
      if (!given) {
        key.fail("an `instrument` to lay it over: the device under test is as it is");
      }
    };
    if (const auto overlay = map.optional("set")) {
      expect_instrument(*overlay);
      given->overlay = *overlay;
    }
    if (const auto deviate = map.optional("deviate")) {
      expect_instrument(*deviate);
      given->deviations = read_by_quantity(*deviate, Range::any());
    }
    if (const auto uncertainty = map.optional("uncertainty")) {
      expect_instrument(*uncertainty);
      given->uncertainties = read_by_quantity(*uncertainty, Range::not_negative());
    }
    if (const auto number = map.optional("seed")) {
      seed = std::uint64_t(number->integer(0, 1'000'000'000));
    }
    return given;
  });
}

Expectation::ByGeometry read_by_geometry(const YamlNode& node, const ClauseSet& set) {
  Expectation::ByGeometry values;
  node.for_each_entry([&](const std::string& id, const YamlNode& value) {
    const auto& known = set.standard ? set.standard->geometries : std::vector<GeometryLimits>{};
    if (std::none_of(known.begin(), known.end(), [&](const auto& g) { return g.id == id; })) {
      value.fail("a geometry of " + set.id + ", or fresnel", id);
    }
    values[id] = read_unit_value(value);
  });
  return values;
}

/// Whether a node holds a quantity; else it is text.
bool is_quantity(const YamlNode& node) {
  try {
    (void)read_unit_value(node);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void read_expected(const YamlNode& node, const ClauseSet& set, Expectation& expectation) {
  if (node.is_list()) {
    std::vector<std::string> texts;
    for (const YamlNode& item : node.list()) {
      texts.push_back(item.text());
    }
    expectation.value = std::move(texts);
  } else if (node.is_map()) {
    if (YamlMap(node).has("fresnel")) {
      expectation.value = node.read_map(
          [](YamlMap& map) { return read_polished_artefact(map.required("fresnel")); });
    } else {
      expectation.value = read_by_geometry(node, set);
    }
  } else if (is_quantity(node)) {
    expectation.value = read_unit_value(node);
  } else {
    expectation.value = std::vector{node.text()};
  }
}

Expectation read_then(const YamlNode& node, const ClauseSet& set) {
  return node.read_map([&](YamlMap& map) {
    Expectation expectation;
    if (const auto expected = map.optional("expect")) {
      read_expected(*expected, set, expectation);
    }
    if (const auto tolerance = map.optional("tolerance")) {
      if (tolerance->is_map()) {
        expectation.tolerance = read_by_geometry(*tolerance, set);
      } else if (tolerance->text() != "from_clause") {
        expectation.tolerance = read_unit_value(*tolerance);
      }
    }
    if (const auto source = map.optional("source")) {
      expectation.source = source->text();
    }
    return expectation;
  });
}

ConformanceVerdict read_verdict(const YamlNode& node) {
  const std::string name = node.choice({"pass", "fail", "inconclusive", "not_applicable"});
  using enum ConformanceVerdict;
  for (const ConformanceVerdict verdict : {pass, fail, inconclusive, not_applicable}) {
    if (name == verdict_name(verdict)) {
      return verdict;
    }
  }
  return pass;
}

void read_when(const YamlNode& node, Case& result) {
  node.read_map([&](YamlMap& map) {
    std::vector<std::string> names{"exchange"};
    for (const auto& [name, reader] : measurands()) {
      names.push_back(name);
    }
    result.quantity = map.required("measure").choice(names);
    if (result.quantity == "exchange") {
      result.exchange = node;
      map.ignore_others();  // read where it is known what line it goes over
      return true;
    }
    MeasurandContext context;
    result.measure = measurands().at(result.quantity)(map, context);
    result.samples = std::move(context.samples);
    if (context.is_evaluation) {
      result.role = CaseRole::evaluation;
    }
    return true;
  });
}

Case read_case(const YamlNode& node, const ClauseSet& set, const Catalog& catalog) {
  return node.read_map([&](YamlMap& map) {
    Case result;
    result.id = map.required("id").id();
    result.mark = node.mark();
    result.clause_family = map.required("clause").text();
    result.intent = map.required("intent").text();
    read_when(map.required("when"), result);
    if (const auto given = map.optional("given")) {
      result.given = read_given(*given, catalog, result.seed);
      if (result.given) {
        result.role = CaseRole::control;
      }
    }
    if (const auto then = map.optional("then")) {
      result.expectation = read_then(*then, set);
    }
    const YamlNode verdict = map.required("verdict");
    result.expected = read_verdict(verdict);
    if (result.role == CaseRole::device && result.expected != ConformanceVerdict::pass) {
      verdict.fail("pass: the device under test is not known to fail; a control has a `given`");
    }
    return result;
  });
}

/// A sample that no folder has would be found missing only when it is measured.
void expect_samples(const Case& found, const Catalog& catalog) {
  for (const std::string& sample : found.samples) {
    try {
      (void)catalog.find(Catalog::Kind::sample, sample);
    } catch (const InputError&) {
      SourceMark mark = found.mark;
      mark.key += ".when";
      throw InputError(mark, "samples that fixtures/samples has", sample);
    }
  }
}

}  // namespace

std::vector<Case> load_cases(const fs::path& file, const ClauseSet& set, const Catalog& catalog) {
  return YamlNode::load(file).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/cases/1");
    std::vector<Case> cases;
    for (const YamlNode& node : map.required("cases").list()) {
      // A shared file has clauses, and geometries, that this standard has not.
      const std::string family = YamlMap(node).required("clause").text();
      const bool is_ours = std::any_of(set.clauses.begin(), set.clauses.end(),
                                       [&](const Clause& c) { return c.family == family; });
      if (!is_ours) {
        continue;
      }
      Case found = read_case(node, set, catalog);
      expect_samples(found, catalog);
      const bool is_new = std::none_of(cases.begin(), cases.end(), [&](const Case& other) {
        return other.id == found.id && other.clause_family == found.clause_family;
      });
      if (!is_new) {
        node.fail("each case of a clause once", found.id);
      }
      cases.push_back(std::move(found));
    }
    return cases;
  });
}

Instrument given_instrument(const GivenInstrument& given, const ClauseSet& set,
                            const Clause& clause, const Catalog& catalog) {
  Instrument instrument = given.base == "nominal" ? nominal_instrument(*set.standard)
                                                  : load_instrument(given.base, catalog);
  if (given.overlay) {
    instrument = with_overlay(std::move(instrument), *given.overlay, catalog);
  }
  std::map<SetupQuantity, double> uncertainties = given.uncertainties;
  for (const auto& [quantity, tolerances] : given.deviations) {
    const LimitRow* limit = clause.limit(setup_quantity_names[std::size_t(quantity)]);
    if (limit == nullptr || !limit->tolerance) {
      continue;  // a rectangle has no diameter; such a case is judged by what there is
    }
    const auto unsure = uncertainties.find(quantity);
    instrument = with_quantity(
        std::move(instrument), *clause.geometry, quantity,
        {.value = degrees(*limit->nominal + tolerances * *limit->tolerance),
         .expanded_uncertainty =
             degrees(unsure == uncertainties.end() ? 0.0 : unsure->second * *limit->tolerance)});
  }
  return instrument;
}

}  // namespace gonio::conformance
