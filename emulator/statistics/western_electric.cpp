#include "emulator/statistics/western_electric.hpp"

#include <algorithm>

namespace gonio {

WesternElectric::Broken WesternElectric::add(double z) {
  std::move_backward(last_.begin(), last_.end() - 1, last_.end());
  last_[0] = z;
  const double side = z < 0.0 ? -1.0 : 1.0;
  // Whether at least `wanted` of the last `of` points, this one among them, are beyond the line.
  const auto beyond = [&](double line, int wanted, int of) {
    const auto is_beyond = [&](double point) { return side * point > line; };
    return is_beyond(z) && std::count_if(last_.begin(), last_.begin() + of, is_beyond) >= wanted;
  };
  const bool goes_on = side * run_ > 0.0;
  run_ = z == 0.0 ? 0 : int(side) + (goes_on ? run_ : 0);
  run_ = std::clamp(run_, -8, 8);
  return {beyond(3.0, 1, 1), beyond(2.0, 2, 3), beyond(1.0, 4, 5), run_ == 8 || run_ == -8};
}

}  // namespace gonio
