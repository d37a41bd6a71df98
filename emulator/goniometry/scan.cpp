#include "emulator/goniometry/scan.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/integration/patch_integrator.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// Below it a BRDF counts as this much when its tolerance is asked for [1/sr]: what is a thousandth
/// of white paper is known to the same absolute accuracy.
constexpr double least_f_r = 1e-3;

using Place = std::array<std::int64_t, 4>;

std::int64_t microdegrees(double angle_deg) { return std::llround(1e6 * angle_deg); }

/// Where a position is, told apart from others as far as the sample can tell them apart.
Place place_of(const ScanPosition& position, bool is_isotropic) {
  const double i_deg = position.azimuth_i().degrees();
  const double r_deg = position.azimuth_r().degrees();
  const std::int64_t theta_i = microdegrees(position.theta_i.degrees());
  const std::int64_t theta_r = std::abs(microdegrees(position.theta_r.degrees()));
  if (!is_isotropic) {
    return {theta_i, theta_r, microdegrees(i_deg), microdegrees(r_deg)};
  }
  const double between = std::abs(i_deg - r_deg);
  return {theta_i, theta_r, microdegrees(std::min(between, 360.0 - between)), 0};
}

/// What is done at each position, and at which other one where nothing is.
struct Duties {
  std::vector<PositionState> state;
  std::vector<std::size_t> told_by;  // itself, unless reciprocal
  std::vector<std::size_t> to_measure = {};
};

Duties duties_of(const std::vector<ScanPosition>& positions, Angle heads_apart, bool is_reciprocal,
                 bool is_isotropic) {
  Duties duties{.state = std::vector(positions.size(), PositionState::measured),
                .told_by = std::vector<std::size_t>(positions.size())};
  std::map<Place, std::size_t> places;
  constexpr double hair_deg = 1e-9;  // heads that touch are apart
  for (std::size_t p = 0; p < positions.size(); ++p) {
    duties.told_by[p] = p;
    if (positions[p].between_heads().degrees() < heads_apart.degrees() - hair_deg) {
      duties.state[p] = PositionState::blocked;
    } else if (is_reciprocal) {
      places.emplace(place_of(positions[p], is_isotropic), p);
    }
  }
  for (std::size_t p = 0; p < positions.size(); ++p) {
    if (is_reciprocal && duties.state[p] == PositionState::measured) {
      const Place other = place_of(exchanged(positions[p]), is_isotropic);
      const auto found = places.find(other);
      if (found != places.end() && place_of(positions[p], is_isotropic) < other) {
        duties.state[p] = PositionState::reciprocal;
        duties.told_by[p] = found->second;
      }
    }
    if (duties.state[p] == PositionState::measured) {
      duties.to_measure.push_back(p);
    }
  }
  return duties;
}

/// The projected solid angles of apertures, each computed once: at the horizon they take time.
class ProjectedAngles {
 public:
  /// Only patches see an azimuth.
  ProjectedAngles(const FluxIntegrator& integrator, bool with_azimuth)
      : integrator_(integrator), with_azimuth_(with_azimuth) {}

  void compute(const std::vector<ScanPosition>& positions, const ScanPlan& plan) {
    std::map<Place, Aperture> apertures;
    for (const ScanPosition& position : positions) {
      const MeasuringGeometry geometry = scan_geometry(position, plan.source, plan.receptor);
      apertures.emplace(source_key(position), geometry.source);
      apertures.emplace(receptor_key(position), geometry.receptor);
    }
    const std::vector<std::pair<Place, Aperture>> list(apertures.begin(), apertures.end());
    std::vector<double> angles(list.size());
    parallel_for(list.size(),
                 [&](std::size_t a) { angles[a] = integrator_.incident(list[a].second); });
    for (std::size_t a = 0; a < list.size(); ++a) {
      angles_[list[a].first] = angles[a];
      if (!(angles[a] > 0.0)) {
        throw std::invalid_argument(
            "a scan by patches needs apertures in which patches lie: more patches, or larger ones");
      }
    }
  }
  [[nodiscard]] double source(const ScanPosition& position) const {
    return angles_.at(source_key(position));
  }
  [[nodiscard]] double receptor(const ScanPosition& position) const {
    return angles_.at(receptor_key(position));
  }

