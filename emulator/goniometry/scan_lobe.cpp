#include "emulator/goniometry/scan_lobe.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double same_deg = 1e-6;

/// Where stretches end that belong to ascending values: half way between them.
struct Stretch {
  double low, high;
};

std::vector<Stretch> stretches(const std::vector<double>& values, double low, double high) {
  std::vector<Stretch> result;
  for (std::size_t k = 0; k < values.size(); ++k) {
    result.push_back({k == 0 ? low : 0.5 * (values[k - 1] + values[k]),
                      k + 1 == values.size() ? high : 0.5 * (values[k] + values[k + 1])});
  }
  return result;
}

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto last = std::unique(values.begin(), values.end(),
                                [](double a, double b) { return b - a < same_deg; });
  values.erase(last, values.end());
  return values;
}

std::size_t place_in(const std::vector<double>& values, double value) {
  const auto found = std::lower_bound(values.begin(), values.end(), value - same_deg);
  return std::size_t(std::min(found - values.begin(), std::ptrdiff_t(values.size()) - 1));
}

/// On the stage, in [0, 360) deg.
double azimuth_deg(const ScanPosition& position) {
  ScanPosition unturned = position;
  unturned.rotation = {};
  return unturned.azimuth_r().degrees();
}

/// What each azimuth counts [rad], of sum 2 pi; nothing if they do not go all round.
std::optional<std::vector<double>> azimuth_weights(const std::vector<double>& azimuth,
                                                   bool is_isotropic) {
  constexpr double widest_deg = 45.0;
  for (std::size_t k = 0; k + 1 < azimuth.size(); ++k) {
    if (azimuth[k + 1] - azimuth[k] > widest_deg + same_deg) {
      return std::nullopt;
    }
  }
  const bool is_half =
      is_isotropic && azimuth.front() < same_deg && std::abs(azimuth.back() - 180.0) < same_deg;
  const double across = azimuth.front() + 360.0 - azimuth.back();
  if (!is_half && across > widest_deg + same_deg) {
    return std::nullopt;
  }
  std::vector<double> weights;
  for (const Stretch& part : is_half ? stretches(azimuth, 0.0, 180.0)
                                     : stretches(azimuth, azimuth.front() - 0.5 * across,
                                                 azimuth.back() + 0.5 * across)) {
    weights.push_back((is_half ? 2.0 : 1.0) * degrees(part.high - part.low).radians());
  }
  return weights;
}

/// f_r at a position, or between its neighbours at the same azimuth where it is blocked.
ArrayXd known_f_r(const ScanResult& result, Index at) {
  const auto is_known = [&](Index p) {
    return result.state[std::size_t(p)] != PositionState::blocked;
  };
  if (is_known(at)) {
    return result.f_r.col(at);
  }
  const auto is_near = [&](Index p) {
    return p >= 0 && p < result.size() &&
           result.positions[std::size_t(p)].phi_r == result.positions[std::size_t(at)].phi_r &&
           result.positions[std::size_t(p)].theta_i == result.positions[std::size_t(at)].theta_i;
  };
  ArrayXd sum = ArrayXd::Zero(result.f_r.rows());
  int count = 0;
  for (const Index step : {Index{-1}, Index{1}}) {
    Index p = at + step;
    while (is_near(p) && !is_known(p)) {
      p += step;
    }
    if (is_near(p)) {
      sum += result.f_r.col(p);
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

Angle angle_from_mirror(const ScanPosition& position) {
  ScanPosition mirrored = position;
  mirrored.rotation = {};
  const Vector3 r =
      frame_towards(radians(std::abs(position.theta_r.radians())), mirrored.azimuth_r()).axis;
  const Vector3 m = receptor_frame(position.theta_i).axis;
  return radians(std::atan2(m.cross(r).norm(), m.dot(r)));
}

void complete(ScanLobe& lobe, const ScanResult& result) {
  double highest = -1.0;
  std::vector<ScanPosition> positions;
  for (const Index p : lobe.positions) {
    positions.push_back(result.positions[std::size_t(p)]);
    const double f_r = result.weighted(p);
    if (f_r > highest) {  // false for the NaN of a blocked position
      highest = f_r;
      lobe.peak = p;
    }
  }
  lobe.from_mirror = angle_from_mirror(result.positions[std::size_t(lobe.peak)]);
  if (const auto weights = hemisphere_weights(positions, result.is_isotropic)) {
    ArrayXd sum = ArrayXd::Zero(result.f_r.rows());
    for (std::size_t k = 0; k < positions.size(); ++k) {
      sum += (*weights)(Index(k)) * known_f_r(result, lobe.positions[k]);
    }
    lobe.hemispherical = sum;
  }
}

}  // namespace

std::optional<ArrayXd> hemisphere_weights(const std::vector<ScanPosition>& positions,
                                          bool is_isotropic) {
  std::vector<double> polar, azimuth;
  for (const ScanPosition& position : positions) {
    polar.push_back(position.theta_r.degrees());
    if (position.theta_r != Angle{}) {
      azimuth.push_back(azimuth_deg(position));
    }
  }
  polar = distinct(polar);
  azimuth = distinct(azimuth);
  constexpr double far_enough_deg = 80.0;
  if (polar.front() < 0.0 || polar.back() < far_enough_deg - same_deg || azimuth.empty()) {
    return std::nullopt;
  }
  const auto across = azimuth_weights(azimuth, is_isotropic);
  if (!across) {
    return std::nullopt;
  }
  const auto along = stretches(polar, 0.0, 90.0);
  ArrayXd weights(Index(positions.size()));
  for (std::size_t p = 0; p < positions.size(); ++p) {
    const auto [low, high] = along[place_in(polar, positions[p].theta_r.degrees())];
    const double sine_low = std::sin(degrees(low).radians());
    const double sine_high = std::sin(degrees(high).radians());
    const double turn = positions[p].theta_r == Angle{}
                            ? 2.0 * std::numbers::pi
                            : (*across)[place_in(azimuth, azimuth_deg(positions[p]))];
    weights(Index(p)) = 0.5 * (sine_high * sine_high - sine_low * sine_low) * turn;
  }
  return weights;
}

std::vector<ScanLobe> scan_lobes(const ScanResult& result) {
  std::vector<ScanLobe> lobes;
  bool is_open = false;
  for (Index p = 0; p < result.size(); ++p) {
    const ScanPosition& position = result.positions[std::size_t(p)];
    if (lobes.empty() || lobes.back().theta_i != position.theta_i ||
        lobes.back().rotation != position.rotation) {
      if (!lobes.empty() && !is_open) {
        lobes.pop_back();
      }
      lobes.push_back({.theta_i = position.theta_i, .rotation = position.rotation});
      is_open = false;
    }
    lobes.back().positions.push_back(p);
    is_open = is_open || result.state[std::size_t(p)] != PositionState::blocked;
  }
  if (!lobes.empty() && !is_open) {
    lobes.pop_back();
  }
  for (ScanLobe& lobe : lobes) {
    complete(lobe, result);
  }
  return lobes;
}

}  // namespace gonio
