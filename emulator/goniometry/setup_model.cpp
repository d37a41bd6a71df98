#include "emulator/goniometry/setup_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "emulator/core/parallel_for.hpp"
#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Asked of the integrator, relative to the light of the source: far below what is measured.
constexpr double tolerance = 1e-8;
constexpr double smallest_step_nm = 0.5;
constexpr double grazing_deg = 89.9;

/// What a set-up may be off: wide, so that data decide, but not so that all is possible.
constexpr double range_deg = 2.0;
constexpr double range_of_scale = 0.2;
constexpr double range_of_index = 0.1;
/// Of central differences, in ranges: narrow beside openings, far above the noise of the
/// integrator.
constexpr double step = 0.01;

/// Values between the points of a grid are linear.
ArrayXd interpolated(const WavelengthGrid& grid, const ArrayXd& value, const ArrayXd& at_nm) {
  const ArrayXd& x = grid.nanometres();
  if (x.size() == 1) {
    return ArrayXd::Constant(at_nm.size(), value(0));
  }
  const double width = (x(x.size() - 1) - x(0)) / double(x.size() - 1);
  ArrayXd result(at_nm.size());
  for (Index j = 0; j < at_nm.size(); ++j) {
    const double place = std::clamp((at_nm(j) - x(0)) / width, 0.0, double(x.size() - 1));
    const Index low = std::min(Index(place), x.size() - 2);
    const double t = place - double(low);
    result(j) = (1.0 - t) * value(low) + t * value(low + 1);
  }
  return result;
}

/// The geometries of a list that have a quantity, by what they are built with if it is an opening.
std::vector<std::vector<std::string>> shared_by(const Instrument& instrument,
                                                const std::vector<std::string>& geometries,
                                                SetupQuantity quantity) {
  std::vector<std::vector<std::string>> groups;
  const bool is_opening = quantity != SetupQuantity::theta_i && quantity != SetupQuantity::theta_r;
  bool is_one = is_opening;
  std::optional<Angle> first;
  std::vector<std::string> having;
  for (const std::string& geometry : geometries) {
    if (const auto built = as_built(instrument, geometry, quantity)) {
      first = first.value_or(built->value);
      is_one = is_one && built->value == *first;
      having.push_back(geometry);
    }
  }
  if (is_one && !having.empty()) {
    return {having};
  }
  for (const std::string& geometry : having) {
    groups.push_back({geometry});
  }
  return groups;
}

std::vector<SetupQuantity> quantities_of(const std::string& name) {
  using enum SetupQuantity;
  if (name == "source") {
    return {source_in_plane, source_perpendicular, source_diameter};
  }
  if (name == "receptor") {
    return {receptor_in_plane, receptor_perpendicular, receptor_diameter};
  }
  if (const auto quantity = setup_quantity(name)) {
    return {*quantity};
  }
  throw std::invalid_argument(fmt::format(
      "expected theta_i, theta_r, theta, source, receptor, scale or index as a parameter, "
      "of one geometry with :<id> behind it, found '{}'",
      name));
}

/// The name without its geometry, and the geometries that it is of.
std::pair<std::string, std::vector<std::string>> split(const std::string& name,
                                                       const std::vector<std::string>& geometries) {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) {
    return {name, geometries};
  }
  const std::string geometry = name.substr(colon + 1);
  if (std::ranges::find(geometries, geometry) == geometries.end()) {
    throw std::invalid_argument(fmt::format("'{}': expected one of the geometries {}, found '{}'",
                                            name, fmt::join(geometries, ", "), geometry));
  }
  return {name.substr(0, colon), {geometry}};
}

void append(std::vector<SetupParameter>& parameters, SetupParameter parameter) {
  const bool is_there = std::ranges::any_of(
      parameters, [&](const SetupParameter& other) { return other.name == parameter.name; });
  if (is_there) {
    throw std::invalid_argument(
        fmt::format("expected each parameter once, found '{}' twice", parameter.name));
  }
  parameters.push_back(std::move(parameter));
}

void append_thetas(std::vector<SetupParameter>& parameters, const Instrument& instrument,
                   const std::vector<std::string>& geometries) {
  for (const std::string& geometry : geometries) {
    append(parameters, {.kind = SetupParameter::Kind::theta,
                        .geometries = {geometry},
                        .name = "theta " + geometry,
                        .unit = "deg",
                        .assumed = instrument.angle_of_incidence(geometry).degrees(),
                        .range = range_deg});
  }
}

