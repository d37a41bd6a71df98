#include "emulator/goniometry/acquisition.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Integration times that differ by less than this share are one.
constexpr double same_time = 1e-6;

char read_choice(const YamlNode& node, const std::vector<std::pair<std::string, char>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    names.push_back(name);
  }
  const std::string chosen = node.choice(names);
  for (const auto& [name, value] : choices) {
    if (name == chosen) {
      return value;
    }
  }
  return choices.front().second;
}

CountsFormat read_format(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    CountsFormat format;
    if (const auto delimiter = map.optional("delimiter")) {
      format.delimiter =
          read_choice(*delimiter, {{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}});
    }
    if (const auto decimal = map.optional("decimal")) {
      format.decimal = read_choice(*decimal, {{"point", '.'}, {"comma", ','}});
    }
    if (format.delimiter == format.decimal) {
      node.fail("another decimal than the delimiter", "a comma for both");
    }
    return format;
  });
}

Detector read_detector(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    Detector detector;
    detector.saturation = map.required("saturation").number(Range::positive());
    detector.linear_up_to = detector.saturation;
    if (const auto linear = map.optional("linear_up_to")) {
      detector.linear_up_to =
          linear->number({.low = 0.0, .high = detector.saturation, .low_open = true});
    }
    if (const auto noise = map.optional("read_noise")) {
      detector.read_noise = noise->number(Range::positive());
    }
    if (const auto electrons = map.optional("electrons_per_count")) {
      detector.electrons_per_count = electrons->number(Range::positive());
    }
    return detector;
  });
}

WavelengthGrid read_grid(const YamlNode& node) {
  return node.read_map([&](YamlMap& map) {
    const Range range = Range::positive();
    const double first = map.required("first").length(range).nanometres();
    const double last = map.required("last").length(range).nanometres();
    const double step = map.required("step").length(range).nanometres();
    const double steps = std::round((last - first) / step);
    constexpr double most_steps = 100'000.0;
    if (!(steps >= 1.0) || steps > most_steps || std::abs(first + steps * step - last) > 1e-6) {
      node.fail("`last` a whole number of steps beyond `first`");
    }
    return WavelengthGrid(nanometres(first), nanometres(step), Index(steps) + 1);
  });
}

/// `{counts: file, integration_time: 20 ms}`.
TimedCounts read_counts(const YamlNode& node, const CountsFormat& format) {
  return node.read_map([&](YamlMap& map) {
    return TimedCounts{.counts = load_counts(map.required("counts").file(), format),
                       .time_s = map.required("integration_time").time_s(Range::positive()),
                       .mark = node.mark()};
  });
}

/// The wavelengths of the pixels: sum of c_k p^k, or the axis itself.
ArrayXd wavelengths_of(const ArrayXd& axis, const std::vector<double>& coefficients,
                       const SourceMark& mark) {
  if (coefficients.empty()) {
    if (!(axis(0) > 0.0)) {
      throw InputError(mark, "wavelengths > 0 nm, or a wavelength_calibration of pixels",
                       fmt::format("{}", axis(0)));
    }
    return axis;
  }
  ArrayXd lambda = ArrayXd::Zero(axis.size());
  for (std::size_t k = coefficients.size(); k-- > 0;) {
    lambda = lambda * axis + coefficients[k];
  }
  const Index n = lambda.size();
  if (!(lambda.tail(n - 1) > lambda.head(n - 1)).all() || !(lambda(0) > 0.0)) {
    throw InputError(mark, "wavelengths > 0 nm that ascend with the pixels",
                     fmt::format("{} to {} nm", lambda(0), lambda(n - 1)));
  }
  return lambda;
}

/// Reads the parts of an acquisition that lean on one another.
class AcquisitionReader {
 public:
  explicit AcquisitionReader(YamlMap& map) : map_(map) {}

