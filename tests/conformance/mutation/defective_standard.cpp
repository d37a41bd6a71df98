#include "tests/conformance/mutation/defective_standard.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gonio::conformance {

namespace {

using Reader = StandardDefect (*)(const YamlNode&);

/// A rule that the standard must have.
template <class Rule>
Rule& there(std::optional<Rule>& rule, const char* what) {
  if (!rule) {
    throw std::invalid_argument(std::string("the standard has no rule: ") + what);
  }
  return *rule;
}

StandardDefect rounding(const YamlNode& node) {
  return [step = node.gloss_gu(Range::positive())](Standard& standard) {
    there(standard.rounding, "rounding").nominal = step;
  };
}

StandardDefect refractive_index(const YamlNode& node) {
  return [n = node.number(Range::positive())](Standard& standard) {
    there(standard.scale.refractive_index, "refractive index").nominal = n;
  };
}

StandardDefect scale_value(const YamlNode& node) {
  return [value = node.number(Range::positive())](Standard& standard) {
    standard.scale.value.nominal = value;
  };
}

StandardDefect select_above(const YamlNode& node) {
  return [limit = node.gloss_gu()](Standard& standard) {
    for (SelectionRule& rule : there(standard.selection, "selection").rules) {
      rule.when_above = rule.when_above ? std::optional(limit) : std::nullopt;
    }
  };
}

StandardDefect select_below(const YamlNode& node) {
  return [limit = node.gloss_gu()](Standard& standard) {
    for (SelectionRule& rule : there(standard.selection, "selection").rules) {
      rule.when_below = rule.when_below ? std::optional(limit) : std::nullopt;
    }
  };
}

/// A flag that can only be true: it says what is wrong.
template <void (*change)(Standard&)>
StandardDefect flag(const YamlNode& node) {
  if (!node.boolean()) {
    node.fail("true");
  }
  return change;
}

void swap_selection(Standard& standard) {
  auto& rules = there(standard.selection, "selection").rules;
  std::swap(rules.front().geometry, rules.back().geometry);
}

void swap_haze(Standard& standard) {
  for (HazeRule& rule : standard.haze) {
    std::swap(rule.from, rule.minus);
  }
}

void drop_haze_limit(Standard& standard) {
  for (HazeRule& rule : standard.haze) {
    rule.only_above.reset();
  }
}

StandardDefect at_least(const YamlNode& node) {
  return [n = node.integer(1, 99)](Standard& standard) {
    there(standard.readings, "readings").count.at_least = n;
  };
}

StandardDefect more_above(const YamlNode& node) {
  return [range = node.gloss_gu()](Standard& standard) {
    there(there(standard.readings, "readings").more, "more readings").when_range_above_gu = range;
  };
}

StandardDefect not_uniform_above(const YamlNode& node) {
  return [share = node.number(Range::positive())](Standard& standard) {
    there(there(standard.readings, "readings").not_uniform, "uniformity").when_share_above = share;
  };
}

void drop_rejection(Standard& standard) { there(standard.readings, "readings").reject.reset(); }

const std::vector<std::pair<std::string, Reader>>& readers() {
  static const std::vector<std::pair<std::string, Reader>> all{
      {"rounding", rounding},
      {"refractive_index", refractive_index},
      {"scale_value", scale_value},
      {"select_above", select_above},
      {"select_below", select_below},
      {"selection_swapped", flag<swap_selection>},
      {"haze_swapped", flag<swap_haze>},
      {"haze_without_limit", flag<drop_haze_limit>},
      {"readings_at_least", at_least},
      {"more_readings_above", more_above},
      {"not_uniform_above", not_uniform_above},
      {"rejection_missing", flag<drop_rejection>}};
  return all;
}

}  // namespace

StandardDefect read_standard_defect(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    std::vector<StandardDefect> changes;
    for (const auto& [key, read] : readers()) {
      if (const auto value = map.optional(key)) {
        changes.push_back(read(*value));
      }
    }
    return [changes](Standard& standard) {
      for (const StandardDefect& change : changes) {
        change(standard);
      }
    };
  });
}

}  // namespace gonio::conformance
