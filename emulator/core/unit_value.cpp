#include "emulator/core/unit_value.hpp"

#include <fmt/format.h>

#include <array>

namespace gonio {

UnitValue read_unit_value(const YamlNode& node) {
  struct Kind {
    Dimension dimension;
    const char* unit;
  };
  constexpr std::array kinds{Kind{Dimension::number, ""},
                             Kind{Dimension::angle, "deg"},
                             Kind{Dimension::gloss, "GU"},
                             Kind{Dimension::time, "s"},
                             Kind{Dimension::length, "nm"},
                             Kind{Dimension::temperature, "degC"},
                             Kind{Dimension::temperature_difference, "K"}};
  const std::string text = node.text();
  for (const Kind& kind : kinds) {
    if (const auto value = parse_quantity(text, kind.dimension)) {
      return {
          .value = kind.dimension == Dimension::angle ? stated_degrees(radians(*value)) : *value,
          .unit = kind.unit};
    }
  }
  node.fail("a number, with its unit if it has one (deg, GU, s, min, h, nm, K)");
}

double stated_degrees(Angle angle) {
  return *parse_quantity(fmt::format("{:.12g}", angle.degrees()), Dimension::number);
}

}  // namespace gonio
