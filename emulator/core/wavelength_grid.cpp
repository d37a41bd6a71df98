#include "emulator/core/wavelength_grid.hpp"

#include <stdexcept>

namespace gonio {

WavelengthGrid::WavelengthGrid(Wavelength first, Length step, Eigen::Index count) {
  if (!(first.nanometres() > 0.0) || count < 1 || (count > 1 && !(step.nanometres() > 0.0))) {
    throw std::domain_error("WavelengthGrid: needs first > 0, step > 0 and count >= 1");
  }
  nanometres_ = first.nanometres() +
                step.nanometres() * Eigen::ArrayXd::LinSpaced(count, 0.0, double(count - 1));
}

}  // namespace gonio
