#include "emulator/measured/specular_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "emulator/measured/bracket.hpp"
#include "emulator/measured/incidence_frame.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using std::numbers::pi;

/// Of the azimuth about, and the angle to, the mirror direction.
struct SpecularAngles {
  double azimuth, radial;
};

SpecularAngles specular_angles(const Vector3& local, double theta_i) {
  const double sin_i = std::sin(theta_i), cos_i = std::cos(theta_i);
  const double along = sin_i * local.x() + cos_i * local.z();
  const double to_normal = sin_i * local.z() - cos_i * local.x();
  return {.azimuth = in_one_turn(std::atan2(-local.y(), to_normal)),
          .radial = std::atan2(std::hypot(to_normal, local.y()), along)};
}

void require_ascending(const char* name, const Eigen::ArrayXd& angles, double largest) {
  constexpr double rounding = 1e-9;
  bool ascends = angles.size() > 0 && angles.allFinite() && angles[0] >= 0.0 &&
                 angles[angles.size() - 1] <= largest + rounding;
  for (Index i = 1; ascends && i < angles.size(); ++i) {
    ascends = angles[i] > angles[i - 1];
  }
  if (!ascends) {
    throw std::invalid_argument(
        fmt::format("expected {} that ascend in [0, {:.4f}] rad", name, largest));
  }
}

}  // namespace

double SpecularTable::Grid::cos_theta_r(Index i_theta_i, Index i_azimuth, Index i_radial) const {
  const double theta = theta_i[i_theta_i];
  return std::cos(radial[i_radial]) * std::cos(theta) +
         std::sin(radial[i_radial]) * std::sin(theta) * std::cos(azimuth[i_azimuth]);
}

SpecularTable::SpecularTable(std::vector<BrdfChannel> channels, Grid grid, Eigen::ArrayXXd f_r)
    : channels_(std::move(channels)), grid_(std::move(grid)), root_(f_r.max(0.0).sqrt().sqrt()) {
  require_ascending("rotations", grid_.rotation, 2.0 * pi);
  require_ascending("angles of incidence", grid_.theta_i, pi / 2.0);
  require_ascending("azimuths", grid_.azimuth, 2.0 * pi);
  require_ascending("radial angles", grid_.radial, pi);
  if (root_.rows() != grid_.size() || root_.cols() != Index(channels_.size()) ||
      channels_.empty()) {
    throw std::invalid_argument(
        fmt::format("expected f_r of {} nodes and {} channels, found {}, {}", grid_.size(),
                    channels_.size(), root_.rows(), root_.cols()));
  }
  constexpr double rounding = 1e-6;
  is_mirrored_ = grid_.azimuth[grid_.azimuth.size() - 1] <= pi + rounding;
  continue_below_surface();
}

/// Else what is next to the horizon would be darkened by nodes beyond it, or by 0 at it.
void SpecularTable::continue_below_surface() {
  constexpr double horizon = 1e-6;
  for (Index rotation = 0; rotation < grid_.rotation.size(); ++rotation) {
    for (Index theta = 0; theta < grid_.theta_i.size(); ++theta) {
      for (Index azimuth = 0; azimuth < grid_.azimuth.size(); ++azimuth) {
        const Index begin = grid_.row(rotation, theta, azimuth, 0);
        for (Index radial = 1; radial < grid_.radial.size(); ++radial) {
          const double cos_theta_r = grid_.cos_theta_r(theta, azimuth, radial);
          if (cos_theta_r < -horizon ||
              (cos_theta_r < horizon && (root_.row(begin + radial) == 0.0).all())) {
            root_.row(begin + radial) = root_.row(begin + radial - 1);
          }
        }
      }
    }
  }
}

void SpecularTable::evaluate(const Vector3& omega_i, const DirectionBatch& omega_r,
                             Eigen::Ref<Eigen::ArrayXXd> f_r) const {
  f_r.setZero();
  if (omega_i.z() <= 0.0) {
    return;
  }
  const IncidenceFrame frame(omega_i);
  const Bracket rotation = bracket_on_circle(grid_.rotation, frame.rotation());
  const Bracket theta = bracket(grid_.theta_i, frame.theta_i());
  const std::array<std::pair<Index, double>, 4> incidences{
      {{grid_.row(rotation.first, theta.first, 0, 0),
        (1.0 - rotation.weight) * (1.0 - theta.weight)},
       {grid_.row(rotation.first, theta.second, 0, 0), (1.0 - rotation.weight) * theta.weight},
       {grid_.row(rotation.second, theta.first, 0, 0), rotation.weight * (1.0 - theta.weight)},
       {grid_.row(rotation.second, theta.second, 0, 0), rotation.weight * theta.weight}}};
  for (Index i = 0; i < omega_r.size(); ++i) {
    if (omega_r.z[i] <= 0.0) {
      continue;
    }
    const SpecularAngles angles =
        specular_angles(frame.local(omega_r.x[i], omega_r.y[i], omega_r.z[i]), frame.theta_i());
    const Bracket radial = bracket(grid_.radial, angles.radial);
    const Bracket azimuth = is_mirrored_
                                ? bracket(grid_.azimuth, pi - std::abs(angles.azimuth - pi))
                                : bracket_on_circle(grid_.azimuth, angles.azimuth);
    const Index first = azimuth.first * grid_.radial.size();
    const Index second = azimuth.second * grid_.radial.size();
    for (const auto& [begin, weight] : incidences) {
      if (weight == 0.0) {
        continue;
      }
      const double at_first = weight * (1.0 - azimuth.weight), at_second = weight * azimuth.weight;
      f_r.row(i) += at_first * (1.0 - radial.weight) * root_.row(begin + first + radial.first) +
                    at_first * radial.weight * root_.row(begin + first + radial.second) +
                    at_second * (1.0 - radial.weight) * root_.row(begin + second + radial.first) +
                    at_second * radial.weight * root_.row(begin + second + radial.second);
    }
    f_r.row(i) = f_r.row(i).square().square();
  }
}

Angle SpecularTable::step(Angle) const {
  return radians(grid_.radial.size() > 1 ? grid_.radial[1] - grid_.radial[0] : pi);
}

Angle SpecularTable::largest_theta() const {
  return radians(grid_.theta_i[grid_.theta_i.size() - 1]);
}

}  // namespace gonio
