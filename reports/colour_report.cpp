#include "reports/colour_report.hpp"

#include <fmt/format.h>

#include "emulator/core/csv_cell.hpp"
#include "reports/colour_words.hpp"
#include "reports/json_values.hpp"
#include "reports/measurement_words.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

std::optional<double> degrees_of(const std::optional<Angle>& angle) {
  return angle ? std::optional(degrees_for_output(*angle)) : std::nullopt;
}

ordered_json colour_geometry_json(const ColourHeader& header, const ColourGeometryResult& result) {
  ordered_json json{{"id", result.id},
                    {"theta_i_deg", degrees_for_output(result.theta_i)},
                    {"theta_r_deg", json_of(degrees_of(result.theta_r))},
                    {"aspecular_deg", json_of(degrees_of(result.aspecular))},
                    {"X", result.xyz.X},
                    {"Y", result.xyz.Y},
                    {"Z", result.xyz.Z}};
  json["x"] = json_of(result.xy ? std::optional(result.xy->x) : std::nullopt);
  json["y"] = json_of(result.xy ? std::optional(result.xy->y) : std::nullopt);
  json["L"] = result.lab.L;
  json["a"] = result.lab.a;
  json["b"] = result.lab.b;
  json["quadrature_error"] = result.reading.quadrature_error;
  json["evidence"] = result.evidence.level;
  json["spectrum"] = {{"wavelength_nm", json_of(header.grid.nanometres())},
                      {"radiance_factor", json_of(result.reading.radiance_factor)}};
  return json;
}

ordered_json colour_object(const ColourHeader& header, const ColourMeasurement& measurement) {
  ordered_json json{{"sample", measurement.sample}, {"geometries", ordered_json::array()}};
  for (const ColourGeometryResult& result : measurement.geometries) {
    json["geometries"].push_back(colour_geometry_json(header, result));
  }
  if (measurement.flop) {
    json["flop"] = {{"value", json_of(measurement.flop->value)},
                    {"evidence", measurement.flop->evidence.level}};
  }
  return json;
}

}  // namespace

std::string colour_text(const ColourHeader& header,
                        const std::vector<ColourMeasurement>& measurements, bool styled) {
  std::string text = fmt::format("{} - {}\n{}; {}\n", header.instrument.standard.id,
                                 header.instrument.standard.title, header.instrument.title,
                                 conditions_words(header.conditions));
  text += table_text(colour_table(measurements), styled);
  const std::vector<std::string> notes = colour_notes(header, measurements);
  text += notes.empty() ? "" : "\n";
  for (const std::string& note : notes) {
    text += note + "\n";
  }
  return text;
}

std::string colour_json(const ColourHeader& header,
                        const std::vector<ColourMeasurement>& measurements) {
  ordered_json json{{"schema", "gonio/colour/1"},
                    {"standard", header.instrument.standard.id},
                    {"instrument", header.instrument.title},
                    {"illuminant", header.conditions.illuminant},
                    {"observer_deg", header.conditions.observer == "2" ? 2 : 10},
                    {"reference", "perfect_diffuser"},
                    {"measurements", ordered_json::array()}};
  for (const ColourMeasurement& measurement : measurements) {
    json["measurements"].push_back(colour_object(header, measurement));
  }
  return json_text(json);
}

std::string colour_csv(const ColourHeader& header,
                       const std::vector<ColourMeasurement>& measurements) {
  std::string text =
      "standard,sample,illuminant,observer_deg,geometry,theta_i_deg,theta_r_deg,aspecular_deg,"
      "X,Y,Z,L,a,b,quadrature_error,flop\n";
  const auto cell = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  for (const ColourMeasurement& measurement : measurements) {
    const std::string flop = measurement.flop ? cell(measurement.flop->value) : std::string();
    for (const ColourGeometryResult& result : measurement.geometries) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                          csv_cell(header.instrument.standard.id), csv_cell(measurement.sample),
                          header.conditions.illuminant, header.conditions.observer,
                          csv_cell(result.id), degrees_for_output(result.theta_i),
                          cell(degrees_of(result.theta_r)), cell(degrees_of(result.aspecular)),
                          result.xyz.X, result.xyz.Y, result.xyz.Z, result.lab.L, result.lab.a,
                          result.lab.b, result.reading.quadrature_error, flop);
    }
  }
  return text;
}

std::string radiance_factor_csv(const ColourHeader& header,
                                const std::vector<ColourMeasurement>& measurements) {
  std::string text = fmt::format("# radiance factor, {}, {}\nwavelength_nm",
                                 header.instrument.standard.id, header.instrument.title);
  for (const ColourMeasurement& measurement : measurements) {
    for (const ColourGeometryResult& result : measurement.geometries) {
      text += fmt::format(",{}", csv_cell(fmt::format("{} {}", measurement.sample, result.id)));
    }
  }
  text += "\n";
  for (Eigen::Index l = 0; l < header.grid.size(); ++l) {
    text += fmt::format("{}", header.grid.nanometres()(l));
    for (const ColourMeasurement& measurement : measurements) {
      for (const ColourGeometryResult& result : measurement.geometries) {
        text += fmt::format(",{}", result.reading.radiance_factor(l));
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace gonio
