#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <utility>

#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// A measured BRDF whose sample lies turned about its normal.
class RotatedBrdf : public MeasuredBrdf {
 public:
  /// @param by  of the sample, from x towards y.
  RotatedBrdf(std::shared_ptr<const MeasuredBrdf> brdf, Angle by)
      : brdf_(std::move(brdf)), cos_(std::cos(by.radians())), sin_(std::sin(by.radians())) {}

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override {
    return brdf_->channels();
  }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override {
    brdf_->evaluate(
        {cos_ * omega_i.x() + sin_ * omega_i.y(), cos_ * omega_i.y() - sin_ * omega_i.x(),
         omega_i.z()},
        {cos_ * omega_r.x + sin_ * omega_r.y, cos_ * omega_r.y - sin_ * omega_r.x, omega_r.z}, f_r);
  }
  [[nodiscard]] Angle step(Angle theta_i) const override { return brdf_->step(theta_i); }
  [[nodiscard]] Angle largest_theta() const override { return brdf_->largest_theta(); }

 private:
  std::shared_ptr<const MeasuredBrdf> brdf_;
  double cos_, sin_;
};

}  // namespace gonio
