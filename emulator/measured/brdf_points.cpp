#include "emulator/measured/brdf_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/measured/bracket.hpp"
#include "emulator/measured/text_brdf.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using std::numbers::pi;

/// A polar angle that is not negative, and its azimuth.
struct Polar {
  Polar(double signed_theta, double signed_phi)
      : theta(std::min(std::abs(signed_theta), pi / 2.0)),
        phi(signed_theta < 0.0 ? signed_phi + pi : signed_phi) {}
  double theta, phi;
};

/// By whole turns in (-pi, pi]; what rounding left at -pi is at pi.
double from_mirror(double angle) {
  const double positive = in_one_turn(angle);
  if (std::abs(positive - pi) < same_angle) {
    return pi;
  }
  const double result = positive > pi ? positive - 2.0 * pi : positive;
  return std::abs(result) < same_angle ? 0.0 : result;
}

double rotation_of(double angle) {
  const double rotation = in_one_turn(angle);
  return rotation > 2.0 * pi - same_angle ? 0.0 : rotation;
}

void mirror(BrdfPoints& points) {
  const auto is_on_line = [](double azimuth) { return azimuth == 0.0 || azimuth == pi; };
  const bool has_left = (points.azimuth < 0.0).any();
  const bool has_right =
      std::any_of(points.azimuth.begin(), points.azimuth.end(),
                  [&](double azimuth) { return azimuth > 0.0 && !is_on_line(azimuth); });
  points.is_mirrored = !(has_left && has_right);
  if (points.is_mirrored) {
    points.azimuth = points.azimuth.abs();
  }
}

}  // namespace

bool BrdfPoints::is_in_plane() const {
  return ((azimuth == 0.0) || (azimuth == pi) || (theta_r < same_angle)).all();
}

BrdfPoints brdf_points(const BrdfSamples& samples, const std::vector<Index>& channel_order,
                       std::vector<std::string>& warnings) {
  const Index n = samples.size();
  BrdfPoints points{.theta_i = Eigen::ArrayXd(n),
                    .rotation = Eigen::ArrayXd(n),
                    .theta_r = Eigen::ArrayXd(n),
                    .azimuth = Eigen::ArrayXd(n),
                    .f_r = Eigen::ArrayXXd(n, samples.f_r.cols())};
  std::vector<double> rotations;
  for (Index i = 0; i < n; ++i) {
    const Polar incident(samples.theta_i[i], samples.phi_i[i]);
    const Polar reflected(samples.theta_r[i], samples.phi_r[i]);
    points.theta_i[i] = incident.theta;
    points.rotation[i] = rotation_of(incident.phi - pi);
    points.theta_r[i] = reflected.theta;
    points.azimuth[i] = from_mirror(reflected.phi - incident.phi + pi);
    if (incident.theta > same_angle) {
      rotations.push_back(points.rotation[i]);
    }
  }
  points.is_isotropic = rotations.empty() || distinct_angles(rotations).size() == 1;
  for (std::size_t column = 0; column < channel_order.size(); ++column) {
    points.f_r.col(Index(column)) = samples.f_r.col(channel_order[column]);
  }
  clip_negative(points.f_r, warnings);
  mirror(points);
  return points;
}

Eigen::ArrayXd distinct_angles(std::vector<double> values) {
  std::ranges::sort(values);
  std::vector<double> distinct;
  for (const double value : values) {
    if (distinct.empty() || value - distinct.back() > same_angle) {
      distinct.push_back(value);
    }
  }
  return Eigen::Map<const Eigen::ArrayXd>(distinct.data(), Index(distinct.size()));
}

Index index_of_angle(const Eigen::ArrayXd& distinct, double value) {
  const double* const begin = distinct.data();
  return std::max<Index>(std::upper_bound(begin, begin + distinct.size(), value) - begin - 1, 0);
}

}  // namespace gonio
