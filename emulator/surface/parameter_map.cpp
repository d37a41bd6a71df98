#include "emulator/surface/parameter_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "emulator/core/csv_cell.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/surface/grey_image.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXXd;
using Eigen::Index;

/// Where a place lies between two cells of a row or a column.
struct Between {
  Index below, above;
  double share;  ///< of the one above
};

Between between(double place, double size, Index cells) {
  const double cell = std::clamp(place / size * double(cells) - 0.5, 0.0, double(cells - 1));
  const Index below = std::min(Index(cell), cells - 1);
  return {below, std::min(below + 1, cells - 1), cell - double(below)};
}

ArrayXXd load_grid(const std::filesystem::path& path) {
  const auto place = [&](int line, int column) {
    return SourceMark{.file = path.string(), .line = line, .column = column, .key = {}};
  };
  std::vector<double> values;
  std::size_t columns = 0;
  const std::string text = read_text_file(path);
  for_each_csv_row(text, [&](const std::vector<CsvCell>& cells, int line) {
    columns = columns == 0 ? cells.size() : columns;
    if (cells.size() != columns) {
      throw InputError(place(line, 1), fmt::format("{} numbers as in the first row", columns),
                       fmt::format("{}", cells.size()));
    }
    for (const CsvCell& cell : cells) {
      const auto value = parse_quantity(cell.text, Dimension::number);
      if (!value) {
        throw InputError(place(line, cell.column), "a number",
                         cell.text.empty() ? "nothing" : std::string(cell.text));
      }
      values.push_back(*value);
    }
  });
  if (values.empty()) {
    throw InputError(place(0, 0), "rows of numbers", "none");
  }
  using RowMajor = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), Index(values.size() / columns), Index(columns));
}

}  // namespace

ParameterMap::ParameterMap(ArrayXXd values, double length_mm, double width_mm)
    : values_(std::move(values)), length_mm_(length_mm), width_mm_(width_mm) {}

double ParameterMap::at(double x_mm, double y_mm) const {
  const Between x = between(x_mm, length_mm_, values_.cols());
  const Between y = between(y_mm, width_mm_, values_.rows());
  return std::lerp(std::lerp(values_(y.below, x.below), values_(y.below, x.above), x.share),
                   std::lerp(values_(y.above, x.below), values_(y.above, x.above), x.share),
                   y.share);
}

double ParameterMap::pitch_mm() const {
  return std::min(length_mm_ / double(values_.cols()), width_mm_ / double(values_.rows()));
}

ArrayXXd read_map_values(const YamlNode& node) {
  return node.read_map([](YamlMap& map) -> ArrayXXd {
    const std::filesystem::path path = map.required("file").file();
    if (path.extension() != ".png" && path.extension() != ".csv") {
      map.required("file").fail("a file that ends with .png or .csv");
    }
    if (path.extension() == ".csv") {
      return load_grid(path);
    }
    const double black = map.required("black").number();
    const double white = map.required("white").number();
    return black + (white - black) * load_grey_image(path);
  });
}

}  // namespace gonio
