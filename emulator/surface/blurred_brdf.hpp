#pragma once

#include <memory>
#include <vector>

#include "emulator/measured/measured_brdf.hpp"

namespace gonio {

/// A measured BRDF as a table of its own step would show it: each direction of reflection is a mean
/// over its surroundings, of the variance that linear interpolation between nodes blurs by,
/// step^2 / 6 along each axis. What that changes is about what the table has changed already.
class BlurredBrdf : public MeasuredBrdf {
 public:
  explicit BlurredBrdf(std::shared_ptr<const MeasuredBrdf> brdf);

  [[nodiscard]] const std::vector<BrdfChannel>& channels() const override {
    return brdf_->channels();
  }
  void evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                Eigen::Ref<Eigen::ArrayXXd> f_r) const override;
  [[nodiscard]] Angle step(Angle theta_i) const override { return brdf_->step(theta_i); }
  [[nodiscard]] Angle largest_theta() const override { return brdf_->largest_theta(); }

 private:
  std::shared_ptr<const MeasuredBrdf> brdf_;
};

}  // namespace gonio
