#include "emulator/goniometry/setup_calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double level = 0.95;
/// A first guess of u where none is stated, relative to the spectra.
constexpr double guessed_u = 0.01;
/// u from the residuals is found when it changes by less than this.
constexpr double same_u = 0.01;
constexpr int most_rounds = 10;
/// How far from an estimate others are looked for, in ranges.
constexpr std::array<double, 4> other_starts{-0.5, -0.2, 0.2, 0.5};
/// By what others differ in one parameter at least, in ranges, and how many are told.
constexpr double apart = 0.1;
constexpr std::size_t most_others = 3;
/// Less of chi squared is the end of a search, not a better set-up.
constexpr double better = 0.1;

struct Observed {
  VectorXd value, u;
  bool is_weighted = true;
};

Observed observed(const std::vector<CalibrationSpectrum>& spectra) {
  Observed all;
  Index n = 0;
  for (const CalibrationSpectrum& one : spectra) {
    n += one.spectrum.reflectance.size();
    all.is_weighted = all.is_weighted && one.spectrum.u.size() > 0;
  }
  all.value.resize(n);
  all.u.resize(n);
  Index begin = 0;
  for (const CalibrationSpectrum& one : spectra) {
    const Index size = one.spectrum.reflectance.size();
    all.value.segment(begin, size) = one.spectrum.reflectance;
    if (all.is_weighted) {
      all.u.segment(begin, size) = one.spectrum.u;
    }
    begin += size;
  }
  return all;
}

PriorFit fit_of(const SetupModel& model, const VectorXd& start, const Observed& observed) {
  return fit_with_prior(
      {.model = [&](const VectorXd& x) -> VectorXd { return model(x); },
       .jacobian = [&](const VectorXd& x) -> MatrixXd { return model.jacobian(x); },
       .observed = observed.value,
       .u_observed = observed.u,
       .assumed = start,
       .u_assumed = model.range(),
       .jacobian_assumed = model.jacobian(start)});
}

/// Fits with what the residuals of the fit before say of u, until they say the same again.
PriorFit fit_without_u(const SetupModel& model, const VectorXd& start, Observed& observed) {
  const double freedom = double(observed.value.size() - start.size());
  const double least = std::numeric_limits<double>::epsilon() *
                       std::max(root_mean_square(observed.value.array()), 1e-3);
  observed.u.setConstant(std::max(guessed_u * root_mean_square(observed.value.array()), least));
  PriorFit fit = fit_of(model, start, observed);
  for (int round = 0; round < most_rounds; ++round) {
    const double u = std::max(fit.residual.norm() / std::sqrt(freedom), 1e3 * least);
    const bool is_found = std::abs(u / observed.u(0) - 1.0) < same_u;
    observed.u.setConstant(u);
    if (is_found) {
      break;
    }
    fit = fit_of(model, fit.estimate, observed);
  }
  return fit;
}

/// (J^T W J)^-1 with the ranges as a prior, by the derivatives at the estimate.
MatrixXd covariance_at(const MatrixXd& jacobian, const Observed& observed, const VectorXd& range) {
  const Index p = range.size();
  const MatrixXd whitened = observed.u.cwiseInverse().asDiagonal() * jacobian * range.asDiagonal();
  const MatrixXd information = whitened.transpose() * whitened + MatrixXd::Identity(p, p);
  return range.asDiagonal() * information.llt().solve(MatrixXd::Identity(p, p)) *
         range.asDiagonal();
}

double region_quantile(std::size_t p, std::size_t freedom, bool is_weighted) {
  using boost::math::quantile;
  return is_weighted
             ? quantile(boost::math::chi_squared(double(p)), level)
             : double(p) * quantile(boost::math::fisher_f(double(p), double(freedom)), level);
}

double interval_factor(std::size_t freedom, bool is_weighted) {
  const double one_side = 0.5 * (1.0 + level);
  return is_weighted ? boost::math::quantile(boost::math::normal(), one_side)
                     : boost::math::quantile(boost::math::students_t(double(freedom)), one_side);
}

double chi_squared_at(const SetupModel& model, const VectorXd& x, const Observed& observed) {
  return (model(x) - observed.value).cwiseQuotient(observed.u).squaredNorm();
}

