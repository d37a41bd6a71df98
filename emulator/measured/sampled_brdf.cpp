#include "emulator/measured/sampled_brdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "emulator/measured/bracket.hpp"
#include "emulator/measured/brdf_interpolation.hpp"
#include "emulator/measured/brdf_points.hpp"

namespace gonio {

namespace {

using Eigen::Index;

void require_whole(const BrdfSamples& samples) {
  const Index n = samples.size();
  const bool agrees = n > 0 && samples.phi_i.size() == n && samples.theta_r.size() == n &&
                      samples.phi_r.size() == n && samples.f_r.rows() == n &&
                      samples.f_r.cols() == Index(samples.channels.size()) &&
                      !samples.channels.empty();
  if (!agrees) {
    throw std::invalid_argument(fmt::format(
        "expected angles and f_r of the same samples, found {} by {} f_r of {} samples and {} "
        "channels",
        samples.f_r.rows(), samples.f_r.cols(), n, samples.channels.size()));
  }
  if (!samples.theta_i.allFinite() || !samples.phi_i.allFinite() || !samples.theta_r.allFinite() ||
      !samples.phi_r.allFinite() || !samples.f_r.allFinite()) {
    throw std::invalid_argument("expected finite angles and f_r");
  }
}

}  // namespace

SampledBrdf::SampledBrdf(const BrdfSamples& samples, std::vector<std::string>& warnings) {
  require_whole(samples);
  std::vector<Index> order(samples.channels.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::ranges::stable_sort(order, [&](Index a, Index b) {
    return comes_before(samples.channels[std::size_t(a)], samples.channels[std::size_t(b)]);
  });
  for (const Index channel : order) {
    channels_.push_back(samples.channels[std::size_t(channel)]);
  }
  const BrdfPoints points = brdf_points(samples, order, warnings);
  interpolation_ = make_brdf_interpolation(points, channels_, warnings);
  const double largest_r = points.theta_r.maxCoeff(), largest_i = points.theta_i.maxCoeff();
  largest_theta_ = radians(std::min(largest_i, largest_r));
}

void SampledBrdf::evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                           Eigen::Ref<Eigen::ArrayXXd> f_r) const {
  interpolation_->evaluate(omega_i, omega_r, f_r);
}

Angle SampledBrdf::step(Angle theta_i) const { return interpolation_->step(theta_i); }

}  // namespace gonio
