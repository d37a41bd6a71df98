#include "emulator/standard/reading_rule.hpp"

namespace gonio {

namespace {

constexpr int most_readings = 1000;

/// Reads a map that carries evidence: `read(map, rule)` reads what else it holds.
template <class Rule, class Read>
Rule read_rule(const YamlNode& node, Read read) {
  return node.read_map([&](YamlMap& map) {
    Rule rule{.evidence = read_evidence(map.required("evidence")), .mark = node.mark()};
    read(map, rule);
    return rule;
  });
}

ReadingRule::Count read_count(const YamlNode& node) {
  return read_rule<ReadingRule::Count>(node, [](YamlMap& map, ReadingRule::Count& rule) {
    rule.at_least = map.required("at_least").integer(1, most_readings);
  });
}

ReadingRule::More read_more(const YamlNode& node) {
  return read_rule<ReadingRule::More>(node, [](YamlMap& map, ReadingRule::More& rule) {
    rule.when_range_above_gu = map.required("when_range_above").gloss_gu(Range::positive());
    if (const auto count = map.optional("count")) {
      rule.count = count->integer(1, most_readings);
    }
  });
}

ReadingRule::NotUniform read_not_uniform(const YamlNode& node) {
  return read_rule<ReadingRule::NotUniform>(node, [](YamlMap& map, ReadingRule::NotUniform& rule) {
    rule.when_share_above = map.required("when_share_above").number(Range::positive());
  });
}

ReadingRule::Reject read_reject(const YamlNode& node) {
  return read_rule<ReadingRule::Reject>(node, [](YamlMap& map, ReadingRule::Reject& rule) {
    if (const auto range = map.optional("range_at_least")) {
      rule.range_at_least_gu = range->gloss_gu(Range::positive());
    }
    const auto share = rule.range_at_least_gu ? map.optional("share_at_least")
                                              : std::optional(map.required("share_at_least"));
    if (share) {
      rule.share_at_least = share->number(Range::positive());
    }
  });
}

ReadingRule::Report read_report(const YamlNode& node) {
  return read_rule<ReadingRule::Report>(node, [](YamlMap& map, ReadingRule::Report& rule) {
    for (const YamlNode& value : map.required("values").list()) {
      rule.values.push_back(value.choice({"mean", "range"}));
    }
  });
}

}  // namespace

ReadingRule read_reading_rule(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    ReadingRule rule{.count = read_count(map.required("count"))};
    if (const auto more = map.optional("more")) {
      rule.more = read_more(*more);
    }
    if (const auto not_uniform = map.optional("not_uniform")) {
      rule.not_uniform = read_not_uniform(*not_uniform);
    }
    if (const auto reject = map.optional("reject")) {
      rule.reject = read_reject(*reject);
    }
    if (const auto report = map.optional("report")) {
      rule.report = read_report(*report);
    }
    return rule;
  });
}

}  // namespace gonio