 private:
  [[nodiscard]] Place source_key(const ScanPosition& position) const {
    return {0, microdegrees(position.theta_i.degrees()),
            with_azimuth_ ? microdegrees(position.azimuth_i().degrees()) : 0, 0};
  }
  [[nodiscard]] Place receptor_key(const ScanPosition& position) const {
    return {1, std::abs(microdegrees(position.theta_r.degrees())),
            with_azimuth_ ? microdegrees(position.azimuth_r().degrees()) : 0, 0};
  }

  const FluxIntegrator& integrator_;
  bool with_azimuth_;
  std::map<Place, double> angles_;
};

/// f_r of one position, and its error.
struct Recorded {
  ArrayXd f_r;
  double error = 0.0;
  bool missed = false;
};

/// The tolerance is relative to what is still to be measured: the first guess is the BRDF on the
/// axes, and the second the result.
Recorded record(const FluxIntegrator& integrator, const Sample& sample, const ScanPlan& plan,
                const ArrayXd& weight, const ScanPosition& position, double projected) {
  MeasuringGeometry geometry = scan_geometry(position, plan.source, plan.receptor);
  geometry.source = geometry.source.seen_by_tilted(sample.tilt);
  geometry.receptor = geometry.receptor.seen_by_tilted(sample.tilt);
  const Vector3& i = geometry.source.frame().axis;
  const Vector3& r = geometry.receptor.frame().axis;
  const bool is_above = i.z() > 0.0 && r.z() > 0.0;
  const double guess = is_above ? (weight * sample.surface.brdf(i, r)).sum() : 0.0;
  double asked = plan.tolerance * (guess + least_f_r);
  constexpr int tries = 3;
  Recorded recorded;
  for (int attempt = 0; attempt < tries; ++attempt) {
    const Flux flux = integrator.reflected(sample.surface, geometry, weight, asked * projected);
    recorded = {.f_r = flux.spectral / projected, .error = flux.error / projected};
    const double needed = plan.tolerance * ((weight * recorded.f_r).sum() + least_f_r);
    recorded.missed = !(recorded.error <= needed);
    if (!recorded.missed || plan.integrator == ScanIntegrator::patches) {
      break;
    }
    asked = 0.5 * std::min(needed, asked);
  }
  return recorded;
}

/// Pairs of directions all over the hemisphere, and turns of both.
template <class Try>
bool holds_everywhere(const Try& agree) {
  const std::array polar_deg{2.0, 17.0, 43.0, 66.0, 81.0};
  for (const double i_deg : polar_deg) {
    for (const double r_deg : polar_deg) {
      for (const double between_deg : {180.0, 171.0, 97.0, 15.0}) {
        if (!agree(degrees(i_deg), degrees(r_deg), degrees(between_deg))) {
          return false;
        }
      }
    }
  }
  return true;
}

bool are_equal(const ArrayXd& first, const ArrayXd& second) {
  constexpr double relative = 1e-9;  // above rounding, below what any instrument tells
  return ((first - second).abs() <= relative * first.abs().max(second.abs()) + 1e-12).all();
}

std::shared_ptr<const FluxIntegrator> integrator_of(const ScanPlan& plan) {
  if (plan.integrator == ScanIntegrator::patches) {
    return std::make_shared<PatchIntegrator>(plan.patches);
  }
  return std::make_shared<ApertureIntegrator>();
}

bool may_exchange(const Surface& surface, const ScanPlan& plan) {
  if (plan.reciprocity == UseOfReciprocity::no) {
    return false;
  }
  const bool holds = plan.source == plan.receptor && is_reciprocal(surface);
  if (!holds && plan.reciprocity == UseOfReciprocity::yes) {
    throw std::invalid_argument(
        plan.source == plan.receptor
            ? "reciprocity cannot fill in positions: the sample's BRDF does not keep to it"
            : "reciprocity cannot fill in positions: source and receptor have other apertures");
  }
  return holds;
}

}  // namespace

