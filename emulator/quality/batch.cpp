#include "emulator/quality/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "emulator/quality/batch_plan.hpp"
#include "emulator/quality/batch_product.hpp"
#include "emulator/quality/batch_specification.hpp"

namespace gonio {

namespace {

constexpr int most_gauge_panels = 10'000;
constexpr int most_repetitions = 1000;
constexpr int most_subgroups = 1'000'000;

/// An instrument that reads all geometries of the batch.
Instrument read_instrument(const YamlNode& node, const Catalog& catalog) {
  return load_instrument(catalog.find(Catalog::Kind::instrument, node), catalog);
}

void expect_geometries(const Instrument& instrument, const std::vector<BatchChannel>& channels,
                       const YamlNode& node) {
  for (const BatchChannel& channel : channels) {
    if (channel.kind == BatchChannel::Kind::haze) {
      continue;
    }
    if (!instrument.has(channel.geometry)) {
      node.fail(fmt::format("an instrument that has the geometry {}", channel.geometry),
                instrument.id);
    }
    (void)instrument.geometry(channel.geometry);  // fails for a size that nobody knows
  }
}

std::vector<Instrument> read_instruments(const std::optional<YamlNode>& node, const Batch& batch,
                                         const Catalog& catalog) {
  if (!node) {
    return {nominal_instrument(batch.standard)};
  }
  std::vector<Instrument> instruments;
  for (const YamlNode& item : node->list()) {
    instruments.push_back(read_instrument(item, catalog));
    expect_geometries(instruments.back(), batch.channels, item);
    const std::string& id = instruments.back().id;
    if (std::ranges::count(instruments, id, &Instrument::id) > 1) {
      item.fail("each instrument once", fmt::format("{} a second time", id));
    }
  }
  return instruments;
}

OperatorStatement read_operator(const YamlNode& node) {
  if (!node.is_map()) {
    return {.id = node.line()};
  }
  return node.read_map([](YamlMap& map) {
    OperatorStatement statement{.id = map.required("id").line()};
    if (const auto bias = map.optional("bias")) {
      statement.bias_gu = bias->gloss_gu();
    }
    if (const auto repeatability = map.optional("repeatability")) {
      statement.repeatability_gu = repeatability->gloss_gu(Range::not_negative());
    }
    return statement;
  });
}

std::vector<OperatorStatement> read_operators(const std::optional<YamlNode>& node) {
  if (!node) {
    return {{.id = "operator"}};
  }
  std::vector<OperatorStatement> operators;
  for (const YamlNode& item : node->list()) {
    operators.push_back(read_operator(item));
    const std::string& id = operators.back().id;
    if (std::ranges::count(operators, id, &OperatorStatement::id) > 1) {
      item.fail("each operator once", fmt::format("{} a second time", id));
    }
  }
  return operators;
}

DecisionStatement read_decision(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    DecisionStatement decision{.mark = node.mark()};
    if (const auto rule = map.optional("rule")) {
      decision.rule = rule->choice({"guarded", "simple"}) == "simple" ? DecisionRule::simple
                                                                      : DecisionRule::guarded;
    }
    if (const auto factor = map.optional("guard_band")) {
      decision.guard_band_factor = factor->number(Range::not_negative());
    }
    if (const auto uncertainty = map.optional("expanded_uncertainty")) {
      decision.expanded_uncertainty_gu = uncertainty->gloss_gu(Range::not_negative());
    }
    return decision;
  });
}

GaugePlan read_gauge_plan(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    GaugePlan plan;
    if (const auto panels = map.optional("panels")) {
      plan.panels = std::uint64_t(panels->integer(2, most_gauge_panels));
    }
    if (const auto repetitions = map.optional("repetitions")) {
      plan.repetitions = std::uint32_t(repetitions->integer(2, most_repetitions));
    }
    return plan;
  });
}

std::uint64_t read_baseline(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    return std::uint64_t(map.required("baseline").integer(2, most_subgroups));
  });
}

void read_specification_and_measuring(YamlMap& map, const Catalog& catalog, Batch& batch) {
  const YamlNode specification = map.required("specification");
  const auto read_with = [&](const std::optional<YamlNode>& geometries) {
    Specification read = read_specification(specification, batch.standard, geometries);
    batch.channels = std::move(read.channels);
    batch.requirements = std::move(read.requirements);
    batch.selected_only = read.selected_only;
    batch.colour_references = std::move(read.colour_references);
  };
  const auto measuring = map.optional("measuring");
  if (!measuring) {
    read_with({});
    batch.instruments = {nominal_instrument(batch.standard)};
    expect_geometries(batch.instruments.front(), batch.channels, specification);
    batch.operators = read_operators({});
    return;
  }
  measuring->read_map([&](YamlMap& inner) {
    read_with(inner.optional("geometries"));
    batch.instruments = read_instruments(inner.optional("instruments"), batch, catalog);
    batch.operators = read_operators(inner.optional("operators"));
    return true;
  });
}

/// Half of the longest one that any instrument makes in any geometry that is read.
double longest_spot_mm(const Batch& batch) {
  double half_length_mm = 0.0;
  for (const Instrument& instrument : batch.instruments) {
    for (const BatchChannel& channel : batch.channels) {
      if (instrument.has(channel.geometry)) {
        half_length_mm =
            std::max(half_length_mm, instrument.spot(channel.geometry, 0.0, 0.0).half_length_mm);
      }
    }
  }
  return half_length_mm;
}

void read_plans(YamlMap& map, Batch& batch) {
  const Product product = batch.product.value_or(Product{});
  const PanelSize panel{.length_mm = product.panel_length_mm,
                        .width_mm = product.panel_width_mm,
                        .margin_mm = std::min(longest_spot_mm(batch), product.panel_length_mm / 2)};
  batch.plan = read_sampling(map.optional("sampling"), batch.standard, panel);
  batch.decision.mark = map.node().mark();
  if (const auto decision = map.optional("decision")) {
    batch.decision = read_decision(*decision);
  }
  if (const auto gauge = map.optional("gauge_study")) {
    batch.gauge = read_gauge_plan(*gauge);
  }
  if (const auto chart = map.optional("control_chart")) {
    batch.control_baseline = read_baseline(*chart);
  }
}

}  // namespace

const Requirement* Batch::requirement(std::uint32_t channel) const {
  const auto found = std::ranges::find(requirements, channel, &Requirement::channel);
  return found == requirements.end() ? nullptr : &*found;
}

Batch load_batch(const std::filesystem::path& path, const Catalog& catalog) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/batch/1");
    Batch batch{.file = path,
                .id = map.required("id").id(),
                .title = map.required("title").line(),
                .standard = load_standard(
                    catalog.find(Catalog::Kind::standard, map.required("standard")), catalog)};
    if (const auto notes = map.optional("notes")) {
      batch.notes = notes->text();
    }
    if (const auto seed = map.optional("seed")) {
      batch.seed = std::uint64_t(seed->integer(0, std::numeric_limits<int>::max()));
    }
    if (const auto product = map.optional("product")) {
      batch.product = read_product(*product, catalog);
    }
    read_specification_and_measuring(map, catalog, batch);
    read_plans(map, batch);
    if (const auto readings = map.optional("readings")) {
      batch.measured = read_measured_format(*readings);
      expect_channels_of(batch, *readings);
    }
    return batch;
  });
}

}  // namespace gonio
