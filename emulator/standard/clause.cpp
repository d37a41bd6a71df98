#include "emulator/standard/clause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "emulator/core/unit_value.hpp"
#include "emulator/core/yaml_map.hpp"
#include "emulator/standard/setup_quantity.hpp"

namespace gonio {

namespace fs = std::filesystem;

namespace {

/// A clause as its file states it, before it is made of each geometry.
struct StatedClause {
  Clause clause;
  bool is_of_each_geometry = false;
  std::vector<std::string> geometries = {};  ///< of which it is; empty: of all
};

/// Parts of lower case letters, digits and '_', joined by '/'.
std::string clause_id(const YamlNode& node) {
  std::string id = node.text();
  const bool is_clean = std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '/';
  });
  if (!is_clean || id.front() == '/' || id.back() == '/' || id.find("//") != std::string::npos) {
    node.fail("letters a to z, digits and '_' in parts joined by '/'");
  }
  return id;
}

LimitRow read_limit(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    LimitRow limit{.quantity = map.required("quantity").id(), .mark = node.mark()};
    if (setup_quantity(limit.quantity)) {
      return limit;  // its numbers stand in standard.yaml
    }
    const auto read = [&](const std::string& key) -> std::optional<double> {
      const auto value = map.optional(key);
      if (!value) {
        return std::nullopt;
      }
      const UnitValue stated = read_unit_value(*value);
      if (!limit.unit.empty() && stated.unit != limit.unit) {
        value->fail(fmt::format("the unit {} of this limit", limit.unit));
      }
      limit.unit = stated.unit;
      return stated.value;
    };
    limit.nominal = read("nominal");
    limit.tolerance = read("tolerance");
    limit.low = read("at_least");
    limit.high = read("at_most");
    if (!limit.nominal && !limit.low && !limit.high) {
      node.fail("nominal and tolerance, at_least or at_most");
    }
    if (limit.nominal && limit.tolerance) {
      limit.low = *limit.nominal - *limit.tolerance;
      limit.high = *limit.nominal + *limit.tolerance;
    }
    limit.evidence = read_evidence(map.required("evidence"));
    return limit;
  });
}

void read_coverage(YamlMap& map, Clause& clause) {
  const YamlNode coverage = map.required("coverage");
  clause.coverage = coverage.choice({"cases", "inspection", "out_of_scope"});
  if (clause.coverage != "cases") {
    clause.reason = map.required("reason").text();
  }
}

StatedClause read_clause(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    StatedClause stated;
    Clause& clause = stated.clause;
    clause.id = clause.family = clause_id(map.required("id"));
    clause.mark = node.mark();
    clause.level = map.required("level").choice({"shall", "should", "may", "informative"});
    clause.requirement = map.required("requirement").text();
    if (const auto each = map.optional("each")) {
      stated.is_of_each_geometry = each->choice({"geometry"}) == "geometry";
      if (const auto geometries = map.optional("geometries")) {
        for (const YamlNode& geometry : geometries->list()) {
          stated.geometries.push_back(geometry.text());
        }
      }
    }
    const auto evidence = map.optional("evidence");
    if (evidence) {
      clause.evidence = read_evidence(*evidence);
    }
    if (const auto limits = map.optional("limits")) {
      for (const YamlNode& limit : limits->list()) {
        clause.limits.push_back(read_limit(limit));
        if (setup_quantity(clause.limits.back().quantity) && !stated.is_of_each_geometry) {
          limit.fail("`each: geometry` in the clause of a set-up quantity");
        }
      }
    } else if (!evidence) {
      node.fail("limits, or the evidence of the requirement itself");
    }
    read_coverage(map, clause);
    return stated;
  });
}

/// Fills in what the standard says of a set-up quantity. @return  whether it has it at all.
bool complete(LimitRow& limit, const GeometryLimits& geometry, std::string& not_applicable) {
  const SetupQuantity quantity = *setup_quantity(limit.quantity);
  limit.geometry = geometry.id;
  limit.unit = "deg";
  const Stated<Angle>* stated = limit_of(geometry, quantity);
  if (stated == nullptr) {
    const ApertureSize* size = aperture_size(geometry, quantity);
    if (size == nullptr) {
      return false;
    }
    not_applicable = fmt::format("{} is not known for this geometry", limit.quantity);
    limit.mark = size->mark;
    return true;
  }
  limit.nominal = stated_degrees(stated->nominal);
  limit.evidence = stated->evidence;
  limit.mark = stated->mark;
  if (!stated->tolerance) {
    not_applicable = fmt::format("the tolerance of {} is not known", limit.quantity);
    return true;
  }
  limit.tolerance = stated_degrees(*stated->tolerance);
  limit.low = *limit.nominal - *limit.tolerance;
  limit.high = *limit.nominal + *limit.tolerance;
  return true;
}

