#include "emulator/procedure/optical_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "emulator/core/parallel_for.hpp"
#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double largest_opening_deg = 120.0;  // of an Aperture
constexpr double largest_angle_deg = 90.0;     // exclusive

bool is_direction(SetupQuantity quantity) {
  return quantity == SetupQuantity::theta_i || quantity == SetupQuantity::theta_r;
}

/// @throws std::domain_error  for a value that the quantity cannot have.
Angle angle_of(SetupQuantity quantity, double value_deg) {
  const bool fits = is_direction(quantity) ? std::abs(value_deg) < largest_angle_deg
                                           : std::abs(value_deg) <= largest_opening_deg;
  if (!fits) {
    throw std::domain_error(fmt::format(
        "OpticalResponse: {} must be {} deg, is {}", setup_quantity_names[std::size_t(quantity)],
        is_direction(quantity) ? "in (-90, 90)" : "up to 120", value_deg));
  }
  return degrees(is_direction(quantity) ? value_deg : std::abs(value_deg));
}

/// The source whose weight leans towards long wavelengths by s per 100 nm.
SpectralTable leaning(const SpectralTable& source, const WavelengthGrid& grid, double s) {
  const ArrayXd factor = 1.0 + s * (grid.nanometres() - 560.0) / 100.0;
  if (!(factor.minCoeff() > 0.0)) {
    throw std::domain_error(fmt::format(
        "OpticalResponse: spectral_mismatch must leave weight to all wavelengths, is {}", s));
  }
  return {grid.nanometres(), source.sample(grid) * factor, source.mark()};
}

Angle nominal_angle(const Instrument& instrument, const std::string& geometry_id,
                    SetupQuantity quantity) {
  const GeometryLimits& limits = instrument.standard.geometry(geometry_id);
  if (quantity == SetupQuantity::theta_r) {
    return limits.receptor_angle();
  }
  const Stated<Angle>* limit = limit_of(limits, quantity);
  return limit != nullptr ? limit->nominal : as_built(instrument, geometry_id, quantity)->value;
}

constexpr std::size_t halvings = 5;

/// A derivative from central differences with steps that are halved from one to the next. The error
/// of each order is taken from how it differs from its neighbours in the tableau of Neville.
double extrapolated(std::array<double, halvings> difference) {
  double best = difference.front();
  double smallest = std::numeric_limits<double>::infinity();
  double power = 1.0;
  for (std::size_t order = 1; order < halvings; ++order) {
    power *= 4.0;
    // From the last one on, so that those before still hold the lower order.
    for (std::size_t i = halvings - 1; i >= order; --i) {
      const double lower = difference[i];
      const double wider = difference[i - 1];
      difference[i] += (lower - wider) / (power - 1.0);
      const double error =
          std::max(std::abs(difference[i] - lower), std::abs(difference[i] - wider));
      if (error < smallest) {
        smallest = error;
        best = difference[i];
      }
    }
  }
  return best;
}

}  // namespace

OpticalResponse::OpticalResponse(Instrument instrument, std::string geometry_id,
                                 const std::vector<Sample>& samples, double tolerance)
    : instrument_(std::move(instrument)),
      with_standard_spectra_(instrument_),
      geometry_id_(std::move(geometry_id)),
      samples_(samples),
      tolerance_(tolerance) {
  if (samples_.empty() || !instrument_.has(geometry_id_)) {
    throw std::invalid_argument(
        fmt::format("OpticalResponse: samples and a geometry of {} are needed, are {} and '{}'",
                    instrument_.id, samples_.size(), geometry_id_));
  }
  (void)instrument_.geometry(geometry_id_);  // says what is unknown
  with_standard_spectra_.source = instrument_.standard.source;
  with_standard_spectra_.responsivity = instrument_.standard.responsivity;
  std::vector<double> built, nominal;
  for (std::size_t i = 0; i < setup_quantity_count; ++i) {
    if (const auto found = gonio::as_built(instrument_, geometry_id_, SetupQuantity(i))) {
      quantities_.push_back(SetupQuantity(i));
      built.push_back(found->value.degrees());
      nominal.push_back(nominal_angle(instrument_, geometry_id_, SetupQuantity(i)).degrees());
    }
  }
  const auto polarization = instrument_.polarization.find(geometry_id_);
  built.push_back(polarization == instrument_.polarization.end() ? 0.0 : polarization->second);
  built.push_back(0.0);
  nominal.insert(nominal.end(), {0.0, 0.0});
  as_built_ = Eigen::Map<VectorXd>(built.data(), Index(built.size()));
  nominal_ = Eigen::Map<VectorXd>(nominal.data(), Index(nominal.size()));
}

