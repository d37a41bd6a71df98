#include "emulator/quality/batch_specification.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "emulator/quality/limit_text.hpp"

namespace gonio {

namespace {

struct Limits {
  LimitText text;
  SourceMark mark;
  std::optional<std::array<double, 3>> reference = {};
};

/// By geometry, or by rule.
using LimitsById = std::map<std::string, Limits>;

/// What a map `specification` states, before it is known what is read.
struct StatedLimits {
  LimitsById gloss, haze, colour;
};

std::vector<std::string> geometry_ids(const Standard& standard) {
  std::vector<std::string> ids;
  for (const GeometryLimits& geometry : standard.geometries) {
    ids.push_back(geometry.id);
  }
  return ids;
}

void expect_known(const std::vector<std::string>& known, const std::string& id, const char* what,
                  const YamlNode& node) {
  if (std::ranges::find(known, id) == known.end()) {
    node.fail(known.empty() ? fmt::format("a standard that has {}", what)
                            : fmt::format("one of the {} {}", what, fmt::join(known, ", ")),
              id);
  }
}

/// Calls read(value) for each entry. @param known  names that the entries may have.
template <class Read>
LimitsById read_each(const YamlNode& node, const std::vector<std::string>& known, const char* what,
                     Read read) {
  LimitsById result;
  node.for_each_entry([&](const std::string& key, const YamlNode& value) {
    const std::string id = geometry_of(key);
    expect_known(known, id, what, value);
    if (!result.emplace(id, read(value)).second) {
      value.fail("each of them once", fmt::format("{} a second time", id));
    }
  });
  if (result.empty()) {
    node.fail(fmt::format("limits of one of the {}", what), "none");
  }
  return result;
}

/// Of a quantity that is never negative.
Limits read_not_negative(const YamlNode& node, const std::string& unit) {
  const LimitText text = read_limit_text(node, unit);
  if (text.limits.high && !(*text.limits.high > 0.0)) {
    node.fail("an upper limit > 0");
  }
  return {.text = text, .mark = node.mark()};
}

std::array<double, 3> read_reference(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    return std::array{map.required("L").number(Range::not_negative()), map.required("a").number(),
                      map.required("b").number()};
  });
}

Limits read_colour(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    Limits limits = read_not_negative(map.required("difference"), "");
    if (const auto reference = map.optional("reference")) {
      limits.reference = read_reference(*reference);
    }
    return limits;
  });
}

StatedLimits read_stated(YamlMap& map, const Standard& standard) {
  const std::vector<std::string> geometries = geometry_ids(standard);
  StatedLimits stated;
  if (const auto gloss = map.optional("gloss")) {
    stated.gloss = read_each(*gloss, geometries, "geometries", [&](const YamlNode& value) {
      return read_not_negative(value, standard.scale.unit);
    });
  }
  if (const auto haze = map.optional("haze")) {
    std::vector<std::string> rules;
    for (const HazeRule& rule : standard.haze) {
      rules.push_back(rule.id);
    }
    stated.haze = read_each(*haze, rules, "rules for haze", [&](const YamlNode& value) {
      return Limits{.text = read_limit_text(value, standard.scale.unit), .mark = value.mark()};
    });
  }
  if (const auto colour = map.optional("colour")) {
    stated.colour = read_each(*colour, geometries, "geometries", read_colour);
  }
  if (stated.gloss.empty() && stated.haze.empty() && stated.colour.empty()) {
    map.node().fail("limits: one of the keys gloss, haze, colour", "none");
  }
  return stated;
}

/// The geometries that a standard may select.
std::set<std::string> selectable(const Standard& standard) {
  std::set<std::string> geometries{standard.selection->first};
  for (const SelectionRule& rule : standard.selection->rules) {
    geometries.insert(rule.geometry);
  }
  return geometries;
}