/// The clause of one geometry; nothing if that geometry has none of its quantities.
std::optional<Clause> clause_of(const StatedClause& stated, const GeometryLimits& geometry) {
  Clause clause = stated.clause;
  clause.geometry = geometry.id;
  clause.id = fmt::format("{}_{}", clause.family, geometry.id);
  std::vector<LimitRow> limits;
  for (LimitRow limit : clause.limits) {
    limit.geometry = geometry.id;
    if (!setup_quantity(limit.quantity) || complete(limit, geometry, clause.not_applicable)) {
      limits.push_back(std::move(limit));
    }
  }
  if (limits.empty() && !clause.limits.empty()) {
    return std::nullopt;
  }
  clause.limits = std::move(limits);
  return clause;
}

/// The weakest evidence of a clause and the limits it is judged by.
void weigh(Clause& clause) {
  for (const LimitRow& limit : clause.limits) {
    clause.evidence = Evidence::weaker(clause.evidence, limit.evidence);
  }
}

std::vector<Clause> expand(const StatedClause& stated, const ClauseSet& set) {
  std::vector<Clause> clauses;
  if (!stated.is_of_each_geometry) {
    clauses.push_back(stated.clause);
  } else if (!set.standard) {
    throw InputError(stated.clause.mark, "a standard.yaml with geometries beside this file",
                     "nothing");
  } else {
    for (const std::string& id : stated.geometries) {
      const auto& known = set.standard->geometries;
      if (std::none_of(known.begin(), known.end(), [&](const auto& g) { return g.id == id; })) {
        throw InputError(stated.clause.mark, "geometries of " + set.id, id);
      }
    }
    for (const GeometryLimits& geometry : set.standard->geometries) {
      const bool is_meant =
          stated.geometries.empty() || std::find(stated.geometries.begin(), stated.geometries.end(),
                                                 geometry.id) != stated.geometries.end();
      if (auto clause = is_meant ? clause_of(stated, geometry) : std::nullopt) {
        clauses.push_back(std::move(*clause));
      }
    }
  }
  for (Clause& clause : clauses) {
    weigh(clause);
  }
  return clauses;
}

/// Title, edition and the like: of the standard's own file, where there is one.
void read_head(YamlMap& map, const fs::path& file, const Catalog& catalog, ClauseSet& set) {
  const YamlNode id = map.required("id");
  set.id = id.line();
  set.mark = id.mark();
  const fs::path numbers = file.parent_path() / "standard.yaml";
  if (fs::is_regular_file(numbers)) {
    set.standard = load_standard(numbers, catalog);
    if (set.standard->id != set.id) {
      id.fail("the id of standard.yaml beside it, " + set.standard->id);
    }
    set.title = set.standard->title;
    set.edition = set.standard->edition;
    set.transcription = set.standard->transcription;
    set.notes = set.standard->notes;
    return;
  }
  set.title = map.required("title").line();
  set.edition = map.required("edition").line();
  set.transcription = map.required("transcription").choice({"partial", "complete"});
  if (const auto notes = map.optional("notes")) {
    set.notes = notes->text();
  }
}

}  // namespace

const LimitRow* Clause::limit(const std::string& quantity) const {
  for (const LimitRow& row : limits) {
    if (row.quantity == quantity) {
      return &row;
    }
  }
  return nullptr;
}

ClauseSet load_clauses(const fs::path& file, const Catalog& catalog) {
  return YamlNode::load(file).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/clauses/1");
    ClauseSet set;
    read_head(map, file, catalog, set);
    for (const YamlNode& cases : map.required("cases").list()) {
      set.case_files.push_back(cases.file());
    }
    std::set<std::string> ids;
    for (const YamlNode& node : map.required("clauses").list()) {
      const StatedClause stated = read_clause(node);
      if (!ids.insert(stated.clause.family).second) {
        node.fail("each clause once", stated.clause.family);
      }
      for (Clause& clause : expand(stated, set)) {
        set.clauses.push_back(std::move(clause));
      }
    }
    return set;
  });
}

std::map<std::string, std::string> load_sources(const fs::path& file) {
  return YamlNode::load(file).read_map([](YamlMap& map) {
    map.expect_schema("gonio/sources/1");
    std::map<std::string, std::string> sources;
    map.required("sources").for_each_entry([&](const std::string& key, const YamlNode& node) {
      sources[key] = node.read_map([](YamlMap& source) {
        const std::string what = source.required("what").line();
        return fmt::format("{}: {}", what, source.required("where").line());
      });
    });
    return sources;
  });
}

}  // namespace gonio
