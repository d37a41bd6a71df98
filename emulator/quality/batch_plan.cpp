#include "emulator/quality/batch_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gonio {

namespace {

constexpr double nm_per_mm = 1e6;
constexpr int most_panels = 1'000'000'000;  // of all lots
constexpr int most_positions = 1000;
constexpr int most_repetitions = 1000;

PanelPlace read_place(const YamlNode& node, const PanelSize& panel) {
  const std::vector<YamlNode> both = node.list();
  if (both.size() != 2) {
    node.fail("two lengths: along the panel and across it", fmt::format("{}", both.size()));
  }
  const PanelPlace place{.x_mm = both[0].length().nanometres() / nm_per_mm,
                         .y_mm = both[1].length().nanometres() / nm_per_mm};
  const auto expect = [](const YamlNode& one, double value_mm, double side_mm) {
    if (!Range::closed(0.0, side_mm).contains(value_mm)) {
      one.fail(fmt::format("a place on the panel, from 0 mm to {:g} mm", side_mm));
    }
  };
  expect(both[0], place.x_mm, panel.length_mm);
  expect(both[1], place.y_mm, panel.width_mm);
  return place;
}

std::vector<PanelPlace> read_places(const YamlNode& node, const PanelSize& panel) {
  std::vector<PanelPlace> places;
  for (const YamlNode& item : node.list()) {
    places.push_back(read_place(item, panel));
  }
  if (places.size() > std::size_t(most_positions)) {
    node.fail(fmt::format("at most {} places", most_positions), fmt::format("{}", places.size()));
  }
  return places;
}

/// Evenly along the panel's middle line, between the margins.
std::vector<PanelPlace> evenly(int count, const PanelSize& panel) {
  std::vector<PanelPlace> places;
  for (int i = 0; i < count; ++i) {
    const double share = (i + 0.5) / count;
    places.push_back({.x_mm = panel.margin_mm + (panel.length_mm - 2.0 * panel.margin_mm) * share,
                      .y_mm = 0.5 * panel.width_mm});
  }
  return places;
}

/// On the middle line, each in the middle of the widest gap that is left along it.
std::vector<PanelPlace> between(int count, const std::vector<PanelPlace>& others,
                                const PanelSize& panel) {
  std::vector<double> taken{panel.margin_mm, panel.length_mm - panel.margin_mm};
  for (const PanelPlace& place : others) {
    taken.push_back(place.x_mm);
  }
  std::vector<PanelPlace> places;
  for (int i = 0; i < count; ++i) {
    std::ranges::sort(taken);
    std::size_t widest = 1;
    for (std::size_t k = 2; k < taken.size(); ++k) {
      // Equal gaps differ by rounding: the first one of them.
      if (taken[k] - taken[k - 1] > (taken[widest] - taken[widest - 1]) * (1.0 + 1e-9)) {
        widest = k;
      }
    }
    const double x_mm = 0.5 * (taken[widest - 1] + taken[widest]);
    places.push_back({.x_mm = x_mm, .y_mm = 0.5 * panel.width_mm});
    taken.push_back(x_mm);
  }
  return places;
}

/// Readings that the rule of a standard may ask for after `readings`.
int further_readings(const Standard& standard, int readings) {
  if (!standard.readings) {
    return 0;
  }
  const ReadingRule& rule = *standard.readings;
  const int all = rule.count.at_least + (rule.more ? rule.more->count.value_or(1) : 0);
  return std::max(0, all - readings);
}

AcceptanceRule read_acceptance(const YamlNode& node, std::uint64_t panels) {
  return node.read_map([&](YamlMap& map) {
    AcceptanceRule rule;
    if (const auto variables = map.optional("variables")) {
      rule.kind = AcceptanceRule::Kind::variables;
      rule.k = variables->number(Range::not_negative());
      if (panels < 2) {
        variables->fail("a plan of 2 panels or more of each lot", fmt::format("{}", panels));
      }
    } else if (const auto mean = map.optional("mean")) {
      rule.kind = AcceptanceRule::Kind::mean;
      (void)mean->choice({"within_limits"});
    } else {
      const YamlNode nonconforming = map.required("nonconforming_panels");
      rule.nonconforming = std::uint64_t(nonconforming.integer(0, most_panels));
      if (rule.nonconforming >= panels) {
        nonconforming.fail(fmt::format("fewer than the {} panels of a lot", panels));
      }
    }
    return rule;
  });
}

void read_counts(YamlMap& map, SamplingPlan& plan) {
  if (const auto lots = map.optional("lots")) {
    plan.lots = std::uint64_t(lots->integer(1, most_panels));
  }
  if (const auto panels = map.optional("panels")) {
    plan.panels = std::uint64_t(panels->integer(1, most_panels));
    if (plan.lots * plan.panels > std::uint64_t(most_panels)) {
      panels->fail(fmt::format("at most {} panels of all lots together", most_panels),
                   fmt::format("{}", plan.lots * plan.panels));
    }
  }
  if (const auto repetitions = map.optional("repetitions")) {
    plan.repetitions = std::uint32_t(repetitions->integer(1, most_repetitions));
  }
}

void read_positions(const std::optional<YamlNode>& node, const std::optional<YamlNode>& further,
                    const Standard& standard, const PanelSize& panel, SamplingPlan& plan) {
  const int usual = standard.readings ? standard.readings->count.at_least : 1;
  plan.positions = node && node->is_list()
                       ? read_places(*node, panel)
                       : evenly(node ? node->integer(1, most_positions) : usual, panel);
  if (further && further->is_list()) {
    plan.further_positions = read_places(*further, panel);
    return;
  }
  const int repetitions = int(plan.repetitions);
  const int readings = int(plan.positions.size()) * repetitions;
  const int asked = further_readings(standard, readings);
  plan.further_positions = between(
      further ? further->integer(0, most_positions) : (asked + repetitions - 1) / repetitions,
      plan.positions, panel);
}

}  // namespace

SamplingPlan read_sampling(const std::optional<YamlNode>& node, const Standard& standard,
                           const PanelSize& panel) {
  SamplingPlan plan;
  if (!node) {
    read_positions({}, {}, standard, panel, plan);
    return plan;
  }
  return node->read_map([&](YamlMap& map) {
    read_counts(map, plan);
    read_positions(map.optional("positions"), map.optional("further_positions"), standard, panel,
                   plan);
    if (const auto accept = map.optional("accept")) {
      plan.accept = read_acceptance(*accept, plan.panels);
    }
    if (const auto accepted_lots = map.optional("accepted_lots")) {
      plan.accepted_lots = accepted_lots->number({.low = 0.0, .high = 1.0, .low_open = true});
    }
    if (const auto share = map.optional("acceptable_share")) {
      plan.acceptable_share = share->number({.low = 0.0, .high = 1.0, .high_open = true});
    }
    return plan;
  });
}

}  // namespace gonio
