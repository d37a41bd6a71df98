#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "emulator/measured/measured_brdf.hpp"
#include "emulator/surface/surface.hpp"

// Measured BRDFs of surfaces whose f_r is known: as fine as one likes, and sampled.

namespace gonio::test {

inline Vector3 from_angles(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// A surface on one wavelength as a BRDF of one channel, luminance.
class ModelBrdf : public MeasuredBrdf {
 public:
  explicit ModelBrdf(Surface surface, Angle step = degrees(1))
      : surface_(std::move(surface)), step_(step) {}

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override { return channels_; }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    f_r.setZero();
    Eigen::ArrayXd g(omega_r.size());
    for (const Lobe& lobe : surface_.lobes) {
      lobe.shape->evaluate(0.0, omega_i, omega_r, g);
      for (Eigen::Index j = 0; j < g.size(); ++j) {
        if (g(j) > 0.0) {
          const Vector3 omega(omega_r.x(j), omega_r.y(j), omega_r.z(j));
          const double cos_theta_d = std::sqrt(std::max(0.0, 0.5 * (1.0 + omega_i.dot(omega))));
          f_r(j, 0) += g(j) * lobe.colour(cos_theta_d)(0);
        }
      }
    }
  }
  [[nodiscard]] Angle step(Angle /*theta_i*/) const override { return step_; }
  [[nodiscard]] Angle largest_theta() const override { return degrees(90); }

 private:
  std::vector<BrdfChannel> channels_{{.band = BrdfChannel::Band::luminance}};
  Surface surface_;
  Angle step_;
};

/// The same at polar angles and azimuths of reflection that are multiples of a step, linear in
/// between; as measured for each incidence.
class SampledModelBrdf : public ModelBrdf {
 public:
  SampledModelBrdf(Surface surface, Angle step) : ModelBrdf(std::move(surface), step) {}

  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    const double h = step({}).radians();
    const Eigen::Index n = omega_r.size();
    DirectionBatch corner;
    corner.resize(4 * n);
    Eigen::ArrayXd weight(4 * n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const double theta = std::acos(std::min(omega_r.z(j), 1.0)) / h;
      const double phi = std::atan2(omega_r.y(j), omega_r.x(j)) / h;
      for (Eigen::Index k = 0; k < 4; ++k) {
        const double at_theta = std::floor(theta) + double(k % 2);
        const double at_phi = std::floor(phi) + double(k / 2);
        const Vector3 omega = from_angles(at_theta * h, at_phi * h);
        corner.x(4 * j + k) = omega.x();
        corner.y(4 * j + k) = omega.y();
        corner.z(4 * j + k) = omega.z();
        weight(4 * j + k) = (1.0 - std::abs(theta - at_theta)) * (1.0 - std::abs(phi - at_phi));
      }
    }
    Eigen::ArrayXXd at_corner(4 * n, 1);
    ModelBrdf::evaluate(omega_i, corner, at_corner);
    f_r.col(0) = (at_corner.col(0) * weight).reshaped(4, n).colwise().sum().transpose();
  }
};

inline Surface measured(std::shared_ptr<const MeasuredBrdf> brdf, const WavelengthGrid& grid) {
  Surface surface{.grid = grid};
  surface.measured.push_back(
      {.brdf = std::move(brdf), .spectra = Eigen::MatrixXd::Ones(1, grid.size())});
  return surface;
}

}  // namespace gonio::test
