#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "emulator/optics/colorimetry.hpp"
#include "emulator/procedure/measurement_equation.hpp"
#include "emulator/procedure/polynomial_surrogate.hpp"
#include "emulator/quality/batch.hpp"
#include "emulator/surface/sample_family.hpp"

namespace gonio {

/// How far the parameters of a product go from its offset: six standard deviations of what is
/// normal, and the bounds of what is bounded.
[[nodiscard]] ProductDeviation reach(const Batch& batch);

/// What instruments see of a product whose parameters deviate: the optics as polynomials, fitted
/// once, then the measurement equation. The last instrument is the ideal one of the standard: what
/// it reads is the truth.
///
/// What is seen adds up over an area, as fluxes do: gloss, or X, Y, Z of a colour relative to the
/// white. What is shown does not.
class ProductOptics {
 public:
  /// What is seen: one number or three.
  using Seen = std::array<double, 3>;

  /// @param batch       with a product; must outlive this object.
  /// @param half_width  how far the deviations may go from product.offset, by parameter.
  /// @param observer    of colours, on the visible grid.
  /// @param advance     called with what is done of what is to do.
  /// @throws InputError  at the product where its deviations leave the range of its model.
  ProductOptics(const Batch& batch, const ProductDeviation& half_width, const Observer& observer,
                const std::function<void(std::size_t, std::size_t)>& advance = {});

  /// Number of the ideal instrument; those before are the batch's.
  [[nodiscard]] std::size_t ideal() const { return batch_.instruments.size(); }

  /// @param deviation  from the sample file, in the order of sample_parameter_names.
  [[nodiscard]] Seen see(std::size_t instrument, std::uint32_t channel, std::size_t region,
                         const Eigen::Vector3d& deviation) const;
  /// What the instrument shows for that, before noise and rounding.
  [[nodiscard]] double show(std::size_t instrument, std::uint32_t channel, const Seen& seen) const;

  /// The largest error of a polynomial that was seen, in gloss units, or as X, Y, Z.
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] const ProductDeviation& half_width() const { return half_width_; }
  [[nodiscard]] const SampleFamily& family() const { return family_; }

 private:
  void fit(std::size_t place, const Observer& observer);
  void set_references(const Observer& observer);
  [[nodiscard]] const Instrument& instrument(std::size_t number) const;
  [[nodiscard]] std::size_t place(std::size_t instrument, std::uint32_t channel,
                                  std::size_t region) const;

  const Batch& batch_;
  ProductDeviation half_width_;
  SampleFamily family_;
  Instrument ideal_;
  std::vector<std::optional<PolynomialSurrogate>> seen_ = {};  // by instrument, channel, region
  std::vector<MeasurementEquation> equations_ = {};            // by instrument, channel
  std::vector<Lab> references_ = {};                           // by channel
  double error_ = 0.0;
};

}  // namespace gonio
