#include "emulator/surface/panel_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace gonio {

namespace {

constexpr int fewest_lines = 64, most_lines = 512;

/// Where the lines of constant y that an area is cut into have to begin anew: between these, edges
/// do not begin or end.
std::vector<double> strip_edges(const PanelLayout& layout, const Outline& area) {
  const double low = std::max(area.y_mm - area.half_width_mm, 0.0);
  const double high = std::min(area.y_mm + area.half_width_mm, layout.width_mm);
  std::vector<double> edges{low, high};
  for (const PanelLayout::Region& region : layout.regions) {
    if (!region.outline) {
      continue;
    }
    for (const double side : {-1.0, 1.0}) {
      const double edge = region.outline->y_mm + side * region.outline->half_width_mm;
      if (edge > low && edge < high) {
        edges.push_back(edge);
      }
    }
  }
  std::ranges::sort(edges);
  return edges;
}

/// Adds up what an area covers, line by line.
class AreaSampler {
 public:
  AreaSampler(const PanelLayout& layout, const Outline& area)
      : layout_(layout), area_(area), pitch_mm_(2.0 * area.half_length_mm / fewest_lines) {
    for (const auto& map : layout.maps) {
      if (map) {
        pitch_mm_ = std::min(pitch_mm_, map->pitch_mm() / 2.0);
      }
    }
    pitch_mm_ = std::max(pitch_mm_, 2.0 * area.half_length_mm / most_lines);
  }

  /// The midpoint rule in an angle: edges of ellipses turn at the ends of a strip.
  void add_strip(double low, double high) {
    const double half = 0.5 * (high - low);
    const int lines = layout_.has_maps() ? std::clamp(int(std::ceil(2.0 * half / pitch_mm_)),
                                                      fewest_lines, most_lines)
                                         : fewest_lines;
    for (int i = 0; i < lines; ++i) {
      const double angle = std::numbers::pi * ((i + 0.5) / lines - 0.5);
      add_line(0.5 * (low + high) + half * std::sin(angle),
               half * std::cos(angle) * std::numbers::pi / lines);
    }
  }

  [[nodiscard]] const std::vector<SpotShare>& samples() const { return samples_; }

 private:
  void add_line(double y, double width) {
    const auto chord = area_.chord(y);
    const auto line = chord ? common(*chord, {0.0, layout_.length_mm}) : std::nullopt;
    if (!line) {
      return;
    }
    std::vector<double> edges{line->low, line->high};
    std::vector<std::pair<std::size_t, Chord>> covers;  // later ones lie over earlier ones
    for (std::size_t r = 0; r < layout_.regions.size(); ++r) {
      const auto& outline = layout_.regions[r].outline;
      const auto across = outline ? outline->chord(y) : *line;
      if (const auto part = across ? common(*line, *across) : std::nullopt) {
        covers.emplace_back(r, *part);
        edges.push_back(part->low);
        edges.push_back(part->high);
      }
    }
    std::ranges::sort(edges);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      const double middle = 0.5 * (edges[i] + edges[i + 1]);
      const auto top = std::find_if(covers.rbegin(), covers.rend(), [&](const auto& cover) {
        return cover.second.low <= middle && middle <= cover.second.high;
      });
      if (top != covers.rend() && edges[i + 1] > edges[i]) {
        add_piece(top->first, {edges[i], edges[i + 1]}, y, width);
      }
    }
  }

  /// A piece of a line that lies in one region.
  void add_piece(std::size_t region, const Chord& piece, double y, double width) {
    const double length = piece.high - piece.low;
    const int points = layout_.has_maps() ? int(std::ceil(length / pitch_mm_)) : 1;
    for (int i = 0; i < points; ++i) {
      const double x = piece.low + (i + 0.5) / points * length;
      SpotShare sample{.region = region, .weight = width * length / points};
      for (std::size_t p = 0; p < sample_parameter_count; ++p) {
        if (layout_.maps[p]) {
          sample.deviation[SampleParameter(p)] = layout_.maps[p]->at(x, y);
        }
      }
      samples_.push_back(sample);
    }
  }

  const PanelLayout& layout_;
  const Outline& area_;
  double pitch_mm_;
  std::vector<SpotShare> samples_;
};