OpticalResponse OpticalResponse::of_sample(std::size_t i) const {
  OpticalResponse result = *this;
  result.samples_ = samples_.subspan(i, 1);
  return result;
}

OpticalResponse OpticalResponse::with_tolerance(double tolerance) const {
  OpticalResponse result = *this;
  result.tolerance_ = tolerance;
  return result;
}

Instrument OpticalResponse::with_parameters(const Instrument& instrument,
                                            const VectorXd& parameters) const {
  if (parameters.size() != size()) {
    throw std::domain_error(
        fmt::format("OpticalResponse: {} parameters expected, are {}", size(), parameters.size()));
  }
  Instrument result = instrument;
  const auto n = Index(quantities_.size());
  for (Index i = 0; i < n; ++i) {
    const SetupQuantity quantity = quantities_[std::size_t(i)];
    result = with_quantity(std::move(result), geometry_id_, quantity,
                           {.value = angle_of(quantity, parameters(i))});
  }
  result.polarization[geometry_id_] = parameters(n);
  if (parameters(n + 1) != 0.0) {
    result.source = leaning(result.source, samples_.front().surface.grid, parameters(n + 1));
  }
  return result;
}

VectorXd OpticalResponse::read(const Instrument& instrument) const {
  const Glossmeter meter(instrument, samples_.front().surface.grid,
                         std::make_shared<ApertureIntegrator>());
  VectorXd gloss_gu(Index(samples_.size()));
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    gloss_gu(Index(i)) =
        meter.read(samples_[i].surface, geometry_id_, tolerance_, samples_[i].tilt).gloss;
  }
  return gloss_gu;
}

VectorXd OpticalResponse::operator()(const VectorXd& parameters) const {
  return read(with_parameters(instrument_, parameters));
}

VectorXd OpticalResponse::with_standard_spectra(const VectorXd& parameters) const {
  return read(with_parameters(with_standard_spectra_, parameters));
}

/// The first step for a parameter: as wanted, but well above the noise, and within the range.
double OpticalResponse::step(Index parameter, double value, double wanted) const {
  constexpr double least_deg = 0.05;
  constexpr double least_relative = 0.01;  // of polarization and mismatch
  const auto n = Index(quantities_.size());
  if (parameter > n) {
    return std::max(wanted, least_relative);
  }
  const double range = parameter == n                                      ? 1.0
                       : is_direction(quantities_[std::size_t(parameter)]) ? largest_angle_deg
                                                                           : largest_opening_deg;
  if (!(std::abs(value) < range)) {
    throw std::domain_error(
        fmt::format("OpticalResponse::jacobian: parameter {} must be within +-{}, is {}", parameter,
                    range, value));
  }
  return std::min(std::max(wanted, parameter == n ? least_relative : least_deg),
                  0.5 * (range - std::abs(value)));
}

MatrixXd OpticalResponse::jacobian(const VectorXd& parameters, const VectorXd& steps) const {
  if (parameters.size() != size() || steps.size() != size() || !(steps.array() >= 0.0).all()) {
    throw std::domain_error(
        fmt::format("OpticalResponse::jacobian: {} parameters and steps >= 0 expected", size()));
  }
  std::vector<Index> varied;
  VectorXd first(size());
  for (Index i = 0; i < size(); ++i) {
    if (steps(i) > 0.0) {
      varied.push_back(i);
      first(i) = step(i, parameters(i), steps(i));
    }
  }
  std::vector<VectorXd> difference(varied.size() * halvings);  // by parameter and step
  parallel_for(difference.size(), [&](std::size_t k) {
    const Index parameter = varied[k / halvings];
    const double h = std::ldexp(first(parameter), -int(k % halvings));
    const VectorXd towards = h * VectorXd::Unit(size(), parameter);
    difference[k] = ((*this)(parameters + towards) - (*this)(parameters - towards)) / (2.0 * h);
  });
  MatrixXd derivative = MatrixXd::Zero(Index(samples_.size()), size());
  for (std::size_t v = 0; v < varied.size(); ++v) {
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      std::array<double, halvings> column{};
      for (std::size_t j = 0; j < halvings; ++j) {
        column[j] = difference[v * halvings + j](Index(s));
      }
      derivative(Index(s), varied[v]) = extrapolated(column);
    }
  }
  return derivative;
}

}  // namespace gonio