bool is_isotropic(const Surface& surface) {
  return holds_everywhere([&](Angle theta_i, Angle theta_r, Angle between) {
    const auto f_r = [&](double turn_deg) -> ArrayXd {
      return surface.brdf(frame_towards(theta_i, degrees(turn_deg)).axis,
                          frame_towards(theta_r, degrees(turn_deg) + between).axis);
    };
    const ArrayXd first = f_r(180.0);
    return are_equal(first, f_r(217.0)) && are_equal(first, f_r(270.0));
  });
}

bool is_reciprocal(const Surface& surface) {
  return holds_everywhere([&](Angle theta_i, Angle theta_r, Angle between) {
    const Vector3 i = frame_towards(theta_i, degrees(197.0)).axis;
    const Vector3 r = frame_towards(theta_r, degrees(197.0) + between).axis;
    return are_equal(surface.brdf(i, r), surface.brdf(r, i));
  });
}

ScanLight scan_light(const ScanPlan& plan, const Catalog& catalog) {
  const SpectralTable spectrum = plan.spectrum.empty()
                                     ? SpectralTable::load(catalog.fixture("illuminants/d65.csv"))
                                     : SpectralTable::load(plan.spectrum);
  const SpectralTable v_lambda =
      SpectralTable::load(catalog.fixture("observers/cie_1931_2deg.csv"), "y_bar");
  ScanLight light{.source = spectrum.sample(plan.grid)};
  if (light.source.minCoeff() < 0.0 || !(light.source.sum() > 0.0)) {
    throw InputError(spectrum.mark(), "power at the wavelengths of the scan, nowhere below 0",
                     "none or less");
  }
  light.source /= light.source.sum();
  light.weight = light.source;
  for (Index l = 0; l < plan.grid.size(); ++l) {
    const Wavelength lambda = nanometres(plan.grid.nanometres()(l));
    light.weight(l) *=
        lambda >= v_lambda.first() && lambda <= v_lambda.last() ? v_lambda.at(lambda) : 0.0;
  }
  light.by_luminance = light.weight.sum() > 0.0;
  light.weight = light.by_luminance ? ArrayXd(light.weight / light.weight.sum()) : light.source;
  return light;
}

ScanResult scan(const Sample& sample, const ScanPlan& plan, const ScanLight& light,
                const std::function<void(std::size_t done, std::size_t total)>& advance) {
  if (plan.receptor.is_collimated() && !sample.surface.interfaces.empty()) {
    throw std::invalid_argument(
        "a sample with a smooth interface needs a receptor aperture: its BRDF is a delta");
  }
  ScanResult result{.positions = plan.positions(), .light = light};
  result.is_isotropic = sample.tilt == Angle{} && is_isotropic(sample.surface);
  const Duties duties = duties_of(result.positions, plan.heads_apart,
                                  may_exchange(sample.surface, plan), result.is_isotropic);
  const auto integrator = integrator_of(plan);
  ProjectedAngles angles(*integrator, plan.integrator == ScanIntegrator::patches);
  angles.compute(result.positions, plan);

  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const Index n = result.size();
  result.state = duties.state;
  result.f_r.setConstant(plan.grid.size(), n, nothing);
  result.error.setConstant(n, nothing);
  result.omega_r.resize(n);
  result.evaluations = duties.to_measure.size();
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(duties.to_measure.size(), [&](std::size_t m) {
    const std::size_t p = duties.to_measure[m];
    const ScanPosition& position = result.positions[p];
    const Recorded recorded = record(*integrator, sample, plan, light.weight, position,
                                     angles.source(position) * angles.receptor(position));
    result.f_r.col(Index(p)) = recorded.f_r;
    result.error(Index(p)) = recorded.error;
    const std::scoped_lock lock(mutex);
    result.missed += recorded.missed ? 1 : 0;
    if (advance) {
      advance(++done, duties.to_measure.size());
    }
  });
  for (Index p = 0; p < n; ++p) {
    result.omega_r(p) = angles.receptor(result.positions[std::size_t(p)]);
    if (duties.state[std::size_t(p)] == PositionState::reciprocal) {
      const auto other = Index(duties.told_by[std::size_t(p)]);
      result.f_r.col(p) = result.f_r.col(other);
      result.error(p) = result.error(other);
    }
  }
  return result;
}

}  // namespace gonio
