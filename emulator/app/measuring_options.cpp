#include "emulator/app/measuring_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gonio::app {

WavelengthGrid parse_wavelengths(const std::string& text) {
  std::vector<double> parts;
  for (const std::string& part : CLI::detail::split(text, ':')) {
    parts.push_back(parse_quantity(part, Dimension::number).value_or(-1.0));
  }
  const bool is_grid =
      parts.size() == 3 && parts[0] > 0.0 && parts[1] >= parts[0] && parts[2] > 0.0;
  const double steps = is_grid ? (parts[1] - parts[0]) / parts[2] : 0.0;
  constexpr double most_steps = 100'000.0;
  if (!is_grid || steps > most_steps || std::abs(steps - std::round(steps)) > 1e-6) {
    throw std::invalid_argument(fmt::format(
        "--wavelengths: expected first:last:step in nm, a whole number of steps, found '{}'",
        text));
  }
  return {nanometres(parts[0]), nanometres(parts[2]), Eigen::Index(std::round(steps)) + 1};
}

Angle parse_angle(const std::string& option, const std::string& text, const Range& range_deg) {
  constexpr double rounding = 1e-12;
  const auto radian = parse_quantity(text, Dimension::angle);
  const double degree = radian ? radians(*radian).degrees() : 0.0;
  if (!radian || !range_deg.contains(std::round(degree / rounding) * rounding)) {
    throw std::invalid_argument(
        fmt::format("{}: expected an angle (deg, rad, mrad){} deg, found '{}'", option,
                    range_deg.text(), text));
  }
  return radians(*radian);
}

double parse_millimetres(const std::string& option, const std::string& text,
                         const Range& range_mm) {
  constexpr double per_nanometre = 1e-6;
  const auto length = parse_quantity(text, Dimension::length);
  const double millimetres = length ? *length * per_nanometre : 0.0;
  if (!length || !range_mm.contains(millimetres)) {
    throw std::invalid_argument(fmt::format("{}: expected a length (nm, um, mm){} mm, found '{}'",
                                            option, range_mm.text(), text));
  }
  return millimetres;
}

}  // namespace gonio::app
