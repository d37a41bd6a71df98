#include "emulator/measured/half_vector_warp.hpp"

#include <algorithm>

namespace gonio {

namespace {

struct Between {
  std::size_t index;  ///< of the node below
  float weight;       ///< of the one above it
};

Between between(std::span<const float> nodes, double value) {
  if (nodes.size() == 1) {
    return {0, 0.0F};
  }
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, value);
  const auto index = std::size_t(above - nodes.begin()) - 1;
  const double step = double(nodes[index + 1]) - double(nodes[index]);
  return {index, float(std::clamp((value - double(nodes[index])) / step, 0.0, 1.0))};
}

}  // namespace

TableBlend table_blend(std::span<const float> phi_i, std::span<const float> theta_i, double phi,
                       double theta) {
  const Between in_phi = between(phi_i, phi);
  const Between in_theta = between(theta_i, theta);
  TableBlend blend;
  for (const std::size_t p : {0U, 1U}) {
    for (const std::size_t t : {0U, 1U}) {
      const float weight = (p == 0 ? 1.0F - in_phi.weight : in_phi.weight) *
                           (t == 0 ? 1.0F - in_theta.weight : in_theta.weight);
      if (weight > 0.0F) {
        const auto slot = std::size_t(blend.count++);
        blend.table[slot] = (in_phi.index + p) * theta_i.size() + in_theta.index + t;
        blend.weight[slot] = weight;
      }
    }
  }
  return blend;
}

HalfVectorWarp::HalfVectorWarp(Size size, std::vector<float> density)
    : size_(size),
      tables_(density.size() / (size.x * size.y)),
      empty_(tables_),
      density_(std::move(density)),
      conditional_(density_.size()),
      marginal_(tables_ * size.y) {
  for (std::size_t table = tables_; table-- > 0;) {
    const std::span<float> f(density_.data() + table * size.x * size.y, size.x * size.y);
    const std::span<float> conditional(conditional_.data() + table * f.size(), f.size());
    const std::span<float> marginal(marginal_.data() + table * size.y, size.y);
    double sum = 0.0;
    double below = 0.0;
    for (std::size_t y = 0; y < size.y; ++y) {
      double row = 0.0;
      for (std::size_t i = y * size.x; i + 1 < (y + 1) * size.x; ++i) {
        row += 0.5 * (double(f[i]) + double(f[i + 1]));
        conditional[i + 1] = float(row);
      }
      sum += y == 0 ? 0.0 : 0.5 * (below + row);
      marginal[y] = float(sum);
      below = row;
    }
    if (!(sum > 0.0)) {
      empty_ = table;
      continue;
    }
    const double scale = 1.0 / sum;
    for (const std::span<float> part : {f, conditional, marginal}) {
      std::ranges::for_each(part, [scale](float& value) { value = float(double(value) * scale); });
    }
  }
}

std::pair<float, float> HalfVectorWarp::invert(const TableBlend& blend, float x, float y) const {
  x *= float(size_.x - 1);
  y *= float(size_.y - 1);
  const std::size_t column = std::min(std::size_t(x), size_.x - 2);
  const std::size_t row = std::min(std::size_t(y), size_.y - 2);
  x -= float(column);
  y -= float(row);
  float left = 0.0F;     // density at the node before x, at y
  float right = 0.0F;    // and after it
  float before = 0.0F;   // integral of the row at y up to the node before x
  float whole_0 = 0.0F;  // integral of the row below y, and of the one above
  float whole_1 = 0.0F;
  float below = 0.0F;  // integral of all rows up to the one below y
  for (int k = 0; k < blend.count; ++k) {
    const std::size_t table = blend.table[std::size_t(k)];
    const float weight = blend.weight[std::size_t(k)];
    const std::size_t first = (table * size_.y + row) * size_.x;
    const float* const f = density_.data() + first;
    const float* const c = conditional_.data() + first;
    const auto at_y = [&](const float* values, std::size_t i) {
      return (1.0F - y) * values[i] + y * values[i + size_.x];
    };
    left += weight * at_y(f, column);
    right += weight * at_y(f, column + 1);
    before += weight * at_y(c, column);
    whole_0 += weight * c[size_.x - 1];
    whole_1 += weight * c[2 * size_.x - 1];
    below += weight * marginal_[table * size_.y + row];
  }
  const float row_integral = (1.0F - y) * whole_0 + y * whole_1;
  const float up_to_x = before + x * (left + 0.5F * x * (right - left));
  const float up_to_y = below + y * (whole_0 + 0.5F * y * (whole_1 - whole_0));
  // A row without density has no place of its own: any is as good.
  return {row_integral > 0.0F ? std::clamp(up_to_x / row_integral, 0.0F, 1.0F) : 0.0F,
          std::clamp(up_to_y, 0.0F, 1.0F)};
}

}  // namespace gonio
