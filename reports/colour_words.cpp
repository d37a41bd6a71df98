#include "reports/colour_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "reports/measurement_words.hpp"

namespace gonio {

namespace {

/// Geometries of which a number is known from memory, or was not found and is as built.
std::vector<std::string> uncertain_geometries(const ColourHeader& header,
                                              const std::vector<ColourMeasurement>& measurements) {
  std::vector<std::string> ids;
  for (const ColourMeasurement& measurement : measurements) {
    for (const ColourGeometryResult& result : measurement.geometries) {
      const GeometryLimits& limits = header.instrument.standard.geometry(result.id);
      if (std::find(ids.begin(), ids.end(), result.id) != ids.end()) {
        continue;
      }
      if (result.evidence.is_informative() || !limits.source.is_known() ||
          !limits.receptor.is_known()) {
        ids.push_back(result.id);
      }
    }
  }
  return ids;
}

std::string flop_words(const ColourMeasurement& measurement) {
  const FlopResult& flop = *measurement.flop;
  return fmt::format("{}: flop index {}{}", measurement.sample,
                     flop.value ? fixed_text(*flop.value, 2)
                                : std::string("not defined: a geometry is missing, the face is "
                                              "black, or the colour is lighter far from the mirror "
                                              "direction than near it"),
                     flop.evidence.is_informative()
                         ? ", informative: the formula is known from memory alone"
                         : "");
}

}  // namespace

std::string conditions_words(const ColourConditions& conditions) {
  std::string name = conditions.illuminant;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return char(std::toupper(static_cast<unsigned char>(c))); });
  return fmt::format("illuminant {}, {} deg observer", name, conditions.observer);
}

ReportTable colour_table(const std::vector<ColourMeasurement>& measurements) {
  ReportTable table{
      .caption = "Colour against the perfect reflecting diffuser",
      .heads = {"sample", "geometry", ">aspecular", ">X", ">Y", ">Z", ">L*", ">a*", ">b*"}};
  for (const ColourMeasurement& measurement : measurements) {
    for (const ColourGeometryResult& result : measurement.geometries) {
      const auto number = [](double value) { return fixed_text(value, 2); };
      table.rows.push_back({measurement.sample, result.id,
                            result.aspecular
                                ? fmt::format("{:g} deg", degrees_for_output(*result.aspecular))
                                : std::string("sphere"),
                            number(result.xyz.X), number(result.xyz.Y), number(result.xyz.Z),
                            number(result.lab.L), number(result.lab.a), number(result.lab.b)});
    }
  }
  return table;
}

std::vector<std::string> colour_notes(const ColourHeader& header,
                                      const std::vector<ColourMeasurement>& measurements) {
  std::vector<std::string> notes;
  for (const ColourMeasurement& measurement : measurements) {
    if (measurement.flop) {
      notes.push_back(flop_words(measurement));
    }
  }
  const std::vector<std::string> uncertain = uncertain_geometries(header, measurements);
  if (!uncertain.empty()) {
    notes.push_back(fmt::format(
        "informative: {}: numbers that are known from memory alone, or that were not found and "
        "stand as the instrument was built",
        fmt::join(uncertain, ", ")));
  }
  return notes;
}

}  // namespace gonio
