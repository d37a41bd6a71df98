#include "emulator/procedure/worst_case.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>

#include "emulator/core/parallel_for.hpp"
#include "emulator/procedure/polynomial_surrogate.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::VectorXd;

/// What tells where to look: the error that a polynomial should have, and may have, and what is
/// asked of the integrator for it.
constexpr double target_gu = 1e-3;
constexpr double coarse_gu = 5e-3;
constexpr double coarse_tolerance_gu = 1e-4;
constexpr std::size_t candidates = 9;
/// What makes no difference: well above the noise of the integrator.
constexpr double negligible_gu = 1e-5;

/// The values of each parameter: nominal first, and low and high where there is a tolerance.
using Levels = std::vector<std::vector<double>>;

Levels levels_of(const OpticalResponse& response, const GeometryLimits& limits) {
  Levels levels;
  for (Index i = 0; i < response.size(); ++i) {
    levels.push_back({response.nominal()(i)});
    const auto q = std::size_t(i);
    const Stated<Angle>* limit =
        q < response.quantities().size() ? limit_of(limits, response.quantities()[q]) : nullptr;
    if (limit != nullptr && limit->tolerance) {
      levels.back().push_back(std::max(limit->nominal - *limit->tolerance, Angle()).degrees());
      levels.back().push_back((limit->nominal + *limit->tolerance).degrees());
    }
  }
  return levels;
}

/// All combinations of levels, by rows; the nominal one first.
ArrayXXd combinations(const Levels& levels) {
  Index n = 1;
  for (const auto& of_parameter : levels) {
    n *= Index(of_parameter.size());
  }
  ArrayXXd setups(n, Index(levels.size()));
  Index repeated = 1;
  for (std::size_t p = 0; p < levels.size(); ++p) {
    const auto count = Index(levels[p].size());
    for (Index i = 0; i < n; ++i) {
      setups(i, Index(p)) = levels[p][std::size_t(i / repeated % count)];
    }
    repeated *= count;
  }
  return setups;
}

/// Readings of all samples by each set-up, to coarse_gu or better, shape (n_setups,
/// n_samples).
ArrayXXd coarse_readings(const OpticalResponse& response, const ArrayXXd& setups) {
  const OpticalResponse coarse = response.with_tolerance(coarse_tolerance_gu);
  const auto read = [&](const VectorXd& setup) { return coarse.with_standard_spectra(setup); };
  const VectorXd half_width = (setups.rowwise() - setups.row(0)).abs().colwise().maxCoeff();
  const auto surrogate = PolynomialSurrogate::fit(read, response.nominal(), half_width,
                                                  {.target_error = target_gu, .highest_degree = 3});
  ArrayXXd gloss_gu;
  if (surrogate.error().maxCoeff() <= coarse_gu) {
    surrogate.evaluate(setups, gloss_gu);
    return gloss_gu;
  }
  gloss_gu.resize(setups.rows(), surrogate.error().size());
  parallel_for(std::size_t(setups.rows()), [&](std::size_t i) {
    gloss_gu.row(Index(i)) = read(setups.row(Index(i)).transpose()).transpose().array();
  });
  return gloss_gu;
}

/// The candidates of the highest value, best first.
std::vector<Index> best_of(const ArrayXd& value) {
  std::vector<Index> rows(std::size_t(value.size()));
  std::iota(rows.begin(), rows.end(), Index{0});
  const std::size_t n = std::min(candidates, rows.size());
  std::ranges::partial_sort(rows, rows.begin() + std::ptrdiff_t(n), std::greater<>(),
                            [&](Index row) { return value(row); });
  rows.resize(n);
  return rows;
}

/// Of some set-ups, the one by which the optics read a sample worst, with nominal quantities where
/// that makes no difference.
/// @param response  of that sample alone.
/// @param sign      of the change that is looked for.
WorstCase worst_of(const OpticalResponse& response, const std::vector<VectorXd>& setups,
                   double sign) {
  const auto reading = [&](const VectorXd& setup) {
    return sign * response.with_standard_spectra(setup)(0);
  };
  const double nominal = reading(response.nominal());
  VectorXd worst = response.nominal();
  double highest = nominal;
  const auto accept_above = [&](double least, const VectorXd& setup) {
    const double found = reading(setup);
    if (found > least) {
      worst = setup;
      highest = found;
    }
  };
  for (const VectorXd& setup : setups) {
    accept_above(highest, setup);
  }
  const double least = highest - negligible_gu;
  for (Index p = 0; p < worst.size(); ++p) {
    VectorXd simpler = worst;
    simpler(p) = response.nominal()(p);
    if (simpler != worst) {
      accept_above(least, simpler);
    }
  }
  return {.change_gu = sign * (highest - nominal),
          .setup = {worst.begin(), worst.begin() + std::ptrdiff_t(response.quantities().size())}};
}

}  // namespace

WorstCases worst_cases(const OpticalResponse& response, const GeometryLimits& limits) {
  const ArrayXXd setups = combinations(levels_of(response, limits));
  const ArrayXXd gloss_gu = coarse_readings(response, setups);
  const auto n_samples = std::size_t(gloss_gu.cols());
  WorstCases result{.lowest = std::vector<WorstCase>(n_samples),
                    .highest = std::vector<WorstCase>(n_samples)};
  parallel_for(2 * n_samples, [&](std::size_t task) {
    const std::size_t sample = task / 2;
    const double sign = task % 2 == 0 ? -1.0 : 1.0;
    std::vector<VectorXd> best;
    for (const Index row : best_of(sign * gloss_gu.col(Index(sample)))) {
      best.emplace_back(setups.row(row).transpose());
    }
    (sign < 0.0 ? result.lowest : result.highest)[sample] =
        worst_of(response.of_sample(sample), best, sign);
  });
  return result;
}

}  // namespace gonio
