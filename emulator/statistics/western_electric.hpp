#pragma once

#include <array>
#include <cstddef>

namespace gonio {

/// Rules that tell a process that is not in control: 1, a point beyond three sigma; 2, two of three
/// beyond two sigma on one side; 3, four of five beyond one sigma on one side; 4, eight in a row on
/// one side. @see Western Electric, Statistical Quality Control Handbook (1956)
constexpr std::size_t western_electric_rules = 4;

/// The rules, asked of points that come one after another. Each speaks at the last point of its
/// pattern, which is itself beyond the line: rules 2 and 3 do not speak at a quiet point after
/// others. A pattern that goes on is told again at each further point: a run of ten on one side
/// breaks rule 4 three times. A point on the line is not beyond it; one on the centre ends a run.
class WesternElectric {
 public:
  /// Of rules 1 to 4, those that this point breaks.
  using Broken = std::array<bool, western_electric_rules>;
  /// @param z  distance of the point from the centre, in sigma.
  [[nodiscard]] Broken add(double z);

 private:
  std::array<double, 5> last_ = {};  // points before the first one are on the centre
  int run_ = 0;                      // points in a row above the centre; below, negative
};

}  // namespace gonio
