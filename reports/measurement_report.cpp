#include "reports/measurement_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "emulator/core/csv_cell.hpp"
#include "reports/json_values.hpp"
#include "reports/measurement_words.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

std::string lab_text(const std::optional<ReflectedColour>& colour) {
  return colour ? fmt::format("{:>8} {:>7} {:>7}", fixed_text(colour->lab.L, 2),
                              fixed_text(colour->lab.a, 2), fixed_text(colour->lab.b, 2))
                : fmt::format("{:>8} {:>7} {:>7}", "-", "-", "-");
}

void append_row(std::string& text, const MeasurementHeader& header, const Measurement& measurement,
                const GeometryResult& result, bool styled, std::size_t width) {
  const bool selected = measurement.selected_geometry == result.id;
  const std::string row = fmt::format(
      "{:<{}}  {:>8}  {:>8} {:<2}{:>14}  {:>8.1e}  {:>10}  {}", measurement.sample, width,
      result.id, reported_text(result.reading.gloss, header.standard), selected ? "<" : "",
      fixed_text(result.reading.gloss, 4), result.reading.quadrature_error,
      fixed_text(result.reading.luminous_reflectance, 6), lab_text(result.colour));
  text += styled && selected ? "\033[1m" + row + "\033[0m\n" : row + "\n";
}

/// Whether the geometry that a standard selects is among those of its table.
bool shows_selected(const Measurement& measurement) {
  return measurement.selected_geometry &&
         measurement.find(*measurement.selected_geometry) != nullptr;
}

/// What a reader must know of the table.
std::string footnotes(const MeasurementHeader& header,
                      const std::vector<Measurement>& measurements) {
  std::string text;
  for (const std::string& note : sample_notes(header, measurements)) {
    text += note + "\n";
  }
  if (std::any_of(measurements.begin(), measurements.end(), shows_selected)) {
    text += "<: the geometry that the standard selects\n";
  }
  const std::string informative = informative_note(measurements);
  return informative.empty() ? text : text + informative + "\n";
}

ordered_json colour_json(const ReflectedColour& colour) {
  return {{"X", colour.xyz.X}, {"Y", colour.xyz.Y}, {"Z", colour.xyz.Z}, {"x", colour.xy.x},
          {"y", colour.xy.y},  {"L", colour.lab.L}, {"a", colour.lab.a}, {"b", colour.lab.b}};
}

ordered_json spot_json(const SpotOnPanel& on_panel) {
  ordered_json json{{"length_mm", 2.0 * on_panel.spot.half_length_mm},
                    {"width_mm", 2.0 * on_panel.spot.half_width_mm}};
  for (const auto& [id, share] : on_panel.regions) {
    json["regions"].push_back({{"id", id}, {"share", share}});
  }
  return json;
}

ordered_json geometry_json(const MeasurementHeader& header, const GeometryResult& result) {
  ordered_json json{{"id", result.id},
                    {"theta_i_deg", degrees_for_output(result.theta_i)},
                    {"gloss_gu", result.reading.gloss},
                    {"quadrature_error_gu", result.reading.quadrature_error},
                    {"luminous_reflectance", result.reading.luminous_reflectance},
                    {"evidence", result.evidence.level}};
  json["colour"] = result.colour ? colour_json(*result.colour) : ordered_json(nullptr);
  if (result.spot) {
    json["spot"] = spot_json(*result.spot);
  }
  json["spectrum"] = {{"wavelength_nm", json_of(header.grid.nanometres())},
                      {"reflectance", json_of(result.reading.reflectance)}};
  return json;
}

