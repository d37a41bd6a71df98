#include "emulator/procedure/measure_colour.hpp"

#include <fmt/format.h>

#include <cmath>
#include <mutex>

#include "emulator/core/parallel_for.hpp"
#include "emulator/procedure/measure.hpp"

namespace gonio {

const std::vector<std::string>& colour_illuminants() {
  static const std::vector<std::string> names{"d65", "a", "c", "d50"};
  return names;
}

const std::vector<std::string>& colour_observers() {
  static const std::vector<std::string> names{"10", "2"};
  return names;
}

Eigen::ArrayXd ColourConditions::luminous_weight() const {
  const Eigen::ArrayXd weight = power * matching.y_bar;
  return weight / weight.sum();
}

ColourConditions load_colour_conditions(const Catalog& catalog, const std::string& illuminant,
                                        const std::string& observer, const WavelengthGrid& grid) {
  const auto power = catalog.fixture(fmt::format("illuminants/{}.csv", illuminant));
  const auto matching = catalog.fixture(observer == "2" ? "observers/cie_1931_2deg.csv"
                                                        : "observers/cie_1964_10deg.csv");
  return {.illuminant = illuminant,
          .observer = observer,
          .power = SpectralTable::load(power).sample(grid),
          .matching = Observer::load(matching, grid)};
}

std::optional<double> flop_index(const FlopRule& rule,
                                 const std::map<std::string, double>& lightness) {
  const auto near = lightness.find(rule.near_specular);
  const auto face = lightness.find(rule.face);
  const auto far = lightness.find(rule.far);
  if (near == lightness.end() || face == lightness.end() || far == lightness.end()) {
    return std::nullopt;
  }
  // What the integrator leaves of the difference of equal values.
  constexpr double same = 1e-6;
  const double change = near->second - far->second;
  if (std::abs(change) < same) {
    return 0.0;
  }
  if (change < 0.0 || !(face->second > 0.0)) {
    return std::nullopt;
  }
  return rule.factor.nominal * std::pow(change, rule.power.nominal) /
         std::pow(face->second, rule.face_power.nominal);
}

ColourMeasurement measure_colour(const Sample& sample, const Colorimeter& colorimeter,
                                 const ColourConditions& conditions, const ColourOptions& options) {
  const Standard& standard = colorimeter.instrument().standard;
  const Xyz white = white_point(conditions.power, conditions.matching);
  ColourMeasurement measurement{.sample = sample.id, .sample_title = sample.title};
  std::map<std::string, double> lightness;
  for (const std::string& id : geometries_asked_for(colorimeter.instrument(), options.geometries)) {
    const GeometryLimits& limits = standard.geometry(id);
    const ColourReading reading =
        colorimeter.read(sample.surface, id, options.tolerance, sample.tilt + options.tilt);
    const Xyz xyz = tristimulus(reading.radiance_factor, conditions.power, conditions.matching);
    const bool is_black = !(xyz.X + xyz.Y + xyz.Z > 0.0);
    const auto aspecular = aspecular_angle(limits);
    measurement.geometries.push_back(
        {.id = id,
         .theta_i = limits.theta_i.nominal,
         .theta_r = aspecular ? std::optional(limits.receptor_angle()) : std::nullopt,
         .aspecular = aspecular,
         .reading = reading,
         .xyz = xyz,
         .xy = is_black ? std::nullopt : std::optional(chromaticity(xyz)),
         .lab = cielab(xyz, white),
         .evidence = limits.evidence()});
    lightness.emplace(id, measurement.geometries.back().lab.L);
  }
  if (standard.flop) {
    measurement.flop = FlopResult{.value = flop_index(*standard.flop, lightness),
                                  .evidence = standard.flop->evidence()};
  }
  return measurement;
}

std::vector<ColourMeasurement> measure_colours(const std::vector<Sample>& samples,
                                               const Colorimeter& colorimeter,
                                               const ColourConditions& conditions,
                                               const ColourOptions& options,
                                               const std::function<void()>& advance) {
  std::vector<ColourMeasurement> results(samples.size());
  std::mutex mutex;
  parallel_for(samples.size(), [&](std::size_t i) {
    results[i] = measure_colour(samples[i], colorimeter, conditions, options);
    if (advance) {
      const std::scoped_lock lock(mutex);
      advance();
    }
  });
  return results;
}

}  // namespace gonio
