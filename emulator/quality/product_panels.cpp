#include "emulator/quality/product_panels.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "emulator/statistics/sampling_plan.hpp"
#include "emulator/uncertainty/random.hpp"

namespace gonio {

namespace {

using Eigen::Index;

constexpr std::size_t n_parameters = sample_parameter_count;

/// Draws of one seed for different purposes.
enum Stream : std::uint64_t { of_lots = 1, of_panels, of_gauge_panels, of_errors, of_gauge_errors };

std::vector<double> normal_draws(std::uint64_t seed, std::uint64_t trial, std::uint64_t stream,
                                 std::size_t n) {
  std::vector<double> draws(n);
  Draws(seed, trial, stream).normal(draws);
  return draws;
}

/// The deviation that a distribution has where the standard normal one has z.
double deviation_at(const Distribution& distribution, double z) {
  if (distribution.shape == Distribution::Shape::normal) {
    return distribution.standard_uncertainty * z;
  }
  return quantile(distribution, 0.5 * std::erfc(-z / std::numbers::sqrt2));
}

Eigen::Matrix3d mixing_of(const std::vector<ProductCorrelation>& correlations) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Identity();
  for (const ProductCorrelation& one : correlations) {
    correlation(Index(one.a), Index(one.b)) = one.coefficient;
    correlation(Index(one.b), Index(one.a)) = one.coefficient;
  }
  return correlation.llt().matrixL();
}

Eigen::Vector3d vector_of(const SampleDeviation& deviation) {
  return {deviation.roughness, deviation.refractive_index, deviation.diffuse_reflectance};
}

/// The value that a function of normal parameters has on average, to second order.
/// @param root  of their covariance, R of R R^T.
template <class Function>
auto average(const Function& function, const Eigen::Vector3d& centre, const Eigen::Matrix3d& root) {
  auto result = function(centre);
  const auto at_centre = result;
  for (Index j = 0; j < root.cols(); ++j) {
    if (!root.col(j).isZero()) {
      const auto up = function(centre + root.col(j));
      const auto down = function(centre - root.col(j));
      for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] += 0.5 * (up[i] + down[i]) - at_centre[i];
      }
    }
  }
  return result;
}

/// Its standard deviation, to first order.
template <class Function>
std::vector<double> spread(const Function& function, const Eigen::Vector3d& centre,
                           const Eigen::Matrix3d& root) {
  std::vector<double> variance(function(centre).size(), 0.0);
  for (Index j = 0; j < root.cols(); ++j) {
    if (!root.col(j).isZero()) {
      const auto up = function(centre + root.col(j));
      const auto down = function(centre - root.col(j));
      for (std::size_t i = 0; i < variance.size(); ++i) {
        variance[i] += 0.25 * (up[i] - down[i]) * (up[i] - down[i]);
      }
    }
  }
  for (double& v : variance) {
    v = std::sqrt(v);
  }
  return variance;
}

}  // namespace

ProductPanels::ProductPanels(const Batch& batch, const ProductOptics& optics,
                             const ReadingUncertainties& uncertainties)
    : batch_(batch),
      optics_(optics),
      uncertainties_(uncertainties),
      judge_(batch, uncertainties),
      positions_(batch.plan.positions.size() + batch.plan.further_positions.size()),
      mixing_(mixing_of(batch.product.value().correlations)),
      whole_(shares_of_panel(optics.family())) {
  Eigen::Vector3d within, panels;
  for (std::size_t p = 0; p < n_parameters; ++p) {
    within[Index(p)] = batch.product->spread[p].within_panel;
    panels[Index(p)] = batch.product->spread[p].panels.standard_uncertainty;
  }
  within_ = within.asDiagonal() * mixing_;
  panels_ = panels.asDiagonal() * mixing_;
  for (std::uint32_t c = 0; c < batch.channels.size(); ++c) {
    if (batch.channels[c].kind != BatchChannel::Kind::haze) {
      read_channels_.push_back(c);
    }
  }
  for (std::size_t i = 0; i < batch.instruments.size(); ++i) {
    places_.push_back(reading_places(batch, batch.instruments[i], read_channels_, optics.family()));
  }
}

