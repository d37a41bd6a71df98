#include "emulator/goniometry/instrument_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "emulator/core/unit_value.hpp"
#include "emulator/instrument/setup.hpp"

namespace gonio {

namespace {

std::string angle_text(const AngleAsBuilt& angle) {
  const std::string value = fmt::format("{:.8g} deg", stated_degrees(angle.value));
  return angle.expanded_uncertainty
             ? fmt::format("{{value: {}, expanded_uncertainty: {:.3g} deg}}", value,
                           stated_degrees(*angle.expanded_uncertainty))
             : value;
}

void append(std::vector<std::string>& parts, const char* key,
            const std::optional<AngleAsBuilt>& angle) {
  if (angle) {
    parts.push_back(fmt::format("{}: {}", key, angle_text(*angle)));
  }
}

void append(std::vector<std::string>& lines, const char* key, const OpeningAsBuilt& opening) {
  std::vector<std::string> parts;
  append(parts, "in_plane", opening.in_plane);
  append(parts, "perpendicular", opening.perpendicular);
  append(parts, "diameter", opening.diameter);
  if (!parts.empty()) {
    lines.push_back(fmt::format("{}: {{{}}}", key, fmt::join(parts, ", ")));
  }
}

std::string quoted(std::string text) {
  std::string result;
  for (const char c : text) {
    result += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return fmt::format("\"{}\"", result);
}

}  // namespace

std::string instrument_yaml(const Instrument& instrument, const std::string& id,
                            const std::string& notes) {
  std::string text = fmt::format(
      "schema: gonio/instrument/1\nid: {}\ntitle: {}\nnotes: {}\nbuilt_to: {}\ngeometries: [", id,
      quoted(instrument.title), quoted(notes), instrument.standard.id);
  for (std::size_t i = 0; i < instrument.geometries.size(); ++i) {
    text += fmt::format("{}\"{}\"", i > 0 ? ", " : "", instrument.geometries[i]);
  }
  text += "]\n";
  std::string built;
  for (const std::string& geometry : instrument.geometries) {
    const auto found = instrument.as_built.find(geometry);
    if (found == instrument.as_built.end()) {
      continue;
    }
    std::vector<std::string> lines;
    append(lines, "theta_i", found->second.theta_i);
    append(lines, "theta_r", found->second.theta_r);
    append(lines, "source", found->second.source);
    append(lines, "receptor", found->second.receptor);
    if (!lines.empty()) {
      built += fmt::format("  \"{}\":\n    {}\n", geometry, fmt::join(lines, "\n    "));
    }
  }
  return built.empty() ? text : text + "as_built:\n" + built;
}

}  // namespace gonio