bool read_selected_only(const YamlNode& node, const Standard& standard, const LimitsById& gloss) {
  if (!node.boolean()) {
    return false;
  }
  if (!standard.selection) {
    node.fail(fmt::format("false, since {} selects no geometry", standard.id));
  }
  for (const std::string& geometry : selectable(standard)) {
    if (!gloss.contains(geometry)) {
      node.fail(fmt::format("limits of gloss in each geometry that may be selected: {}",
                            fmt::join(selectable(standard), ", ")),
                fmt::format("none for {}", geometry));
    }
  }
  return true;
}

std::set<std::string> needed_geometries(const StatedLimits& stated, const Standard& standard) {
  std::set<std::string> needed;
  for (const LimitsById* limits : {&stated.gloss, &stated.colour}) {
    for (const auto& entry : *limits) {
      needed.insert(entry.first);
    }
  }
  for (const HazeRule& rule : standard.haze) {
    if (stated.haze.contains(rule.id)) {
      needed.insert({rule.from, rule.minus});
    }
  }
  return needed;
}

std::set<std::string> read_geometries(const YamlNode& node, const Standard& standard,
                                      const std::set<std::string>& needed) {
  std::set<std::string> read;
  for (const YamlNode& item : node.list()) {
    const std::string id = geometry_of(item.text());
    expect_known(geometry_ids(standard), id, "geometries", item);
    if (!read.insert(id).second) {
      item.fail("each geometry once");
    }
  }
  for (const std::string& id : needed) {
    if (!read.contains(id)) {
      node.fail(fmt::format("'{}' too, which the specification needs", id), "none");
    }
  }
  return read;
}

/// Adds a channel, and what it has to keep.
void add(Specification& specification, BatchChannel channel, const LimitsById& limits,
         const std::string& id) {
  const auto found = limits.find(id);
  specification.colour_references.emplace_back();
  if (found != limits.end()) {
    specification.requirements.push_back({.channel = std::uint32_t(specification.channels.size()),
                                          .limits = found->second.text.limits,
                                          .target = found->second.text.target,
                                          .mark = found->second.mark});
    specification.colour_references.back() = found->second.reference;
  }
  specification.channels.push_back(std::move(channel));
}

void add_channels(Specification& specification, const StatedLimits& stated,
                  const Standard& standard, const std::set<std::string>& read) {
  using enum BatchChannel::Kind;
  const std::string& unit = standard.scale.unit;
  for (const std::string& id : geometry_ids(standard)) {
    if (read.contains(id)) {
      add(specification, {.id = id, .geometry = id, .kind = gloss, .unit = unit}, stated.gloss, id);
    }
  }
  for (const std::string& id : geometry_ids(standard)) {
    if (stated.colour.contains(id)) {
      add(specification,
          {.id = id + "/colour", .geometry = id, .kind = colour_difference, .unit = {}},
          stated.colour, id);
    }
  }
  for (const HazeRule& rule : standard.haze) {
    if (stated.haze.contains(rule.id)) {
      add(specification, {.id = rule.id, .geometry = {}, .kind = haze, .unit = unit}, stated.haze,
          rule.id);
    }
  }
}

}  // namespace

std::string geometry_of(const std::string& key) {
  constexpr std::string_view unit = " deg";
  return key.ends_with(unit) ? key.substr(0, key.size() - unit.size()) : key;
}

Specification read_specification(const YamlNode& node, const Standard& standard,
                                 const std::optional<YamlNode>& geometries) {
  return node.read_map([&](YamlMap& map) {
    const StatedLimits stated = read_stated(map, standard);
    Specification specification;
    if (const auto selected_only = map.optional("selected_only")) {
      specification.selected_only = read_selected_only(*selected_only, standard, stated.gloss);
    }
    const std::set<std::string> needed = needed_geometries(stated, standard);
    add_channels(specification, stated, standard,
                 geometries ? read_geometries(*geometries, standard, needed) : needed);
    return specification;
  });
}

}  // namespace gonio