ProductPanels::Parameters ProductPanels::deviation(std::span<const double> normal,
                                                   Distribution ParameterSpread::*level) const {
  const Parameters z = mixing_ * Eigen::Map<const Parameters>(normal.data());
  Parameters result;
  for (std::size_t p = 0; p < n_parameters; ++p) {
    result[Index(p)] = deviation_at(batch_.product->spread[p].*level, z[Index(p)]);
  }
  return result;
}

ProductPanels::Parameters ProductPanels::of_lot(std::uint64_t lot) const {
  return Eigen::Map<const Parameters>(batch_.product->offset.data()) +
         deviation(normal_draws(batch_.seed, lot, of_lots, n_parameters), &ParameterSpread::lots);
}

/// How the film deviates at each place of a panel. @param normal  by parameter and place.
Eigen::Matrix3Xd ProductPanels::film(std::span<const double> normal,
                                     const ReadingPlaces& places) const {
  const Eigen::Map<const Eigen::Matrix3Xd> z(normal.data(), 3, places.film.cols());
  return within_ * z * places.film.transpose();
}

/// What an instrument errs by as long as its calibration holds: for a lot.
std::vector<double> ProductPanels::errors(std::uint64_t lot, std::size_t instrument,
                                          std::uint64_t stream) const {
  const std::size_t n = batch_.channels.size();
  std::vector<double> error =
      normal_draws(batch_.seed, lot * batch_.instruments.size() + instrument, stream, n);
  for (std::size_t c = 0; c < n; ++c) {
    error[c] *= uncertainties_[instrument * n + c].systematic;
  }
  return error;
}

/// @param noise  of a standard normal distribution.
double ProductPanels::read(const Panel& panel, std::size_t place, double noise) const {
  const std::uint32_t channel = read_channels_[place % read_channels_.size()];
  ProductOptics::Seen seen{};
  for (const SpotShare& share : places_[panel.instrument].shares[place]) {
    const Parameters here = panel.deviation.col(Index(place)) + vector_of(share.deviation);
    const auto part = optics_.see(panel.instrument, channel, share.region, here);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      seen[i] += share.weight * part[i];
    }
  }
  const double shown = optics_.show(panel.instrument, channel, seen);
  if (batch_.channels[channel].kind != BatchChannel::Kind::gloss) {
    return shown;
  }
  const Behaviour& behaviour = batch_.instruments[panel.instrument].behaviour;
  const OperatorStatement& person = batch_.operators[panel.person];
  const double scatter = std::hypot(behaviour.repeatability_gu, person.repeatability_gu);
  const double value = shown + panel.error[channel] + person.bias_gu + scatter * noise;
  return displayed(value, behaviour.resolution_gu);
}

/// Positions first to end - 1, from 0.
void ProductPanels::read_positions(const Panel& panel, std::size_t first, std::size_t end,
                                   std::vector<ReadingRecord>& readings) const {
  const std::size_t n = read_channels_.size();
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t position = first; position < end; ++position) {
      const std::size_t place = position * n + c;
      for (std::uint32_t r = 0; r < batch_.plan.repetitions; ++r) {
        readings.push_back(
            {.channel = read_channels_[c],
             .position = std::uint32_t(position + 1),
             .repetition = r + 1,
             .instrument = std::uint32_t(panel.instrument),
             .operator_ = std::uint32_t(panel.person),
             .value = read(panel, place, panel.noise[place * batch_.plan.repetitions + r])});
      }
    }
  }
}

double ProductPanels::true_value(std::uint32_t channel, const Parameters& deviation) const {
  const std::size_t ideal = optics_.ideal();
  ProductOptics::Seen seen{};
  for (const SpotShare& share : whole_) {
    const auto part =
        average([&](const Parameters& x) { return optics_.see(ideal, channel, share.region, x); },
                deviation + vector_of(share.deviation), within_);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      seen[i] += share.weight * part[i];
    }
  }
  return optics_.show(ideal, channel, seen);
}

/// By channel: of a panel that deviates as a whole, the average over all of it.
std::vector<double> ProductPanels::true_values(const Parameters& deviation) const {
  std::vector<double> values(batch_.channels.size(), std::nan(""));
  for (const std::uint32_t channel : read_channels_) {
    values[channel] = true_value(channel, deviation);
  }
  for (std::uint32_t c = 0; c < values.size(); ++c) {
    if (batch_.channels[c].kind == BatchChannel::Kind::haze) {
      values[c] = haze_of(batch_, c, values);
    }
  }
  return values;
}

