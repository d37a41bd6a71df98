#pragma once

#include <Eigen/Core>

#include "emulator/core/length.hpp"

namespace gonio {

/// The equally spaced wavelengths of a measurement.
class WavelengthGrid {
 public:
  /// @param first  wavelength, > 0.
  /// @param step   > 0 nm; any value if count is 1.
  /// @param count  number of wavelengths, >= 1.
  /// @throws std::domain_error  if an argument is outside its range.
  WavelengthGrid(Wavelength first, Length step, Eigen::Index count);

  /// 380 nm to 780 nm in steps of 5 nm: 81 wavelengths.
  static WavelengthGrid visible() { return {gonio::nanometres(380), gonio::nanometres(5), 81}; }

  [[nodiscard]] Eigen::Index size() const { return nanometres_.size(); }
  [[nodiscard]] Wavelength first() const { return gonio::nanometres(nanometres_(0)); }
  [[nodiscard]] Wavelength last() const { return gonio::nanometres(nanometres_(size() - 1)); }
  [[nodiscard]] const Eigen::ArrayXd& nanometres() const { return nanometres_; }

  bool operator==(const WavelengthGrid& other) const {
    return size() == other.size() && (nanometres_ == other.nanometres_).all();
  }

 private:
  Eigen::ArrayXd nanometres_;
};

}  // namespace gonio
