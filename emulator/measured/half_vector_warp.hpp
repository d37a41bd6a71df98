#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace gonio {

/// The tables of an RGL file between which a direction of incidence lies, with their weights.
struct TableBlend {
  int count = 0;
  std::array<std::size_t, 4> table = {};
  std::array<float, 4> weight = {};
};

/// Linear in azimuth and polar angle of incidence [rad], tables in the order [phi_i][theta_i];
/// beyond the ends, the last one.
/// @param phi_i, theta_i  where the tables are: ascending, at least one each.
[[nodiscard]] TableBlend table_blend(std::span<const float> phi_i, std::span<const float> theta_i,
                                     double phi, double theta);

/// Densities on the unit square, bilinear between nodes, one for each direction of incidence, and
/// what makes them uniform: the distribution of y, and that of x given y.
/// @see the class Marginal2D of rgl-epfl/brdf-loader
class HalfVectorWarp {
 public:
  struct Size {
    std::size_t y, x;
  };

  /// @param density  not negative, shape (tables, size.y, size.x), both sizes at least 2.
  HalfVectorWarp(Size size, std::vector<float> density);

  /// The first table whose density is 0 everywhere, which is no density; or tables().
  [[nodiscard]] std::size_t empty_table() const { return empty_; }
  [[nodiscard]] std::size_t tables() const { return tables_; }

  /// The part of the density below y, and of that at y below x; x and y in [0, 1].
  /// @return {x, y}
  [[nodiscard]] std::pair<float, float> invert(const TableBlend& blend, float x, float y) const;

 private:
  Size size_;
  std::size_t tables_;
  std::size_t empty_;
  std::vector<float> density_, conditional_, marginal_;
};

}  // namespace gonio
