#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "emulator/goniometry/fit_observations.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double radians_per_degree = std::numbers::pi / 180.0;

Vector3 direction_of(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The columns of some channels, and how much each counts.
using ChannelWeights = std::vector<std::pair<Index, double>>;

/// The luminance of what bands say: itself, Y, or that of linear sRGB (IEC 61966-2-1).
ChannelWeights luminance_of(const std::vector<BrdfChannel>& channels) {
  using Band = BrdfChannel::Band;
  const auto column = [&](Band band) -> std::optional<Index> {
    const auto found = std::ranges::find(channels, band, &BrdfChannel::band);
    return found == channels.end() ? std::nullopt : std::optional(Index(found - channels.begin()));
  };
  for (const Band band : {Band::luminance, Band::y}) {
    if (const auto found = column(band)) {
      return {{*found, 1.0}};
    }
  }
  const auto r = column(Band::red), g = column(Band::green), b = column(Band::blue);
  if (r && g && b) {
    return {{*r, 0.2126}, {*g, 0.7152}, {*b, 0.0722}};
  }
  throw std::invalid_argument(
      "a fit needs a BRDF at wavelengths, of luminance, of Y, or of red, green and blue");
}

/// Whether all channels are wavelengths that a grid can have.
std::optional<WavelengthGrid> grid_of(const std::vector<BrdfChannel>& channels) {
  if (channels.empty() || !std::ranges::all_of(channels, [](const BrdfChannel& channel) {
        return channel.wavelength.has_value();
      })) {
    return std::nullopt;
  }
  const double first = channels.front().wavelength->nanometres();
  const double step = channels.size() > 1 ? (channels.back().wavelength->nanometres() - first) /
                                                double(channels.size() - 1)
                                          : 1.0;
  constexpr double rounding_nm = 1e-6;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (std::abs(channels[i].wavelength->nanometres() - first - step * double(i)) > rounding_nm) {
      return std::nullopt;
    }
  }
  return WavelengthGrid(nanometres(first), nanometres(step), Index(channels.size()));
}

/// What is compared: f_r at directions, in a column for each wavelength of a grid.
struct Directions {
  std::vector<Vector3> omega_i, omega_r;
  Eigen::ArrayXXd f_r;
  WavelengthGrid grid = WavelengthGrid::visible();
};

Eigen::ArrayXXd compared_channels(const BrdfSamples& samples, WavelengthGrid& grid) {
  constexpr double luminance_nm = 555.0;  // where the eye is most sensitive
  if (const auto found = grid_of(samples.channels)) {
    grid = *found;
    return samples.f_r;
  }
  grid = WavelengthGrid(nanometres(luminance_nm), nanometres(1.0), 1);
  const bool are_wavelengths = samples.channels.front().wavelength.has_value();
  Eigen::ArrayXXd luminance = Eigen::ArrayXXd::Zero(samples.size(), 1);
  if (are_wavelengths) {  // not equally spaced: the one next to it
    const auto nearest =
        std::ranges::min_element(samples.channels, {}, [&](const BrdfChannel& channel) {
          return std::abs(channel.wavelength->nanometres() - luminance_nm);
        });
    grid = WavelengthGrid(*nearest->wavelength, nanometres(1.0), 1);
    luminance.col(0) = samples.f_r.col(nearest - samples.channels.begin());
    return luminance;
  }
  for (const auto& [column, weight] : luminance_of(samples.channels)) {
    luminance.col(0) += weight * samples.f_r.col(column);
  }
  return luminance;
}

/// The directions above the surface, sorted by incidence.
Directions directions_of(const BrdfSamples& samples) {
  Directions made;
  const Eigen::ArrayXXd f_r = compared_channels(samples, made.grid);
  std::vector<Index> order;
  for (Index i = 0; i < samples.size(); ++i) {
    constexpr double horizon = 1e-6;
    if (std::cos(samples.theta_i(i)) > horizon && std::cos(samples.theta_r(i)) > horizon &&
        f_r.row(i).isFinite().all()) {
      order.push_back(i);
    }
  }
  if (order.empty()) {
    throw std::invalid_argument("a fit needs a BRDF at directions above the surface");
  }
  std::ranges::stable_sort(order, {}, [&](Index i) { return samples.theta_i(i); });
  made.f_r.resize(Index(order.size()), f_r.cols());
  for (std::size_t i = 0; i < order.size(); ++i) {
    made.omega_i.push_back(direction_of(samples.theta_i(order[i]), samples.phi_i(order[i])));
    made.omega_r.push_back(direction_of(samples.theta_r(order[i]), samples.phi_r(order[i])));
    made.f_r.row(Index(i)) = f_r.row(order[i]);
  }
  return made;
}

double degrees_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / radians_per_degree;
}

