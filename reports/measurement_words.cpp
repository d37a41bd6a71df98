#include "reports/measurement_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "emulator/core/quantity.hpp"
#include "emulator/procedure/evaluation.hpp"

namespace gonio {

std::string fixed_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) {
    text.erase(0, 1);
  }
  return text;
}

double degrees_for_output(Angle angle) {
  return parse_quantity(fmt::format("{:.12g}", angle.degrees()), Dimension::number).value();
}

std::string reported_text(double gloss, const Standard& standard) {
  if (!standard.rounding) {
    return fixed_text(gloss, 1);
  }
  const double step = standard.rounding->nominal;
  const int decimals = std::max(0, int(std::ceil(-std::log10(step) - 1e-9)));
  return fixed_text(reported_value(gloss, standard), decimals);
}

namespace {

/// What each geometry measured of a panel, a line for each.
void append_spot_notes(const Measurement& measurement, std::vector<std::string>& notes) {
  for (const GeometryResult& result : measurement.geometries) {
    if (!result.spot) {
      continue;
    }
    const auto& [spot, regions] = *result.spot;
    std::vector<std::string> parts;
    for (const auto& [id, share] : regions) {
      parts.push_back(fmt::format("{} {} %", id, fixed_text(100.0 * share, 1)));
    }
    const std::string extent =
        spot.half_length_mm > 0.0 && spot.half_width_mm > 0.0
            ? fmt::format("a spot of {} mm x {} mm", fixed_text(2.0 * spot.half_length_mm, 1),
                          fixed_text(2.0 * spot.half_width_mm, 1))
            : std::string("a point");
    notes.push_back(fmt::format("{}: {} at {:g} mm, {:g} mm: {}{}{}", measurement.sample, result.id,
                                spot.x_mm, spot.y_mm, extent, parts.empty() ? "" : ": ",
                                fmt::join(parts, ", ")));
  }
}

}  // namespace

std::vector<std::string> sample_notes(const MeasurementHeader& header,
                                      const std::vector<Measurement>& measurements) {
  std::vector<std::string> notes;
  for (const Measurement& measurement : measurements) {
    const auto& selected = measurement.selected_geometry;
    if (selected && measurement.find(*selected) == nullptr) {
      notes.push_back(fmt::format("{}: the standard selects geometry {}, which was not asked for",
                                  measurement.sample, *selected));
    }
    append_spot_notes(measurement, notes);
    for (const HazeResult& haze : measurement.haze) {
      notes.push_back(fmt::format(
          "{}: {} {}", measurement.sample, haze.id,
          haze.value ? fmt::format("{} {}", fixed_text(*haze.value, 1), header.standard.scale.unit)
                     : "not defined for it by the standard"));
    }
  }
  return notes;
}

std::string informative_note(const std::vector<Measurement>& measurements) {
  std::vector<std::string> ids;
  for (const Measurement& measurement : measurements) {
    for (const GeometryResult& result : measurement.geometries) {
      if (result.evidence.is_informative() &&
          std::find(ids.begin(), ids.end(), result.id) == ids.end()) {
        ids.push_back(result.id);
      }
    }
  }
  return ids.empty()
             ? ""
             : fmt::format("informative: geometry {} rests on numbers known only from memory",
                           fmt::join(ids, ", "));
}

}  // namespace gonio
