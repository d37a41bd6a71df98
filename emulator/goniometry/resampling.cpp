#include "emulator/goniometry/resampling.hpp"

#include <algorithm>
#include <stdexcept>

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// The n + 1 borders between pixels; the outer ones as far from the middles as the inner ones.
ArrayXd borders(const ArrayXd& x) {
  const Index n = x.size();
  ArrayXd edges(n + 1);
  edges.segment(1, n - 1) = 0.5 * (x.head(n - 1) + x.tail(n - 1));
  edges(0) = x(0) - (edges(1) - x(0));
  edges(n) = x(n - 1) + (x(n - 1) - edges(n - 1));
  return edges;
}

void expect_pixels(const ArrayXd& x, const std::vector<bool>& is_valid) {
  const Index n = x.size();
  if (n < 2 || is_valid.size() != std::size_t(n) || !(x.tail(n - 1) > x.head(n - 1)).all()) {
    throw std::invalid_argument("band_weights: expected at least two pixels that ascend");
  }
}

BandWeights mean_band(const ArrayXd& edges, const std::vector<bool>& is_valid, double low,
                      double high) {
  const Index n = edges.size() - 1;
  const auto pixel_at = [&](double lambda) {
    const auto after = std::upper_bound(edges.begin(), edges.end(), lambda);
    return std::clamp<Index>(after - edges.begin() - 1, 0, n - 1);
  };
  const Index first = pixel_at(low);
  const Index last = pixel_at(high);
  BandWeights band{.first = first, .weight = ArrayXd::Zero(last - first + 1)};
  double covered = 0.0;
  for (Index p = first; p <= last; ++p) {
    const double overlap = std::min(high, edges(p + 1)) - std::max(low, edges(p));
    if (overlap > 0.0 && is_valid[std::size_t(p)]) {
      band.weight(p - first) = overlap / (edges(p + 1) - edges(p));
      covered += overlap;
    }
  }
  if (covered < 0.5 * (high - low)) {
    return {};
  }
  band.weight /= covered;
  return band;
}

BandWeights linear_band(const ArrayXd& x, const ArrayXd& edges, const std::vector<bool>& is_valid,
                        double lambda) {
  const auto after = std::upper_bound(x.begin(), x.end(), lambda);
  const Index low = std::clamp<Index>(after - x.begin() - 1, 0, x.size() - 2);
  const double t = (lambda - x(low)) / (x(low + 1) - x(low));
  const bool is_used[] = {t<1.0, t> 0.0};
  for (Index k = 0; k < 2; ++k) {
    if (t < 0.0 || t > 1.0 || (is_used[k] && !is_valid[std::size_t(low + k)])) {
      return {.is_mean = false};
    }
  }
  BandWeights band{.first = low, .weight = ArrayXd(2), .is_mean = false};
  band.weight << (1.0 - t) / (edges(low + 1) - edges(low)), t / (edges(low + 2) - edges(low + 1));
  return band;
}

}  // namespace

std::vector<BandWeights> band_weights(const ArrayXd& wavelength_nm,
                                      const std::vector<bool>& is_valid,
                                      const WavelengthGrid& grid) {
  expect_pixels(wavelength_nm, is_valid);
  const ArrayXd edges = borders(wavelength_nm);
  const ArrayXd& lambda = grid.nanometres();
  const double step = lambda.size() > 1 ? lambda(1) - lambda(0) : 1.0;
  std::vector<BandWeights> bands;
  for (Index j = 0; j < lambda.size(); ++j) {
    const auto after = std::upper_bound(wavelength_nm.begin(), wavelength_nm.end(), lambda(j));
    const Index right =
        std::clamp<Index>(after - wavelength_nm.begin(), 1, wavelength_nm.size() - 1);
    const bool is_fine = wavelength_nm(right) - wavelength_nm(right - 1) <= step * (1.0 + 1e-9);
    bands.push_back(is_fine
                        ? mean_band(edges, is_valid, lambda(j) - 0.5 * step, lambda(j) + 0.5 * step)
                        : linear_band(wavelength_nm, edges, is_valid, lambda(j)));
  }
  return bands;
}

double band_density(const BandWeights& band, const ArrayXd& counts) {
  return (band.weight * counts.segment(band.first, band.weight.size())).sum();
}

double band_variance(const BandWeights& band, const ArrayXd& variance) {
  return (band.weight.square() * variance.segment(band.first, band.weight.size())).sum();
}

}  // namespace gonio
