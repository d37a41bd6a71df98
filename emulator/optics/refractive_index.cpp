#include "emulator/optics/refractive_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "emulator/core/table.hpp"
#include "emulator/optics/dispersion_formula.hpp"

namespace gonio {

namespace {

/// n or k over the wavelengths that one block of a file covers.
struct Part {
  std::function<Eigen::ArrayXd(const WavelengthGrid&)> values;
  Wavelength first;
  Wavelength last;
};

struct Material {
  std::optional<Part> n;
  std::optional<Part> k;
};

std::function<Eigen::ArrayXd(const WavelengthGrid&)> same_everywhere(double value) {
  return [value](const WavelengthGrid& grid) {
    return Eigen::ArrayXd(Eigen::ArrayXd::Constant(grid.size(), value));
  };
}

/// Above this nothing can be computed, and no material reflects visible light like that.
constexpr double largest = 1000.0;

Range n_range() { return {.low = 0.0, .high = largest, .low_open = true}; }
Range k_range() { return Range::closed(0.0, largest); }

bool is_refractive_index(double n, double k) {
  return n_range().contains(n) && k_range().contains(k);
}

std::string expected_index() {
  return fmt::format("n{} and k{}", n_range().text(), k_range().text());
}

std::vector<double> numbers_in(const std::string& line, const SourceMark& mark) {
  std::vector<double> numbers;
  std::istringstream cells(line);
  for (std::string cell; cells >> cell;) {
    const auto value = parse_quantity(cell, Dimension::number);
    if (!value) {
      throw InputError(mark, "numbers", cell);
    }
    numbers.push_back(*value);
  }
  return numbers;
}

/// Rows of a table by wavelength [nm]; the values at one wavelength follow each other.
using Rows = std::multimap<double, std::vector<double>>;

/// @param n_values  how many numbers follow the wavelength in each row.
Rows read_rows(const YamlNode& data, std::size_t n_values) {
  const std::string text = data.text();
  SourceMark mark = data.mark();
  if (text.find('\n') != std::string::npos) {
    mark.column = 1;  // the text begins on the line below `data: |`, without its indentation
  } else {
    --mark.line;
  }
  Rows rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    ++mark.line;
    const std::vector<double> row = numbers_in(line, mark);
    if (row.empty()) {
      continue;
    }
    if (row.size() != n_values + 1) {
      throw InputError(mark, fmt::format("{} numbers", n_values + 1), line);
    }
    if (row.front() <= 0.0) {
      throw InputError(mark, "a wavelength > 0", line);
    }
    rows.emplace(micrometres(row.front()).nanometres(),
                 std::vector<double>(row.begin() + 1, row.end()));
  }
  if (rows.empty()) {
    data.fail("rows of numbers", "none");
  }
  return rows;
}

/// The curve through value number `i` of the rows; their mean where a wavelength has several.
Part tabulated_part(const Rows& rows, std::size_t i, const SourceMark& mark) {
  std::vector<double> wavelength_nm;
  std::vector<double> value;
  for (auto row = rows.begin(); row != rows.end();) {
    const auto next = rows.upper_bound(row->first);
    wavelength_nm.push_back(row->first);
    const auto count = double(std::distance(row, next));
    double sum = 0.0;
    for (; row != next; ++row) {
      sum += row->second[i];
    }
    value.push_back(sum / count);
  }
  const auto array = [](const std::vector<double>& v) {
    return Eigen::ArrayXd(Eigen::Map<const Eigen::ArrayXd>(v.data(), Eigen::Index(v.size())));
  };
  const SpectralTable table(array(wavelength_nm), array(value), mark);
  return {.values = [table](const WavelengthGrid& grid) { return table.sample(grid); },
          .first = table.first(),
          .last = table.last()};
}

Material read_table(const YamlNode& data, bool has_n, bool has_k) {
  const Rows rows = read_rows(data, has_n && has_k ? 2 : 1);
  Material material;
  if (has_n) {
    material.n = tabulated_part(rows, 0, data.mark());
  }
  if (has_k) {
    material.k = tabulated_part(rows, has_n ? 1 : 0, data.mark());
  }
  return material;
}

Material read_formula(YamlMap& block, int number) {
  const YamlNode coefficients = block.required("coefficients");
  const std::vector<double> c = numbers_in(coefficients.text(), coefficients.mark());
  const std::size_t most = DispersionFormula::most_coefficients(number);
  if (c.empty() || c.size() > most) {
    coefficients.fail(fmt::format("1 to {} coefficients", most));
  }
  const auto older_name = block.optional("range");
  const YamlNode range = older_name ? *older_name : block.required("wavelength_range");
  const std::vector<double> ends_um = numbers_in(range.text(), range.mark());
  if (ends_um.size() != 2 || !(ends_um[0] > 0.0) || !(ends_um[1] > ends_um[0])) {
    range.fail("two wavelengths, 0 < first < last");
  }
  const auto curve = [formula = DispersionFormula(number, c)](const WavelengthGrid& grid) {
    return Eigen::ArrayXd(grid.nanometres().unaryExpr(
        [&](double lambda_nm) { return formula.at(nanometres(lambda_nm)); }));
  };
  return {.n = Part{curve, micrometres(ends_um[0]), micrometres(ends_um[1])}, .k = {}};
}

Material read_block(const YamlNode& node) {
  return node.read_map([](YamlMap& block) {
    block.ignore_others();
    const std::string type = block.required("type").choice(
        {"tabulated nk", "tabulated n", "tabulated k", "formula 1", "formula 2", "formula 3",
         "formula 4", "formula 5", "formula 6", "formula 7", "formula 8", "formula 9"});
    if (type.starts_with("formula")) {
      return read_formula(block, type.back() - '0');
    }
    return read_table(block.required("data"), type != "tabulated k", type != "tabulated n");
  });
}

/// Takes over what a block gives.
void add(std::optional<Part>& sum, std::optional<Part> part, char symbol, const YamlNode& block) {
  if (sum && part) {
    block.fail(fmt::format("one block that gives {}", symbol), "a second one");
  }
  if (part) {
    sum = std::move(part);
  }
}

Material read_material(const YamlNode& file) {
  return file.read_map([](YamlMap& map) {
    map.ignore_others();
    const YamlNode data = map.required("DATA");
    Material material;
    for (const YamlNode& node : data.list()) {
      Material block = read_block(node);
      add(material.n, std::move(block.n), 'n', node);
      add(material.k, std::move(block.k), 'k', node);
    }
    if (!material.n) {
      data.fail("a block that gives n", "none");
    }
    return material;
  });
}

}  // namespace