std::vector<RegionAxis> region_axes(const SetupModel& model, const SetupCalibration& found,
                                    const VectorXd& estimate, const Observed& observed) {
  const VectorXd range = model.range();
  const VectorXd per_range = range.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(
      MatrixXd(per_range.asDiagonal() * found.covariance * per_range.asDiagonal()));
  std::vector<RegionAxis> axes;
  for (Index i = range.size(); i-- > 0;) {
    const double length = std::sqrt(found.region_quantile * solver.eigenvalues()(i));
    const VectorXd half = length * range.cwiseProduct(solver.eigenvectors().col(i));
    // What the ranges hold of the region is not the spectra's.
    const double prior = half.cwiseQuotient(range).squaredNorm();
    const double expected = found.region_quantile - prior;
    const auto growth = [&](double side) {
      return (chi_squared_at(model, estimate + side * half, observed) - found.chi_squared) /
             expected;
    };
    RegionAxis axis{.direction = {half.begin(), half.end()}};
    const bool is_of_spectra = expected > 0.5 * found.region_quantile;
    axis.growth_low = is_of_spectra ? growth(-1.0) : std::numeric_limits<double>::quiet_NaN();
    axis.growth_high = is_of_spectra ? growth(1.0) : std::numeric_limits<double>::quiet_NaN();
    axes.push_back(std::move(axis));
  }
  return axes;
}

std::vector<CalibratedSpectrum> spectra_of(const SetupModel& model, const VectorXd& at_start,
                                           const VectorXd& simulated,
                                           const Instrument& instrument) {
  std::vector<CalibratedSpectrum> spectra;
  Index begin = 0;
  for (const CalibrationSpectrum& one : model.spectra()) {
    const ArrayXd& measured = one.spectrum.reflectance;
    CalibratedSpectrum result{.sample = one.sample.sample().id,
                              .measured = one.spectrum,
                              .at_start = at_start.segment(begin, measured.size()),
                              .simulated = simulated.segment(begin, measured.size())};
    result.rmse_at_start = root_mean_square(result.at_start - measured);
    result.rmse = root_mean_square(result.simulated - measured);
    result.relative_rmse = result.rmse / root_mean_square(measured);
    result.mirror_share = model.mirror_share(instrument, one.spectrum.geometry);
    spectra.push_back(std::move(result));
    begin += measured.size();
  }
  return spectra;
}

/// The instrument with the estimates, each as well known as the fit says.
Instrument calibrated(const SetupModel& model, const SetupCalibration& found) {
  Instrument instrument = model.instrument();
  for (const CalibratedParameter& one : found.parameters) {
    const bool is_size = one.parameter.kind == SetupParameter::Kind::quantity &&
                         one.parameter.quantity != SetupQuantity::theta_r;
    instrument =
        with_parameter(std::move(instrument), one.parameter,
                       is_size ? std::abs(one.estimate) : one.estimate, degrees(2.0 * one.u));
  }
  return instrument;
}

void expect_enough(const SetupModel& model, const Observed& observed) {
  const std::size_t p = model.parameters().size();
  if (p == 0 || observed.value.size() <= Index(p)) {
    throw std::invalid_argument(
        fmt::format("calibrate_setup: expected a parameter and more values than parameters, found "
                    "{} parameters and {} values",
                    p, observed.value.size()));
  }
}

}  // namespace

double root_mean_square(const ArrayXd& values) {
  return values.size() == 0 ? 0.0 : std::sqrt(values.square().mean());
}

double SetupCalibration::distance(const VectorXd& x) const {
  VectorXd away(x.size());
  for (Index i = 0; i < x.size(); ++i) {
    away(i) = x(i) - parameters[std::size_t(i)].estimate;
  }
  return away.dot(covariance.ldlt().solve(away));
}