  Acquisition read() {
    map_.expect_schema("gonio/acquisition/1");
    acquisition_.id = map_.required("id").id();
    acquisition_.title = map_.required("title").line();
    if (const auto notes = map_.optional("notes")) {
      (void)notes->text();
    }
    if (const auto sample = map_.optional("sample")) {
      acquisition_.sample = sample->line();
    }
    acquisition_.detector = read_detector(map_.required("detector"));
    if (const auto format = map_.optional("format")) {
      format_ = read_format(*format);
    }
    if (const auto grid = map_.optional("grid")) {
      acquisition_.grid = read_grid(*grid);
    }
    if (const auto mirror = map_.optional("mirror_reflectance")) {
      acquisition_.mirror_reflectance = SpectralTable::load(*mirror);
      (void)acquisition_.mirror_reflectance->sample(acquisition_.grid);
    }
    read_darks(map_.required("darks"));
    read_axis();
    map_.required("geometries").for_each_entry([&](const std::string& id, const YamlNode& node) {
      read_geometry(id, node);
    });
    if (acquisition_.geometries.empty()) {
      map_.required("geometries").fail("a geometry", "none");
    }
    return std::move(acquisition_);
  }

 private:
  void read_darks(const YamlNode& node) {
    for (const YamlNode& item : node.list()) {
      TimedCounts dark = read_counts(item, format_);
      if (dark_of(dark.time_s)) {
        item.fail("a dark of each integration time once",
                  fmt::format("one of {} s a second time", dark.time_s));
      }
      acquisition_.darks.push_back(std::move(dark));
      expect_same_pixels(acquisition_.darks.back().counts);
    }
  }

  void read_axis() {
    std::vector<double> coefficients;
    SourceMark mark = acquisition_.darks.front().counts.mark;
    if (const auto node = map_.optional("wavelength_calibration")) {
      for (const YamlNode& item : node->list()) {
        coefficients.push_back(item.number());
      }
      mark = node->mark();
    }
    acquisition_.wavelength_nm =
        wavelengths_of(acquisition_.darks.front().counts.axis, coefficients, mark);
    const ArrayXd& lambda = acquisition_.wavelength_nm;
    const ArrayXd& grid = acquisition_.grid.nanometres();
    if (grid(grid.size() - 1) < lambda(0) || grid(0) > lambda(lambda.size() - 1)) {
      throw InputError(mark, "pixels in the range of the grid",
                       fmt::format("{} to {} nm", lambda(0), lambda(lambda.size() - 1)));
    }
  }

  void read_geometry(const std::string& id, const YamlNode& node) {
    node.read_map([&](YamlMap& map) {
      AcquiredGeometry geometry{.id = id,
                                .mirror = read_counts(map.required("mirror"), format_),
                                .sample = read_counts(map.required("sample"), format_)};
      expect_same_pixels(geometry.mirror.counts);
      expect_same_pixels(geometry.sample.counts);
      geometry.mirror_dark = expect_dark(geometry.mirror);
      geometry.sample_dark = expect_dark(geometry.sample);
      acquisition_.geometries.push_back(std::move(geometry));
      return 0;
    });
  }

  [[nodiscard]] std::optional<std::size_t> dark_of(double time_s) const {
    for (std::size_t i = 0; i < acquisition_.darks.size(); ++i) {
      if (std::abs(acquisition_.darks[i].time_s / time_s - 1.0) < same_time) {
        return i;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t expect_dark(const TimedCounts& measured) const {
    const auto dark = dark_of(measured.time_s);
    if (!dark) {
      throw InputError(measured.mark, "an integration time that has a dark",
                       fmt::format("{} s", measured.time_s));
    }
    return *dark;
  }

  void expect_same_pixels(const Counts& counts) const {
    const ArrayXd& first = acquisition_.darks.front().counts.axis;
    if (counts.axis.size() != first.size() || (counts.axis != first).any()) {
      throw InputError(counts.mark,
                       fmt::format("the pixels of {}", acquisition_.darks.front().counts.mark.file),
                       fmt::format("{} from {} to {}", counts.axis.size(), counts.axis(0),
                                   counts.axis(counts.axis.size() - 1)));
    }
  }

  YamlMap& map_;
  Acquisition acquisition_;
  CountsFormat format_;
};

}  // namespace

Acquisition load_acquisition(const std::filesystem::path& path) {
  return YamlNode::load(path).read_map([](YamlMap& map) { return AcquisitionReader(map).read(); });
}

std::filesystem::path find_acquisition(const std::string& id_or_path, const Catalog& catalog) {
  const std::filesystem::path path(id_or_path);
  if (std::filesystem::exists(path) || path.has_parent_path() || path.has_extension()) {
    return path;
  }
  return catalog.fixture(std::filesystem::path("measured") / path / "acquisition.yaml");
}

}  // namespace gonio
