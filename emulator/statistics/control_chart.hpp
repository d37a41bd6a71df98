#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "emulator/statistics/chart_points.hpp"
#include "emulator/statistics/control_chart_constants.hpp"
#include "emulator/statistics/western_electric.hpp"

namespace gonio {

/// A point that a rule speaks of: the last one of those it takes.
struct ControlSignal {
  std::uint64_t point = 1;  ///< from 1
  int rule = 1;             ///< 1 to 4
};

/// A chart whose points came one after another. A point has the number of its subgroup; the first
/// moving range is that of subgroup 2.
struct ControlChart {
  double centre = 0.0;
  double lower = 0.0, upper = 0.0;  ///< control limits of subgroups of the usual size
  double sigma = 0.0;  ///< of a point; 0 while the baseline knows no spread: then no rule is asked
  std::uint64_t points = 0;
  std::vector<ChartPoint> shown = {};                              ///< at most 400
  std::array<std::uint64_t, western_electric_rules> signals = {};  ///< how often, by rule
  std::vector<ControlSignal> first_signals = {};                   ///< at most 100
  [[nodiscard]] bool in_control() const;
};

/// Charts of subgroups, in memory that does not grow: limits are those of a baseline, the first
/// subgroups, as control charts are used; the rules are asked of all points. Of the range, and of
/// the moving range, only rule 1 is asked: their distribution is not symmetric.
///
/// Sigma is the mean over the baseline of R / d2, each with d2 of its own size, for X-bar and R,
/// and the mean moving range over d2 of two for I and MR.
class ControlCharts {
 public:
  struct Result {
    std::size_t subgroup_size = 0;  ///< usual one: the most frequent in the baseline, or the least
                                    ///< of several such
    std::uint64_t baseline = 0;     ///< subgroups that the limits rest on
    std::optional<ControlChart> mean, range;  ///< X-bar and R; nothing for subgroups of one, or of
                                              ///< more than 100
    ControlChart individual, moving_range;    ///< I and MR, of the means
  };

  /// @param baseline  subgroups, >= 2.
  /// @throws std::domain_error  for fewer.
  explicit ControlCharts(std::size_t baseline = 100);
  /// A subgroup. Where its size is not the usual one its own limits count for the rules; one of a
  /// single value, or of more than 100, has no point on the chart of ranges.
  /// @throws std::domain_error  for n = 0, or numbers that are none.
  void add(std::size_t n, double mean, double range);
  /// With fewer subgroups than the baseline wants: limits of those there are.
  [[nodiscard]] Result result() const;

 private:
  struct Subgroup {
    std::size_t n = 0;
    double mean = 0.0, range = 0.0;
  };
  // A chart that goes on: its points are kept apart until somebody asks.
  struct Recorder {
    ControlChart chart = {};
    ChartPoints points = {};
    WesternElectric rules = {};
    void set(double centre, double sigma, double lower, double upper);
    void add(std::uint64_t number, double value, double z, bool only_rule_1 = false);
    [[nodiscard]] ControlChart result() const;
  };
  // All charts from when their limits are known.
  struct Charts {
    explicit Charts(const std::vector<Subgroup>& baseline);
    void add(const Subgroup& subgroup);
    [[nodiscard]] Result result() const;

    std::size_t usual = 0;
    std::uint64_t baseline = 0, subgroups = 0;
    double within = 0.0;  // sigma of single values within a subgroup
    double last_mean = 0.0;
    Recorder mean = {}, range = {}, individual = {}, moving_range = {};
  };

  std::size_t wanted_;
  std::vector<Subgroup> baseline_;  // as long as it is not complete
  std::optional<Charts> charts_;    // from then on
};

}  // namespace gonio
