#include "emulator/optics/daylight.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "emulator/core/table.hpp"

namespace gonio {

namespace {

/// Chromaticity x_D of daylight.
double daylight_x(double cct_k) {
  const double t = 1e3 / cct_k;
  return cct_k <= 7000.0 ? 0.244063 + t * (0.09911 + t * (2.9678 + t * -4.6070))
                         : 0.237040 + t * (0.24748 + t * (1.9018 + t * -2.0064));
}

double three_decimals(double value) { return std::round(value * 1e3) * 1e-3; }

}  // namespace

DaylightComponents DaylightComponents::load(const std::filesystem::path& path,
                                            const WavelengthGrid& grid) {
  const auto column = [&](const char* name) {
    return SpectralTable::load(path, name).sample(grid);
  };
  return {.S_0 = column("S0"), .S_1 = column("S1"), .S_2 = column("S2")};
}

Eigen::ArrayXd daylight(double cct_k, const DaylightComponents& components) {
  if (!(cct_k >= 4000.0 && cct_k <= 25000.0)) {
    throw std::domain_error(fmt::format("daylight: {} K is not in [4000, 25000] K", cct_k));
  }
  const double x = daylight_x(cct_k);
  const double y = -3.0 * x * x + 2.87 * x - 0.275;
  const double M = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double M_1 = three_decimals((-1.3515 - 1.7703 * x + 5.9114 * y) / M);
  const double M_2 = three_decimals((0.0300 - 31.4424 * x + 30.0717 * y) / M);
  return components.S_0 + M_1 * components.S_1 + M_2 * components.S_2;
}

}  // namespace gonio
