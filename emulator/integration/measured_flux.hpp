#pragma once

#include "emulator/integration/flux.hpp"
#include "emulator/integration/nested_integral.hpp"

namespace gonio {

/// The channels of a measured BRDF: f_k is channel k.
class MeasuredIntegrand : public Integrand {
 public:
  /// @param term  must outlive this object.
  MeasuredIntegrand(const MeasuredTerm& term, const Eigen::ArrayXd& weight)
      : Integrand(term.spectra, weight), brdf_(*term.brdf) {}

  /// That of the table's step round the mirror direction: what is finer, the table does not show.
  [[nodiscard]] SlopeWidth slope_width(double cos_theta_i) const override;
  /// False: nothing makes both halves of what was measured alike.
  [[nodiscard]] bool is_symmetric() const override { return false; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r) override;
  void control(Eigen::ArrayXd& value) override;
  void add(Eigen::ArrayXd& weight, Eigen::Ref<Eigen::VectorXd> sum) override;

 private:
  const MeasuredBrdf& brdf_;
  Eigen::ArrayXXd f_r_;  // shape (n, n_channels)
};

/// The flux of one measured term from a source aperture into a receptor aperture.
///
/// A table has kinks between its nodes, at which rules of high order gain nothing: the error falls
/// with the square of the effort only. So the tolerance is approached in steps, and where the next
/// one would cost more than about 0.1 s the integral stays as it is, with its error.
/// @param tolerance  on the error of the weighted flux [sr].
/// @param incident   what falls on the sample, > 0 [sr].
[[nodiscard]] Flux measured_flux(const MeasuredTerm& term, const MeasuringGeometry& geometry,
                                 const Eigen::ArrayXd& weight, double tolerance, double incident);

}  // namespace gonio