void ProductPanels::tell_truth(PanelRecord& panel, const Parameters& deviation) const {
  const std::vector<double> truth = true_values(deviation);
  for (ChannelResult& result : panel.channels) {
    if (std::isfinite(truth[result.channel])) {
      result.truth = truth[result.channel];
    }
  }
}

PanelRecord ProductPanels::inspect(std::uint64_t number) const {
  PanelRecord record{.number = number, .lot = (number - 1) / batch_.plan.panels + 1};
  const std::size_t appraiser = (number - 1) % batch_.appraisers();
  Panel panel{.instrument = appraiser / batch_.operators.size(),
              .person = appraiser % batch_.operators.size()};
  const ReadingPlaces& places = places_[panel.instrument];
  const std::size_t n_places = places.shares.size();
  const std::size_t n_film = n_parameters * n_places;
  const std::vector<double> draws = normal_draws(
      batch_.seed, number, of_panels, n_parameters + n_film + n_places * batch_.plan.repetitions);
  const std::span<const double> normal(draws);
  const Parameters whole =
      of_lot(record.lot) + deviation(normal.first(n_parameters), &ParameterSpread::panels);
  panel.deviation = film(normal.subspan(n_parameters, n_film), places).colwise() + whole;
  panel.noise = normal.subspan(n_parameters + n_film);
  panel.error = errors(record.lot, panel.instrument, of_errors);

  std::size_t position = batch_.plan.positions.size();
  read_positions(panel, 0, position, record.readings);
  for (std::size_t further = judge_.judge(record); further > 0 && position < positions_;
       further = judge_.judge(record)) {
    const std::size_t more =
        (further + batch_.plan.repetitions - 1) / batch_.plan.repetitions;  // positions
    const std::size_t end = std::min(positions_, position + more);
    read_positions(panel, position, end, record.readings);
    position = end;
  }
  tell_truth(record, whole);
  return record;
}

PanelRecord ProductPanels::gauge(std::uint64_t number) const {
  PanelRecord record{.study = PanelRecord::Study::gauge, .number = number};
  const std::uint32_t repetitions = batch_.gauge.value().repetitions;
  const std::size_t n_read = read_channels_.size();
  const std::vector<double> draws =
      normal_draws(batch_.seed, number, of_gauge_panels,
                   2 * n_parameters + batch_.appraisers() * n_read * repetitions);
  const std::span<const double> normal(draws);
  const Parameters whole = Eigen::Map<const Parameters>(batch_.product->offset.data()) +
                           deviation(normal.first(n_parameters), &ParameterSpread::lots) +
                           deviation(normal.subspan(n_parameters), &ParameterSpread::panels);
  std::span<const double> noise = normal.subspan(2 * n_parameters);
  for (std::size_t appraiser = 0; appraiser < batch_.appraisers(); ++appraiser) {
    Panel panel{.instrument = appraiser / batch_.operators.size(),
                .person = appraiser % batch_.operators.size()};
    panel.deviation = whole.replicate(1, Index(n_read));
    panel.error = errors(0, panel.instrument, of_gauge_errors);
    for (std::size_t c = 0; c < n_read; ++c) {
      for (std::uint32_t r = 0; r < repetitions; ++r) {
        record.readings.push_back({.channel = read_channels_[c],
                                   .repetition = r + 1,
                                   .instrument = std::uint32_t(panel.instrument),
                                   .operator_ = std::uint32_t(panel.person),
                                   .value = read(panel, c, noise.front())});
        noise = noise.subspan(1);
      }
    }
  }
  return record;
}

/// The panels of a lot are taken for normal.
LotTruth ProductPanels::truth(std::uint64_t lot) const {
  const auto of_panel = [&](const Parameters& deviation) { return true_values(deviation); };
  const Parameters centre = of_lot(lot);
  LotTruth truth{.mean = average(of_panel, centre, panels_),
                 .sd = spread(of_panel, centre, panels_),
                 .beyond = std::vector<double>(batch_.channels.size(), 0.0)};
  for (const Requirement& requirement : batch_.requirements) {
    const std::uint32_t c = requirement.channel;
    if (std::isfinite(truth.mean[c])) {
      truth.beyond[c] = 1.0 - within_limits(truth.mean[c], truth.sd[c], requirement.limits);
    }
  }
  return truth;
}

}  // namespace gonio
