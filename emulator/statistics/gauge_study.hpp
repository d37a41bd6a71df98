#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "emulator/statistics/estimate.hpp"

namespace gonio {

/// A crossed study: each part is read by each appraiser, the same number of times.
struct GaugeReadings {
  std::size_t parts = 0, appraisers = 0, repetitions = 0;  ///< >= 2, >= 1, >= 2
  std::vector<double> values = {};  ///< shape (parts, appraisers, repetitions), row-major
};

/// A line of the table of analysis of variance. F and p are nothing where there is nothing to test,
/// or nothing to compare it with.
struct AnovaRow {
  double sum_of_squares = 0.0;
  std::size_t degrees_of_freedom = 0;
  double mean_square = 0.0;
  std::optional<double> f = {}, p = {};
};

/// A gauge that tells more categories apart, or has no spread at all, is said to tell so many.
constexpr int most_distinct_categories = 1000;

/// Gauge repeatability and reproducibility by analysis of variance.
struct GaugeStudy {
  /// The table before anything is pooled: sums of squares and degrees of freedom add up to those of
  /// `total`. The interaction is tested against repeatability; parts and appraisers against the
  /// interaction, or where that is pooled against both together.
  AnovaRow part, appraiser, interaction, repeatability, total;
  bool interaction_pooled = false;  ///< its p was above 0.25: it counts as repeatability
  /// Standard deviations; a negative estimate of a variance counts as 0.
  double sd_repeatability = 0.0, sd_appraiser = 0.0, sd_interaction = 0.0;
  double sd_reproducibility = 0.0;  ///< appraiser and interaction
  double sd_gauge = 0.0;            ///< R&R
  double sd_part = 0.0, sd_total = 0.0;
  double percent_of_study = 0.0;                    ///< 100 sd_gauge / sd_total
  std::optional<double> percent_of_tolerance = {};  ///< 600 sd_gauge / (U - L)
  double percent_contribution = 0.0;                ///< 100 (sd_gauge / sd_total)^2
  int distinct_categories = 1;                      ///< floor(1.41 sd_part / sd_gauge), 1 at least
  std::optional<Estimate> repeatability_interval = {};  ///< of sd_repeatability, 95 %
};

/// @param tolerance  U - L, > 0, or nothing.
/// @throws std::invalid_argument  for numbers that do not fit, or values that are not finite.
/// @see    AIAG, Measurement Systems Analysis, chapter III, section B, ANOVA method
[[nodiscard]] GaugeStudy gauge_study(const GaugeReadings& readings,
                                     std::optional<double> tolerance = {});

}  // namespace gonio