void append_quantities(std::vector<SetupParameter>& parameters, const Instrument& instrument,
                       const std::string& name, const std::vector<std::string>& geometries) {
  for (const SetupQuantity quantity : quantities_of(name)) {
    for (const auto& group : shared_by(instrument, geometries, quantity)) {
      const char* title = setup_quantity_names[std::size_t(quantity)];
      const bool is_of_all = group.size() == geometries.size() && geometries.size() > 1;
      append(parameters,
             {.quantity = quantity,
              .geometries = group,
              .name = is_of_all ? title : fmt::format("{} {}", title, fmt::join(group, "+")),
              .unit = "deg",
              .assumed = as_built(instrument, group.front(), quantity)->value.degrees(),
              .range = range_deg});
    }
  }
}

/// The instrument as it sees samples: of its polarization.
Surface as_seen(const Instrument& instrument, const std::string& geometry, const Surface& surface) {
  const auto found = instrument.polarization.find(geometry);
  return found == instrument.polarization.end() || found->second == 0.0
             ? surface
             : polarised(surface, found->second);
}

const Surface& perfect_mirror() {
  static const Surface mirror = smooth(WavelengthGrid(nanometres(555), nanometres(1), 1), 1.0);
  return mirror;
}

}  // namespace

WavelengthGrid calibration_grid(const std::vector<ReflectanceSpectrum>& spectra) {
  if (spectra.empty()) {
    throw std::invalid_argument("calibration_grid: expected a spectrum, found none");
  }
  double first = std::numeric_limits<double>::infinity();
  double last = 0.0;
  double gap = std::numeric_limits<double>::infinity();
  for (const ReflectanceSpectrum& spectrum : spectra) {
    const ArrayXd& x = spectrum.wavelength_nm;
    first = std::min(first, x(0));
    last = std::max(last, x(x.size() - 1));
    for (Index j = 1; j < x.size(); ++j) {
      gap = std::min(gap, x(j) - x(j - 1));
    }
  }
  if (last <= first) {
    return {nanometres(first), nanometres(1), 1};
  }
  const double steps = std::ceil((last - first) / std::max(gap, smallest_step_nm) - 1e-6);
  return {nanometres(first), nanometres((last - first) / steps), Index(steps) + 1};
}

std::vector<SetupParameter> setup_parameters(const Instrument& instrument,
                                             const std::vector<std::string>& geometries,
                                             const std::vector<std::string>& names) {
  std::vector<SetupParameter> parameters;
  for (const std::string& full_name : names) {
    const auto [name, of] = split(full_name, geometries);
    if (name == "scale") {
      append(parameters, {.kind = SetupParameter::Kind::scale,
                          .geometries = of,
                          .name = of.size() == geometries.size() ? name : "scale " + of.front(),
                          .assumed = 1.0,
                          .range = range_of_scale});
    } else if (name == "index") {
      append(parameters, {.kind = SetupParameter::Kind::index_offset,
                          .geometries = geometries,
                          .name = "index offset",
                          .range = range_of_index});
    } else if (name == "theta") {
      append_thetas(parameters, instrument, of);
    } else {
      append_quantities(parameters, instrument, name, of);
    }
  }
  return parameters;
}

SetupModel::SetupModel(Instrument instrument, std::vector<CalibrationSpectrum> spectra,
                       std::vector<SetupParameter> parameters, MirrorReference reference,
                       std::shared_ptr<const FluxIntegrator> integrator)
    : instrument_(std::move(instrument)),
      spectra_(std::move(spectra)),
      parameters_(std::move(parameters)),
      reference_(reference),
      integrator_(std::move(integrator)) {
  if (spectra_.empty()) {
    throw std::invalid_argument("SetupModel: expected a spectrum, found none");
  }
  for (const CalibrationSpectrum& one : spectra_) {
    if (!instrument_.has(one.spectrum.geometry)) {
      throw InputError(
          one.spectrum.mark,
          fmt::format("one of the geometries {}", fmt::join(instrument_.geometries, ", ")),
          one.spectrum.geometry);
    }
    samples_.push_back(one.sample.sample());
  }
}

VectorXd SetupModel::assumed() const {
  VectorXd x(Index(parameters_.size()));
  std::ranges::transform(parameters_, x.begin(), &SetupParameter::assumed);
  return x;
}

VectorXd SetupModel::range() const {
  VectorXd x(Index(parameters_.size()));
  std::ranges::transform(parameters_, x.begin(), &SetupParameter::range);
  return x;
}

