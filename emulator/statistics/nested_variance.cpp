#include "emulator/statistics/nested_variance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gonio {

void NestedVariance::WeightedMean::add(double weight, double value) {
  const double from_last_mean = value - mean;
  total += weight;
  squares_of_weights += weight * weight;
  mean += from_last_mean * (weight / total);
  sum_of_squares += weight * from_last_mean * (value - mean);
}

void NestedVariance::Lots::add(const WeightedMean& lot) {
  means.add(lot.total, lot.mean);
  within += lot.sum_of_squares;
  squares_of_panels += lot.squares_of_weights;
  squares_by_lot += lot.squares_of_weights / lot.total;
}

void NestedVariance::add(std::uint64_t lot, std::size_t n, double mean, double standard_deviation) {
  if (n == 0 || !std::isfinite(mean) || !(standard_deviation >= 0.0)) {
    throw std::domain_error(
        fmt::format("NestedVariance::add: expected readings with a mean and a standard deviation "
                    ">= 0, found {} with {} and {}",
                    n, mean, standard_deviation));
  }
  if (panels_ == 0 || lot != lot_) {
    if (panels_ > 0) {
      closed_.add(open_);
    }
    open_ = {};
    lot_ = lot;
    ++lots_;
  }
  open_.add(double(n), mean);
  readings_ += n;
  ++panels_;
  within_panels_ += double(n - 1) * standard_deviation * standard_deviation;
}

// With the sums of squares of lots, panels and readings, N readings, B panels, a lots:
//
//   E[SS_readings] = (N - B) s_r^2
//   E[SS_panels] = (B - a) s_r^2 + (N - sum_i sum_j n_ij^2 / n_i) s_p^2
//   E[SS_lots] = (a - 1) s_r^2 + (sum_i sum_j n_ij^2 / n_i - sum n_ij^2 / N) s_p^2
//                + (N - sum n_i^2 / N) s_l^2
NestedSpread NestedVariance::result() const {
  NestedSpread result{.lots = lots_, .panels = panels_, .readings = readings_};
  if (panels_ == 0) {
    return result;
  }
  Lots all = closed_;
  all.add(open_);
  result.mean = all.means.mean;
  result.freedom_lots = lots_ - 1;
  result.freedom_panels = panels_ - lots_;
  result.freedom_readings = readings_ - panels_;
  const double n = double(readings_);
  double readings = 0.0, panels = 0.0, lots = 0.0;  // variances
  if (result.freedom_readings > 0) {
    readings = within_panels_ / double(result.freedom_readings);
  }
  if (result.freedom_panels > 0) {
    panels = (all.within - double(result.freedom_panels) * readings) / (n - all.squares_by_lot);
  }
  if (result.freedom_lots > 0) {
    lots = (all.means.sum_of_squares - double(result.freedom_lots) * readings -
            (all.squares_by_lot - all.squares_of_panels / n) * panels) /
           (n - all.means.squares_of_weights / n);
  }
  // Each from what the others are estimated at, negative or not: so none is biased.
  result.sd_readings = std::sqrt(readings);
  result.sd_panels = std::sqrt(std::max(panels, 0.0));
  result.sd_lots = std::sqrt(std::max(lots, 0.0));
  return result;
}

}  // namespace gonio
