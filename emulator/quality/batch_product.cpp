#include "emulator/quality/batch_product.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "emulator/surface/sample.hpp"
#include "emulator/uncertainty/input_set.hpp"

namespace gonio {

namespace {

using Shape = Distribution::Shape;

constexpr double nm_per_mm = 1e6;
constexpr double largest_panel_mm = 10'000.0;

const std::vector<std::string>& parameter_names() {
  static const std::vector<std::string> names(sample_parameter_names.begin(),
                                              sample_parameter_names.end());
  return names;
}

std::size_t parameter_in(const YamlNode& node) {
  const std::string name = node.choice(parameter_names());
  return std::size_t(std::ranges::find(parameter_names(), name) - parameter_names().begin());
}

/// A standard deviation of a normal distribution, or a map of what is bounded.
Distribution read_level(const YamlNode& node) {
  if (!node.is_map()) {
    return {.standard_uncertainty = node.number(Range::not_negative())};
  }
  return node.read_map([](YamlMap& map) {
    const double half_width = map.required("half_width").number(Range::not_negative());
    const auto name = map.optional("distribution");
    const std::string shape =
        name ? name->choice({"rectangular", "triangular", "arcsine"}) : "rectangular";
    return Distribution::bounded(shape == "rectangular"  ? Shape::rectangular
                                 : shape == "triangular" ? Shape::triangular
                                                         : Shape::arcsine,
                                 half_width);
  });
}

ParameterSpread read_parameter_spread(const YamlNode& node) {
  return node.read_map([](YamlMap& map) {
    ParameterSpread spread;
    if (const auto lots = map.optional("lots")) {
      spread.lots = read_level(*lots);
    }
    if (const auto panels = map.optional("panels")) {
      spread.panels = read_level(*panels);
    }
    if (const auto within_panel = map.optional("within_panel")) {
      spread.within_panel = within_panel->number(Range::not_negative());
    }
    return spread;
  });
}

/// Calls read(place, value) for each parameter that a map names.
template <class Read>
void read_parameters(const YamlNode& node, Read read) {
  node.read_map([&](YamlMap& map) {
    for (std::size_t i = 0; i < sample_parameter_count; ++i) {
      if (const auto value = map.optional(sample_parameter_names[i])) {
        read(i, *value);
      }
    }
    return true;
  });
}

bool is_normal(const ParameterSpread& spread) {
  return spread.lots.shape == Shape::normal && spread.panels.shape == Shape::normal;
}

ProductCorrelation read_correlation(const YamlNode& node, const Product& product) {
  return node.read_map([&](YamlMap& map) {
    const YamlNode between = map.required("between");
    const std::vector<YamlNode> pair = between.list();
    if (pair.size() != 2) {
      between.fail("a list of two parameters", fmt::format("{}", pair.size()));
    }
    const ProductCorrelation correlation{
        .a = parameter_in(pair[0]),
        .b = parameter_in(pair[1]),
        .coefficient = map.required("coefficient").number(Range::closed(-1.0, 1.0))};
    if (correlation.a == correlation.b) {
      pair[1].fail("another parameter");
    }
    for (const YamlNode& one : pair) {
      const ParameterSpread& spread = product.spread[parameter_in(one)];
      if (!is_normal(spread)) {
        one.fail("a parameter whose spread is normal in lots and panels");
      }
      if (spread.total() == 0.0) {
        one.fail("a parameter that varies");
      }
    }
    return correlation;
  });
}

void expect_positive_definite(const YamlNode& node,
                              const std::vector<ProductCorrelation>& correlations) {
  InputSet set;
  for (const char* name : sample_parameter_names) {
    set.add({.id = name, .distribution = {.standard_uncertainty = 1.0}});
  }
  for (const ProductCorrelation& correlation : correlations) {
    set.correlate(correlation.a, correlation.b, correlation.coefficient);
  }
  if (const double smallest = set.smallest_eigenvalue();
      !(smallest > InputSet::positive_definite)) {
    node.fail("a correlation matrix that is positive definite",
              fmt::format("a smallest eigenvalue of {:.3g}", smallest));
  }
}

std::vector<ProductCorrelation> read_correlations(const YamlNode& node, const Product& product) {
  std::vector<ProductCorrelation> correlations;
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (const YamlNode& item : node.list()) {
    correlations.push_back(read_correlation(item, product));
    const ProductCorrelation& last = correlations.back();
    if (!seen.insert(std::minmax(last.a, last.b)).second) {
      item.fail("each pair once",
                fmt::format("{} and {} a second time", sample_parameter_names[last.a],
                            sample_parameter_names[last.b]));
    }
  }
  expect_positive_definite(node, correlations);
  return correlations;
}

double read_side_mm(const YamlNode& node) {
  const double side_mm = node.length(Range::positive()).nanometres() / nm_per_mm;
  if (side_mm > largest_panel_mm) {
    node.fail("a length of at most 10000 mm");
  }
  return side_mm;
}

/// As the batch states, unless the sample states a panel of its own.
void read_panel(YamlMap& map, Product& product) {
  const Sample sample = load_sample(product.sample, WavelengthGrid::visible());
  const auto panel = map.optional("panel");
  if (sample.panel) {
    if (panel) {
      panel->fail(fmt::format("nothing, since {} states its panel itself", sample.id));
    }
    product.panel_length_mm = sample.panel->layout->length_mm;
    product.panel_width_mm = sample.panel->layout->width_mm;
  } else if (panel) {
    panel->read_map([&](YamlMap& sides) {
      product.panel_length_mm = read_side_mm(sides.required("length"));
      product.panel_width_mm = read_side_mm(sides.required("width"));
      return true;
    });
  }
}

}  // namespace

double ParameterSpread::total() const {
  return std::hypot(lots.standard_uncertainty, panels.standard_uncertainty, within_panel);
}

Product read_product(const YamlNode& node, const Catalog& catalog) {
  return node.read_map([&](YamlMap& map) {
    Product product{.sample = catalog.find(Catalog::Kind::sample, map.required("sample")),
                    .mark = node.mark()};
    if (const auto offset = map.optional("offset")) {
      read_parameters(*offset, [&](std::size_t i, const YamlNode& value) {
        product.offset[i] = value.number();
      });
    }
    if (const auto spread = map.optional("spread")) {
      read_parameters(*spread, [&](std::size_t i, const YamlNode& value) {
        product.spread[i] = read_parameter_spread(value);
      });
    }
    if (const auto correlations = map.optional("correlations")) {
      product.correlations = read_correlations(*correlations, product);
    }
    if (const auto length = map.optional("correlation_length")) {
      product.correlation_length_mm = length->length(Range::positive()).nanometres() / nm_per_mm;
    }
    read_panel(map, product);
    return product;
  });
}

}  // namespace gonio