/// The groups that the values within one region are put into: the same number along each parameter
/// that varies there.
class Groups {
 public:
  void widen(const SampleDeviation& deviation) {
    for (std::size_t p = 0; p < sample_parameter_count; ++p) {
      const double value = deviation[SampleParameter(p)];
      low_[p] = empty_ ? value : std::min(low_[p], value);
      high_[p] = empty_ ? value : std::max(high_[p], value);
    }
    empty_ = false;
  }

  [[nodiscard]] std::size_t number_of(const SampleDeviation& deviation) const {
    constexpr std::array<std::size_t, sample_parameter_count + 1> along_each{1, 16, 8, 4};
    const std::size_t n = along_each[varying()];
    std::size_t number = 0;
    for (std::size_t p = 0; p < sample_parameter_count; ++p) {
      if (high_[p] > low_[p]) {
        const double share = (deviation[SampleParameter(p)] - low_[p]) / (high_[p] - low_[p]);
        number = number * n + std::min(n - 1, std::size_t(share * double(n)));
      }
    }
    return number;
  }

 private:
  [[nodiscard]] std::size_t varying() const {
    std::size_t count = 0;
    for (std::size_t p = 0; p < sample_parameter_count; ++p) {
      count += high_[p] > low_[p] ? 1 : 0;
    }
    return count;
  }

  bool empty_ = true;
  std::array<double, sample_parameter_count> low_{}, high_{};
};

/// Puts samples together that are alike.
std::vector<SpotShare> grouped(const std::vector<SpotShare>& samples, std::size_t regions) {
  std::vector<Groups> groups(regions);
  double total = 0.0;
  for (const SpotShare& sample : samples) {
    groups[sample.region].widen(sample.deviation);
    total += sample.weight;
  }
  std::map<std::pair<std::size_t, std::size_t>, SpotShare> sums;
  for (const SpotShare& sample : samples) {
    const std::size_t group = groups[sample.region].number_of(sample.deviation);
    SpotShare& sum = sums[{sample.region, group}];
    sum.region = sample.region;
    sum.weight += sample.weight;
    for (std::size_t p = 0; p < sample_parameter_count; ++p) {
      const auto parameter = SampleParameter(p);
      const double share = sample.weight / sum.weight;
      sum.deviation[parameter] += share * (sample.deviation[parameter] - sum.deviation[parameter]);
    }
  }
  std::vector<SpotShare> result;
  for (const auto& [key, sum] : sums) {
    result.push_back(sum);
    result.back().weight /= total;
  }
  return result;
}

std::vector<SpotShare> shares_of(const PanelLayout& layout, const Outline& area) {
  AreaSampler sampler(layout, area);
  const std::vector<double> edges = strip_edges(layout, area);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i + 1] > edges[i]) {
      sampler.add_strip(edges[i], edges[i + 1]);
    }
  }
  if (sampler.samples().empty()) {
    throw std::domain_error(fmt::format(
        "shares: the spot must lie on the panel of {:g} mm x {:g} mm, is at {:g} mm, {:g} mm",
        layout.length_mm, layout.width_mm, area.x_mm, area.y_mm));
  }
  return grouped(sampler.samples(), layout.regions.size());
}

}  // namespace

bool PanelLayout::carries(const Spot& spot) const {
  constexpr double rounding_mm = 1e-9;
  const auto within = [](double middle, double half, double size) {
    return middle - half >= -rounding_mm && middle + half <= size + rounding_mm;
  };
  return within(spot.x_mm, spot.half_length_mm, length_mm) &&
         within(spot.y_mm, spot.half_width_mm, width_mm);
}

Outline PanelLayout::outline() const {
  return {.kind = Outline::Kind::rectangle,
          .x_mm = 0.5 * length_mm,
          .y_mm = 0.5 * width_mm,
          .half_length_mm = 0.5 * length_mm,
          .half_width_mm = 0.5 * width_mm};
}

bool PanelLayout::has_maps() const {
  return std::ranges::any_of(maps, [](const auto& map) { return map.has_value(); });
}

std::vector<SpotShare> shares(const PanelLayout& layout, const Spot& spot) {
  return shares_of(layout, outline_of(spot));
}

std::vector<SpotShare> shares(const PanelLayout& layout) {
  return shares_of(layout, layout.outline());
}

}  // namespace gonio
