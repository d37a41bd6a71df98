#include "emulator/statistics/gauge_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <stdexcept>

namespace gonio {
namespace {

constexpr double pooled_above = 0.25;  // p of the interaction, as in the manual

void expect_fitting(const GaugeReadings& readings, std::optional<double> tolerance) {
  const auto& [parts, appraisers, repetitions, values] = readings;
  if (parts < 2 || appraisers < 1 || repetitions < 2 ||
      values.size() != parts * appraisers * repetitions) {
    throw std::invalid_argument(
        fmt::format("gauge_study: expected two parts, an appraiser, two repetitions or more and a "
                    "value of each, found {}, {}, {} and {} values",
                    parts, appraisers, repetitions, values.size()));
  }
  const auto wrong =
      std::find_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); });
  if (wrong != values.end()) {
    throw std::invalid_argument(
        fmt::format("gauge_study: expected finite values, found {}", *wrong));
  }
  if (tolerance && !(*tolerance > 0.0)) {
    throw std::invalid_argument(
        fmt::format("gauge_study: expected a tolerance > 0, found {}", *tolerance));
  }
}

struct Means {
  double all = 0.0;
  std::vector<double> parts, appraisers, cells;  // cells: shape (parts, appraisers)
};

Means means_of(const GaugeReadings& r) {
  Means means{.parts = std::vector<double>(r.parts),
              .appraisers = std::vector<double>(r.appraisers),
              .cells = std::vector<double>(r.parts * r.appraisers)};
  for (std::size_t cell = 0; cell < means.cells.size(); ++cell) {
    // From the first value on: so that equal values have no spread, to the last bit.
    double sum = 0.0;
    for (std::size_t i = 0; i < r.repetitions; ++i) {
      sum += r.values[cell * r.repetitions + i] - r.values[0];
    }
    const double mean = sum / double(r.repetitions);
    means.cells[cell] = mean;
    means.parts[cell / r.appraisers] += mean / double(r.appraisers);
    means.appraisers[cell % r.appraisers] += mean / double(r.parts);
    means.all += mean / double(means.cells.size());
  }
  return means;
}

AnovaRow row(double sum_of_squares, std::size_t degrees_of_freedom) {
  return {
      .sum_of_squares = sum_of_squares,
      .degrees_of_freedom = degrees_of_freedom,
      .mean_square = degrees_of_freedom == 0 ? 0.0 : sum_of_squares / double(degrees_of_freedom)};
}

double square(double x) { return x * x; }

void fill_table(GaugeStudy& study, const GaugeReadings& r) {
  const Means means = means_of(r);
  const double parts = double(r.parts), appraisers = double(r.appraisers),
               repetitions = double(r.repetitions);
  double part = 0.0, appraiser = 0.0, interaction = 0.0, repeatability = 0.0, total = 0.0;
  for (const double mean : means.parts) {
    part += appraisers * repetitions * square(mean - means.all);
  }
  for (const double mean : means.appraisers) {
    appraiser += parts * repetitions * square(mean - means.all);
  }
  for (std::size_t cell = 0; cell < means.cells.size(); ++cell) {
    interaction += repetitions * square(means.cells[cell] - means.parts[cell / r.appraisers] -
                                        means.appraisers[cell % r.appraisers] + means.all);
  }
  for (std::size_t i = 0; i < r.values.size(); ++i) {
    const double value = r.values[i] - r.values[0];
    repeatability += square(value - means.cells[i / r.repetitions]);
    total += square(value - means.all);
  }
  const bool several = r.appraisers > 1;
  study.part = row(part, r.parts - 1);
  study.appraiser = row(several ? appraiser : 0.0, r.appraisers - 1);
  study.interaction = row(several ? interaction : 0.0, (r.parts - 1) * (r.appraisers - 1));
  study.repeatability = row(repeatability, r.parts * r.appraisers * (r.repetitions - 1));
  study.total = row(total, r.values.size() - 1);
}

void test_against(const AnovaRow& error, AnovaRow& tested) {
  if (tested.degrees_of_freedom == 0 || !(error.mean_square > 0.0)) {
    return;
  }
  tested.f = tested.mean_square / error.mean_square;
  tested.p = cdf(complement(boost::math::fisher_f_distribution(double(tested.degrees_of_freedom),
                                                               double(error.degrees_of_freedom)),
                            *tested.f));
}

AnovaRow pooled(const AnovaRow& a, const AnovaRow& b) {
  return row(a.sum_of_squares + b.sum_of_squares, a.degrees_of_freedom + b.degrees_of_freedom);
}

double root(double variance) { return std::sqrt(std::max(variance, 0.0)); }

// What a mean square tells of its own component: what it has more than another, over so many.
double component(const AnovaRow& of, const AnovaRow& less, std::size_t values) {
  return of.degrees_of_freedom == 0 ? 0.0
                                    : root((of.mean_square - less.mean_square) / double(values));
}

Estimate interval(const AnovaRow& error) {
  constexpr double tail = 0.025;
  const double freedom = double(error.degrees_of_freedom);
  const boost::math::chi_squared_distribution chi_squared(freedom);
  const double sd = std::sqrt(error.mean_square);
  return {.value = sd,
          .low = sd * std::sqrt(freedom / quantile(complement(chi_squared, tail))),
          .high = sd * std::sqrt(freedom / quantile(chi_squared, tail))};
}

void fill_shares(GaugeStudy& study, std::optional<double> tolerance) {
  if (study.sd_total > 0.0) {
    const double share = study.sd_gauge / study.sd_total;
    study.percent_of_study = 100.0 * share;
    study.percent_contribution = 100.0 * share * share;
  }
  if (tolerance) {
    study.percent_of_tolerance = 600.0 * study.sd_gauge / *tolerance;
  }
  if (study.sd_part > 0.0) {
    const double categories = std::floor(1.41 * study.sd_part / study.sd_gauge);
    study.distinct_categories = int(std::clamp(categories, 1.0, double(most_distinct_categories)));
  }
}

}  // namespace

GaugeStudy gauge_study(const GaugeReadings& readings, std::optional<double> tolerance) {
  expect_fitting(readings, tolerance);
  const auto& [parts, appraisers, repetitions, values] = readings;
  GaugeStudy study;
  fill_table(study, readings);
  test_against(study.repeatability, study.interaction);
  study.interaction_pooled = study.interaction.p.value_or(0.0) > pooled_above;
  const AnovaRow repeatability = study.interaction_pooled
                                     ? pooled(study.repeatability, study.interaction)
                                     : study.repeatability;
  // What parts and appraisers are compared with: with one appraiser there is no interaction.
  const bool apart = appraisers > 1 && !study.interaction_pooled;
  const AnovaRow& error = apart ? study.interaction : repeatability;
  test_against(error, study.part);
  test_against(error, study.appraiser);

  study.sd_repeatability = root(repeatability.mean_square);
  study.sd_interaction = apart ? component(study.interaction, repeatability, repetitions) : 0.0;
  study.sd_appraiser = component(study.appraiser, error, parts * repetitions);
  study.sd_part = component(study.part, error, appraisers * repetitions);
  study.sd_reproducibility = std::hypot(study.sd_appraiser, study.sd_interaction);
  study.sd_gauge = std::hypot(study.sd_repeatability, study.sd_reproducibility);
  study.sd_total = std::hypot(study.sd_gauge, study.sd_part);
  study.repeatability_interval = interval(repeatability);
  fill_shares(study, tolerance);
  return study;
}

}  // namespace gonio