RefractiveIndex RefractiveIndex::constant(std::complex<double> n_hat) {
  if (!is_refractive_index(n_hat.real(), n_hat.imag())) {
    throw std::domain_error(fmt::format("RefractiveIndex: n = {}, k = {}; needs {}", n_hat.real(),
                                        n_hat.imag(), expected_index()));
  }
  RefractiveIndex index;
  index.n_ = same_everywhere(n_hat.real());
  index.k_ = same_everywhere(n_hat.imag());
  index.last_ = nanometres(std::numeric_limits<double>::infinity());
  return index;
}

RefractiveIndex RefractiveIndex::load(const std::filesystem::path& path) {
  return load(path, {.file = path.string(), .line = 0, .column = 0, .key = {}});
}

RefractiveIndex RefractiveIndex::load(const std::filesystem::path& path, const SourceMark& blamed) {
  const Material material = read_material(YamlNode::load(path));
  RefractiveIndex index;
  index.n_ = material.n->values;
  index.k_ = material.k ? material.k->values : same_everywhere(0.0);
  index.first_ = material.k ? std::max(material.n->first, material.k->first) : material.n->first;
  index.last_ = material.k ? std::min(material.n->last, material.k->last) : material.n->last;
  index.mark_ = blamed;
  return index;
}

RefractiveIndex RefractiveIndex::read(const YamlNode& node) {
  if (node.is_scalar()) {
    return constant(node.number(n_range()));
  }
  if (!node.is_map()) {
    node.fail("a number, {n: ..., k: ...} or {file: ...}");
  }
  return node.read_map([](YamlMap& map) {
    if (const auto file = map.optional("file")) {
      return load(file->file(), file->mark());
    }
    const double n = map.required("n").number(n_range());
    return constant({n, map.required("k").number(k_range())});
  });
}

std::complex<double> RefractiveIndex::at(Wavelength lambda) const {
  return sample(WavelengthGrid(lambda, Length(), 1))(0);
}

Eigen::ArrayXcd RefractiveIndex::sample(const WavelengthGrid& grid) const {
  expect_coverage(grid, first_, last_, mark_);
  const Eigen::ArrayXd n = n_(grid);
  const Eigen::ArrayXd k = k_(grid);
  Eigen::ArrayXcd n_hat(grid.size());
  for (Eigen::Index i = 0; i < grid.size(); ++i) {
    if (!is_refractive_index(n(i), k(i))) {
      throw InputError(
          mark_, expected_index(),
          fmt::format("n = {:g}, k = {:g} at {:g} nm", n(i), k(i), grid.nanometres()(i)));
    }
    n_hat(i) = {n(i), k(i)};
  }
  return n_hat;
}

}  // namespace gonio