SetupCalibration calibrate_setup(const SetupModel& model, const VectorXd& start) {
  Observed data = observed(model.spectra());
  expect_enough(model, data);
  const VectorXd at_start = model(start);
  if (!at_start.allFinite()) {
    throw InputError(model.spectra().front().spectrum.mark,
                     "a set-up to begin with that can be simulated", "none");
  }
  const PriorFit fit =
      data.is_weighted ? fit_of(model, start, data) : fit_without_u(model, start, data);
  const VectorXd simulated = model(fit.estimate);
  const MatrixXd jacobian = model.jacobian(fit.estimate);
  const std::size_t p = model.parameters().size();
  const VectorXd range = model.range();
  SetupCalibration found{.instrument = model.instrument(),
                         .degrees_of_freedom = std::size_t(data.value.size()) - p,
                         .is_weighted = data.is_weighted,
                         .has_converged = fit.has_converged};
  found.covariance = covariance_at(jacobian, data, range);
  found.region_quantile = region_quantile(p, found.degrees_of_freedom, data.is_weighted);
  found.confusions = confusions_of(found.covariance, range);
  found.chi_squared = (simulated - data.value).cwiseQuotient(data.u).squaredNorm();
  found.p_value = boost::math::cdf(boost::math::complement(
      boost::math::chi_squared(double(found.degrees_of_freedom)), found.chi_squared));
  found.rmse_at_start = root_mean_square((at_start - data.value).array());
  found.rmse = root_mean_square((simulated - data.value).array());
  found.u_of_residuals =
      (simulated - data.value).norm() / std::sqrt(double(found.degrees_of_freedom));
  const double k = interval_factor(found.degrees_of_freedom, data.is_weighted);
  for (std::size_t i = 0; i < p; ++i) {
    const auto j = Index(i);
    const double u = std::sqrt(found.covariance(j, j));
    found.parameters.push_back({.parameter = model.parameters()[i],
                                .start = start(j),
                                .estimate = fit.estimate(j),
                                .u = u,
                                .low = fit.estimate(j) - k * u,
                                .high = fit.estimate(j) + k * u,
                                .effect = jacobian.col(j).cwiseQuotient(data.u).norm() * range(j),
                                .is_determined = u <= 0.5 * range(j)});
  }
  found.axes = region_axes(model, found, fit.estimate, data);
  found.instrument = calibrated(model, found);
  found.spectra = spectra_of(model, at_start, simulated, found.instrument);
  return found;
}

std::vector<OtherSetup> other_setups(const SetupModel& model, const SetupCalibration& found) {
  Observed data = observed(model.spectra());
  if (!found.is_weighted) {
    data.u.setConstant(found.u_of_residuals);
  }
  VectorXd estimate(model.range().size());
  std::ranges::transform(found.parameters, estimate.begin(), &CalibratedParameter::estimate);
  std::vector<OtherSetup> ends(other_starts.size() * found.parameters.size());
  parallel_for(ends.size(), [&](std::size_t k) {
    const auto i = Index(k / other_starts.size());
    VectorXd start = estimate;
    start(i) += other_starts[k % other_starts.size()] * model.range()(i);
    ends[k].chi_squared = std::numeric_limits<double>::infinity();
    if (found.parameters[std::size_t(i)].is_determined && model(start).allFinite()) {
      ends[k].estimate = fit_of(model, start, data).estimate;
      ends[k].chi_squared = chi_squared_at(model, ends[k].estimate, data);
    }
  });
  std::ranges::stable_sort(ends, {}, &OtherSetup::chi_squared);
  std::vector<OtherSetup> others;
  for (const OtherSetup& end : ends) {
    const bool is_as_good = end.chi_squared <= found.chi_squared + found.region_quantile;
    const auto is_apart = [&](const VectorXd& from) {
      const VectorXd away = end.estimate - from;
      return away.dot(found.covariance.ldlt().solve(away)) > found.region_quantile &&
             away.cwiseQuotient(model.range()).cwiseAbs().maxCoeff() > apart;
    };
    if (is_as_good && others.size() < most_others && is_apart(estimate) &&
        std::ranges::all_of(others, is_apart, &OtherSetup::estimate)) {
      others.push_back(end);
    }
  }
  return others;
}

SearchedSetup search_setup(const SetupModel& model, const std::vector<VectorXd>& starts) {
  SetupCalibration best = calibrate_setup(model, starts.at(0));
  const auto try_from = [&](const VectorXd& start) {
    SetupCalibration found = calibrate_setup(model, start);
    const bool is_better = found.is_weighted ? found.chi_squared + better < best.chi_squared
                                             : found.rmse < best.rmse * (1.0 - 1e-3);
    if (is_better) {
      best = std::move(found);
    }
    return is_better;
  };
  for (std::size_t i = 1; i < starts.size(); ++i) {
    (void)try_from(starts[i]);
  }
  std::vector<OtherSetup> others = other_setups(model, best);
  for (int round = 0;
       round < most_rounds && !others.empty() &&
       others.front().chi_squared + better < best.chi_squared && try_from(others.front().estimate);
       ++round) {
    others = other_setups(model, best);
  }
  return {.best = std::move(best), .others = std::move(others)};
}

}  // namespace gonio