ordered_json measurement_object(const MeasurementHeader& header, const Measurement& measurement) {
  ordered_json json{{"schema", "gonio/measurement/1"}, {"standard", header.standard.id},
                    {"instrument", header.instrument}, {"integrator", header.integrator},
                    {"reference", header.reference},   {"unit", header.standard.scale.unit},
                    {"sample", measurement.sample}};
  json["selected_geometry"] = measurement.selected_geometry
                                  ? ordered_json(*measurement.selected_geometry)
                                  : ordered_json(nullptr);
  if (measurement.position) {
    json["position"] = {{"x_mm", measurement.position->x_mm}, {"y_mm", measurement.position->y_mm}};
  }
  json["geometries"] = ordered_json::array();
  for (const GeometryResult& result : measurement.geometries) {
    json["geometries"].push_back(geometry_json(header, result));
  }
  if (!measurement.haze.empty()) {
    json["haze"] = ordered_json::array();
    for (const HazeResult& haze : measurement.haze) {
      json["haze"].push_back(
          {{"id", haze.id}, {"value", haze.value ? ordered_json(*haze.value) : nullptr}});
    }
  }
  if (!measurement.warnings.empty()) {
    json["warnings"] = measurement.warnings;
  }
  return json;
}

}  // namespace

std::string measurement_text(const MeasurementHeader& header,
                             const std::vector<Measurement>& measurements, bool styled) {
  const std::string& unit = header.standard.scale.unit;
  std::string text =
      fmt::format("{} - {}\n{}; {} integrator; {}\n\n", header.standard.id, header.standard.title,
                  header.instrument, header.integrator, header.reference);
  std::size_t width = 6;
  for (const Measurement& measurement : measurements) {
    width = std::max(width, measurement.sample.size());
  }
  text += fmt::format("{:<{}}  {:>8}  {:>8} {:<2}{:>14}  {:>8}  {:>10}  {:>8} {:>7} {:>7}\n",
                      "sample", width, "geometry", unit, "", "computed " + unit, "+-", "reflect.",
                      "L*", "a*", "b*");
  for (const Measurement& measurement : measurements) {
    for (const GeometryResult& result : measurement.geometries) {
      append_row(text, header, measurement, result, styled, width);
    }
  }
  const std::string notes = footnotes(header, measurements);
  return notes.empty() ? text : text + "\n" + notes;
}

std::string measurement_json(const MeasurementHeader& header,
                             const std::vector<Measurement>& measurements) {
  if (measurements.size() == 1) {
    return json_text(measurement_object(header, measurements.front()));
  }
  ordered_json all{{"schema", "gonio/measurements/1"}, {"measurements", ordered_json::array()}};
  for (const Measurement& measurement : measurements) {
    all["measurements"].push_back(measurement_object(header, measurement));
  }
  return json_text(all);
}

std::string measurement_csv(const MeasurementHeader& header,
                            const std::vector<Measurement>& measurements) {
  std::string text =
      "standard,sample,geometry,theta_i_deg,gloss_gu,quadrature_error_gu,luminous_reflectance,"
      "selected,X,Y,Z,L,a,b\n";
  for (const Measurement& measurement : measurements) {
    for (const GeometryResult& result : measurement.geometries) {
      const GlossReading& reading = result.reading;
      text += fmt::format("{},{},{},{},{},{},{},{},", csv_cell(header.standard.id),
                          csv_cell(measurement.sample), csv_cell(result.id),
                          degrees_for_output(result.theta_i), reading.gloss,
                          reading.quadrature_error, reading.luminous_reflectance,
                          measurement.selected_geometry == result.id ? 1 : 0);
      if (result.colour) {
        const ReflectedColour& c = *result.colour;
        text += fmt::format("{},{},{},{},{},{}\n", c.xyz.X, c.xyz.Y, c.xyz.Z, c.lab.L, c.lab.a,
                            c.lab.b);
      } else {
        text += ",,,,,\n";
      }
    }
  }
  return text;
}

std::string spectra_csv(const MeasurementHeader& header,
                        const std::vector<Measurement>& measurements) {
  std::string text = fmt::format("# spectral reflectance into the receptor, {}, {}\nwavelength_nm",
                                 header.standard.id, header.instrument);
  for (const Measurement& measurement : measurements) {
    for (const GeometryResult& result : measurement.geometries) {
      text += fmt::format(",{}", csv_cell(fmt::format("{} {}", measurement.sample, result.id)));
    }
  }
  text += "\n";
  for (Eigen::Index l = 0; l < header.grid.size(); ++l) {
    text += fmt::format("{}", header.grid.nanometres()(l));
    for (const Measurement& measurement : measurements) {
      for (const GeometryResult& result : measurement.geometries) {
        text += fmt::format(",{}", result.reading.reflectance(l));
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace gonio