Instrument with_parameter(Instrument instrument, const SetupParameter& parameter, double value,
                          Angle expanded_uncertainty) {
  for (const std::string& geometry : parameter.geometries) {
    const auto set = [&](SetupQuantity quantity, double value_deg) {
      instrument = with_quantity(
          std::move(instrument), geometry, quantity,
          {.value = degrees(value_deg), .expanded_uncertainty = expanded_uncertainty});
    };
    if (parameter.kind == SetupParameter::Kind::quantity) {
      set(parameter.quantity, value);
    } else if (parameter.kind == SetupParameter::Kind::theta) {
      const double theta_r =
          as_built(instrument, geometry, SetupQuantity::theta_r)->value.degrees();
      const double theta_i = instrument.angle_of_incidence(geometry).degrees();
      set(SetupQuantity::theta_i, value);
      set(SetupQuantity::theta_r, value + theta_r - theta_i);
    }
  }
  return instrument;
}

Instrument SetupModel::instrument(const VectorXd& x) const {
  Instrument result = instrument_;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    result = with_parameter(std::move(result), parameters_[i], x(Index(i)), {});
  }
  return result;
}

ArrayXd SetupModel::spectrum(std::size_t i, const Instrument& instrument,
                             double index_offset) const {
  const std::string& geometry_id = spectra_[i].spectrum.geometry;
  const Surface surface = as_seen(
      instrument, geometry_id,
      index_offset == 0.0 ? samples_[i].surface
                          : spectra_[i].sample.sample({.refractive_index = index_offset}).surface);
  const MeasuringGeometry lying = instrument.geometry(geometry_id);
  const double source = integrator_->incident(lying.source);
  const double mirror = reference_ == MirrorReference::source
                            ? source
                            : source * mirror_share(instrument, geometry_id);
  const Angle tilt = samples_[i].tilt;
  const MeasuringGeometry seen{.source = lying.source.seen_by_tilted(tilt),
                               .receptor = lying.receptor.seen_by_tilted(tilt)};
  const ArrayXd weight = ArrayXd::Constant(surface.grid.size(), 1.0 / double(surface.grid.size()));
  const Flux flux = integrator_->reflected(surface, seen, weight, tolerance * source);
  return interpolated(surface.grid, flux.spectral / mirror, spectra_[i].spectrum.wavelength_nm);
}

double SetupModel::mirror_share(const Instrument& instrument, const std::string& geometry) const {
  const MeasuringGeometry lying = instrument.geometry(geometry);
  const double source = integrator_->incident(lying.source);
  return integrator_->reflected(perfect_mirror(), lying, ArrayXd::Ones(1), tolerance * source)
             .spectral(0) /
         source;
}

VectorXd SetupModel::operator()(const VectorXd& x) const {
  Index n = 0;
  for (const CalibrationSpectrum& one : spectra_) {
    n += one.spectrum.wavelength_nm.size();
  }
  const VectorXd no_answer = VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  double index_offset = 0.0;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const SetupParameter& parameter = parameters_[i];
    const double value = x(Index(i));
    if (parameter.kind == SetupParameter::Kind::index_offset) {
      index_offset = value;
    } else if (parameter.unit == "deg" && !(std::abs(value) < grazing_deg)) {
      return no_answer;
    }
  }
  VectorXd all(n);
  Index begin = 0;
  try {
    const Instrument there = instrument(x);
    for (std::size_t i = 0; i < spectra_.size(); ++i) {
      ArrayXd one = spectrum(i, there, index_offset);
      for (std::size_t k = 0; k < parameters_.size(); ++k) {
        if (parameters_[k].kind == SetupParameter::Kind::scale &&
            std::ranges::find(parameters_[k].geometries, spectra_[i].spectrum.geometry) !=
                parameters_[k].geometries.end()) {
          one *= x(Index(k));
        }
      }
      all.segment(begin, one.size()) = one;
      begin += one.size();
    }
  } catch (const std::domain_error&) {  // an opening below 0, an angle or an index out of range
    return no_answer;
  }
  return all.allFinite() ? all : no_answer;
}

MatrixXd SetupModel::jacobian(const VectorXd& x) const {
  const VectorXd here = (*this)(x);
  MatrixXd derivatives = MatrixXd::Zero(here.size(), x.size());
  parallel_for(std::size_t(x.size()), [&](std::size_t k) {
    const auto i = Index(k);
    const double h = step * parameters_[k].range;
    double width = 0.0;
    for (const double side : {1.0, -1.0}) {
      const VectorXd there = (*this)(x + side * h * VectorXd::Unit(x.size(), i));
      if (there.allFinite()) {  // else by one side
        derivatives.col(i) += side * (there - here);
        width += h;
      }
    }
    derivatives.col(i) /= std::max(width, std::numeric_limits<double>::min());
  });
  return derivatives;
}

}  // namespace gonio
