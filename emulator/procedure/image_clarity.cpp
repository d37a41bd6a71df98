#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "emulator/procedure/profile.hpp"

namespace gonio {

namespace {

/// The flux up to a place of the comb: linear within an element.
class Cumulative {
 public:
  Cumulative(const Profile& profile, double distance_mm) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < profile.edge_rad.size(); ++k) {
      place_.push_back(distance_mm * std::tan(profile.edge_rad(k)));
      sum += k > 0 ? profile.flux(k - 1) : 0.0;
      sum_.push_back(sum);
    }
  }

  [[nodiscard]] double at(double place) const {
    const auto above = std::upper_bound(place_.begin(), place_.end(), place);
    if (above == place_.begin()) {
      return 0.0;
    }
    if (above == place_.end()) {
      return sum_.back();
    }
    const auto k = std::size_t(above - place_.begin());
    const double t = (place - place_[k - 1]) / (place_[k] - place_[k - 1]);
    return sum_[k - 1] + t * (sum_[k] - sum_[k - 1]);
  }
  [[nodiscard]] double low() const { return place_.front(); }
  [[nodiscard]] double high() const { return place_.back(); }

 private:
  std::vector<double> place_, sum_;
};

}  // namespace

std::optional<double> image_clarity(const Profile& profile, double comb_mm, double distance_mm) {
  constexpr int shifts = 1024;
  constexpr double rounding = 1e-9;
  const Cumulative flux(profile, distance_mm);
  const double period = 2.0 * comb_mm;
  const double reach = std::min(-flux.low(), flux.high());
  const int periods = int(std::floor(2.0 * reach / period + rounding));
  if (periods < 1) {
    return std::nullopt;
  }
  const double low = -0.5 * periods * period;
  const double high = -low;
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (int i = 0; i < shifts; ++i) {
    double through = 0.0;
    // A period more than fits: as it slides, the comb comes in at one end and leaves at the other.
    for (int j = -1; j < periods; ++j) {
      const double begin = low + (j + double(i) / shifts) * period;
      const double from = std::max(begin, low);
      const double to = std::min(begin + comb_mm, high);
      through += to > from ? flux.at(to) - flux.at(from) : 0.0;
    }
    least = std::min(least, through);
    most = std::max(most, through);
  }
  return most + least > 0.0 ? std::optional(100.0 * (most - least) / (most + least)) : std::nullopt;
}

}  // namespace gonio