/// A group for each polar angle of incidence, over the angle from the mirror direction.
std::vector<FitGroup> groups_of(const Directions& directions) {
  std::vector<FitGroup> groups;
  std::vector<double> abscissa;
  const Index columns = directions.f_r.cols();
  const auto close = [&] {
    if (!groups.empty()) {
      groups.back().abscissa = Eigen::Map<const ArrayXd>(abscissa.data(), Index(abscissa.size()));
      abscissa.clear();
    }
  };
  for (std::size_t i = 0; i < directions.omega_i.size(); ++i) {
    const Vector3& omega_i = directions.omega_i[i];
    const std::string id = fmt::format("{:.4g}", degrees_between(omega_i, Vector3::UnitZ()));
    if (groups.empty() || groups.back().id != id) {
      close();
      groups.push_back({.id = id, .first = Index(i) * columns});
    }
    abscissa.insert(abscissa.end(), std::size_t(columns),
                    degrees_between(mirrored(omega_i), directions.omega_r[i]));
  }
  close();
  return groups;
}

}  // namespace

FitObservations observations_of(const BrdfSamples& samples) {
  const auto directions = std::make_shared<const Directions>(directions_of(samples));
  const Index rows = directions->f_r.rows(), columns = directions->f_r.cols();
  FitObservations made{
      .quantity = "BRDF f_r / sr^-1",
      .abscissa = "angle from the mirror direction / deg",
      .weighting =
          "relative differences count by the root of cos theta_i cos theta_r; what is "
          "darker than a hundredth of the mean counts as if it were as bright",
      .grid = directions->grid,
      .groups = groups_of(*directions)};
  made.observed.resize(rows * columns);
  made.u.resize(rows * columns);
  constexpr double darkest = 0.01;  // of the mean
  const double floor = darkest * directions->f_r.abs().mean();
  if (!(floor > 0.0)) {
    throw std::invalid_argument("a fit needs a BRDF that is not 0 everywhere");
  }
  for (Index i = 0; i < rows; ++i) {
    const double cosines =
        directions->omega_i[std::size_t(i)].z() * directions->omega_r[std::size_t(i)].z();
    const ArrayXd f_r = directions->f_r.row(i);
    made.observed.segment(i * columns, columns) = f_r;
    made.u.segment(i * columns, columns) = f_r.abs().max(floor) / std::sqrt(cosines);
  }
  made.respond = [directions, columns](const Surface& surface) {
    VectorXd response(directions->f_r.size());
    for (std::size_t i = 0; i < directions->omega_i.size(); ++i) {
      response.segment(Index(i) * columns, columns) =
          surface.brdf(directions->omega_i[i], directions->omega_r[i]);
    }
    return response;
  };
  return made;
}

BrdfSamples sampled_for_fit(const MeasuredBrdf& brdf) {
  constexpr std::array incidences{5.0, 20.0, 35.0, 50.0, 65.0, 75.0};
  constexpr std::array halves{0.0, 0.5,  1.0,  1.5,  2.0,  3.0,  4.0,  5.0,
                              7.0, 10.0, 14.0, 20.0, 28.0, 36.0, 45.0, 60.0};
  constexpr int azimuths = 8;
  const double largest = brdf.largest_theta().radians();
  std::vector<std::array<double, 4>> places;
  BrdfSamples samples{.channels = brdf.channels()};
  const auto channels = Index(samples.channels.size());
  std::vector<ArrayXd> values;
  for (const double incidence : incidences) {
    const double theta_i = incidence * radians_per_degree;
    const Vector3 omega_i = direction_of(theta_i, std::numbers::pi);
    for (const double half : halves) {
      for (int a = 0; a < (half > 0.0 ? azimuths : 1); ++a) {
        const Vector3 h =
            direction_of(half * radians_per_degree, 2.0 * std::numbers::pi * a / azimuths);
        const Vector3 omega_r = 2.0 * h.dot(omega_i) * h - omega_i;
        const double theta_r = std::atan2(std::hypot(omega_r.x(), omega_r.y()), omega_r.z());
        if (theta_i > largest || theta_r > largest || !(omega_r.z() > 0.0)) {
          continue;
        }
        DirectionBatch one;
        one.x = ArrayXd::Constant(1, omega_r.x());
        one.y = ArrayXd::Constant(1, omega_r.y());
        one.z = ArrayXd::Constant(1, omega_r.z());
        Eigen::ArrayXXd f_r(1, channels);
        brdf.evaluate(omega_i, one, f_r);
        values.emplace_back(f_r.row(0).transpose());
        places.push_back(
            {theta_i, std::numbers::pi, theta_r, std::atan2(omega_r.y(), omega_r.x())});
      }
    }
  }
  const auto n = Index(places.size());
  for (ArrayXd* angle : {&samples.theta_i, &samples.phi_i, &samples.theta_r, &samples.phi_r}) {
    angle->resize(n);
  }
  samples.f_r.resize(n, channels);
  for (Index i = 0; i < n; ++i) {
    const auto& place = places[std::size_t(i)];
    samples.theta_i(i) = place[0];
    samples.phi_i(i) = place[1];
    samples.theta_r(i) = place[2];
    samples.phi_r(i) = place[3];
    samples.f_r.row(i) = values[std::size_t(i)].transpose();
  }
  return samples;
}

}  // namespace gonio
