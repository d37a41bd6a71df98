#include "emulator/integration/region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gonio {

namespace {

bool is_circle(const Aperture& aperture) { return aperture.outline() == Aperture::Outline::circle; }

/// Keeps of [low, high] what satisfies a + b v >= 0.
void keep_half_plane(double a, double b, double& low, double& high) {
  if (b > 0.0) {
    low = std::max(low, -a / b);
  } else if (b < 0.0) {
    high = std::min(high, -a / b);
  } else if (a < 0.0) {
    high = low - 1.0;
  }
}

}  // namespace

double Region::p_low() const {
  return is_circle(aperture_) ? -0.5 * std::numbers::pi : aperture_.u_low();
}

double Region::p_high() const {
  return is_circle(aperture_) ? 0.5 * std::numbers::pi : aperture_.u_high();
}

Region::Row Region::row(double p) const {
  Row row{.u = p, .du_dp = 1.0, .v_low = aperture_.v_low(), .v_high = aperture_.v_high()};
  if (is_circle(aperture_)) {
    const double radius = aperture_.u_high();
    row = {.u = radius * std::sin(p),
           .du_dp = radius * std::cos(p),
           .v_low = -radius * std::cos(p),
           .v_high = radius * std::cos(p)};
  }
  if (other_) {
    clip(row);
  }
  return row;
}

void Region::clip(Row& row) const {
  // Along the row, omega = start + v * step, not normalised.
  const Vector3 start = frame().axis + row.u * frame().u;
  const Vector3& step = frame().v;
  const Frame& seen = other_->frame();
  const double a = start.dot(seen.axis);
  const double b = step.dot(seen.axis);
  keep_half_plane(a, b, row.v_low, row.v_high);  // in front of the other aperture
  if (!is_circle(*other_)) {
    const double au = start.dot(seen.u), bu = step.dot(seen.u);
    const double av = start.dot(seen.v), bv = step.dot(seen.v);
    keep_half_plane(au - other_->u_low() * a, bu - other_->u_low() * b, row.v_low, row.v_high);
    keep_half_plane(other_->u_high() * a - au, other_->u_high() * b - bu, row.v_low, row.v_high);
    keep_half_plane(av - other_->v_low() * a, bv - other_->v_low() * b, row.v_low, row.v_high);
    keep_half_plane(other_->v_high() * a - av, other_->v_high() * b - bv, row.v_low, row.v_high);
    return;
  }
  // (a + b v)^2 >= cos^2(radius) (1 + u^2 + v^2). Cones are at most 60 deg from their axis, and v
  // is nearly across it, so that b^2 < cos^2 and the row meets the cone in one stretch.
  const double cos2 = 1.0 / (1.0 + other_->u_high() * other_->u_high());
  const double square = cos2 - b * b;
  const double middle = a * b / square;
  const double rest = (a * a - cos2 * (1.0 + row.u * row.u)) / square + middle * middle;
  if (square <= 0.0 || rest <= 0.0) {
    row.v_high = row.v_low - 1.0;
    return;
  }
  row.v_low = std::max(row.v_low, middle - std::sqrt(rest));
  row.v_high = std::min(row.v_high, middle + std::sqrt(rest));
}

double Region::p_at(double u) const {
  if (!is_circle(aperture_)) {
    return std::clamp(u, p_low(), p_high());
  }
  const double radius = aperture_.u_high();
  return radius > 0.0 ? std::asin(std::clamp(u / radius, -1.0, 1.0)) : 0.0;
}

std::vector<double> Region::corners() const {
  std::vector<double> result;
  if (!other_) {
    return result;
  }
  const std::array<double, 2> us{other_->u_low(), other_->u_high()};
  const std::array<double, 2> vs{other_->v_low(), other_->v_high()};
  std::array<std::optional<PlanePoint>, 4> vertex;  // of the other aperture, or of its outer square
  for (std::size_t i = 0; i < 4; ++i) {
    const double u = us[i == 1 || i == 2 ? 1 : 0];
    vertex[i] = project(frame(), other_->frame().direction(u, vs[i / 2]));
  }
  const auto add = [&](double u) {
    if (u > aperture_.u_low() && u < aperture_.u_high()) {
      result.push_back(p_at(u));
    }
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& from = vertex[i];
    const auto& to = vertex[(i + 1) % 4];
    if (!from || !to) {
      continue;
    }
    add(from->u);
    for (const double v : {aperture_.v_low(), aperture_.v_high()}) {
      const double t = (v - from->v) / (to->v - from->v);
      if (t > 0.0 && t < 1.0) {
        add(std::lerp(from->u, to->u, t));
      }
    }
  }
  return result;
}

std::optional<PlanePoint> project(const Frame& frame, const Vector3& omega) {
  const double along = omega.dot(frame.axis);
  if (!(along > 1e-9)) {
    return std::nullopt;
  }
  return PlanePoint{omega.dot(frame.u) / along, omega.dot(frame.v) / along};
}

}  // namespace gonio
