#include "emulator/surface/coating.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "emulator/core/table.hpp"
#include "emulator/optics/refractive_index.hpp"
#include "emulator/surface/measured_coating.hpp"
#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;

constexpr double rounding = 1e-12;  // of a sum of shares that should be 1

/// A slope or a roughness: the models hold from a polished surface to the roughest.
Range roughness_range() { return {.low = 0.0, .high = 1.0, .low_open = true}; }

/// A reflectance: one number, or a spectrum from a file.
ArrayXd read_reflectance(const YamlNode& node, const WavelengthGrid& grid) {
  if (!node.is_map()) {
    return ArrayXd::Constant(grid.size(), node.number(Range::closed(0.0, 1.0)));
  }
  const SpectralTable table = SpectralTable::load(node);
  ArrayXd spectrum = table.sample(grid);
  if (spectrum.minCoeff() < 0.0 || spectrum.maxCoeff() > 1.0) {
    throw InputError(table.mark(), "a reflectance in [0, 1] at all wavelengths",
                     fmt::format("{:g} to {:g}", spectrum.minCoeff(), spectrum.maxCoeff()));
  }
  return spectrum;
}

ArrayXcd read_index(YamlMap& map, const WavelengthGrid& grid) {
  return RefractiveIndex::read(map.required("refractive_index")).sample(grid);
}

/// `specular` and `diffuse`, which share the light.
Amplitudes read_amplitudes(YamlMap& map, const WavelengthGrid& grid, bool specular_required) {
  Amplitudes amplitudes;
  const auto specular = specular_required ? map.required("specular") : map.optional("specular");
  if (specular) {
    amplitudes.specular = specular->number(Range::closed(0.0, 1.0));
  }
  if (const auto diffuse = map.optional("diffuse")) {
    amplitudes.diffuse = read_reflectance(*diffuse, grid);
    const double sum = amplitudes.specular + amplitudes.diffuse.maxCoeff();
    if (sum > 1.0 + rounding) {
      diffuse->fail(fmt::format("specular + diffuse <= 1 (specular is {:g})", amplitudes.specular),
                    fmt::format("{:g}", sum));
    }
  }
  return amplitudes;
}

/// A roughness of the file, deviated; not beyond `highest`.
double rougher(const char* key, double value, const SampleDeviation& by, double highest = 1.0) {
  const double result = value * std::exp(by.roughness);
  if (!(result > 0.0 && result <= highest)) {
    throw std::domain_error(fmt::format("{} must be in (0, {:g}], is {:g} exp({:g}) = {:g}", key,
                                        highest, value, by.roughness, result));
  }
  return result;
}

/// A clear medium stays denser than air; of others n stays positive.
ArrayXcd denser(const ArrayXcd& n_hat, const SampleDeviation& by) {
  ArrayXcd result = n_hat + by.refractive_index;
  for (Eigen::Index l = 0; l < n_hat.size(); ++l) {
    const bool clear = n_hat(l).imag() == 0.0 && n_hat(l).real() > 1.0;
    const double lowest = clear ? 1.0 : 0.0;
    if (!(result(l).real() > lowest && std::isfinite(result(l).real()))) {
      throw std::domain_error(
          fmt::format("refractive_index must be > {:g}, is {:g} + ({:g}) = {:g}", lowest,
                      n_hat(l).real(), by.refractive_index, result(l).real()));
    }
  }
  return result;
}

/// A diffuse reflectance, kept within [0, highest].
ArrayXd lighter(const ArrayXd& spectrum, const SampleDeviation& by, double highest = 1.0) {
  if (by.diffuse_reflectance == 0.0 || spectrum.size() == 0) {
    return spectrum;  // not a bit of it changes, whatever the sum of shares was rounded to
  }
  return (spectrum + by.diffuse_reflectance).max(0.0).min(highest);
}

Amplitudes lighter(const Amplitudes& amplitudes, const SampleDeviation& by) {
  return {.specular = amplitudes.specular,
          .diffuse = lighter(amplitudes.diffuse, by, 1.0 - amplitudes.specular)};
}

Coating read_smooth(YamlMap& map, const WavelengthGrid& grid) {
  if (const auto reflectance = map.optional("reflectance")) {
    if (map.has("refractive_index")) {
      reflectance->fail("either reflectance or refractive_index", "both");
    }
    const Surface mirror = smooth(grid, reflectance->number(Range::closed(0.0, 1.0)));
    return {[mirror](const SampleDeviation&) { return mirror; }, {false, false, false}};
  }
  const ArrayXcd n_hat = read_index(map, grid);
  return {[=](const SampleDeviation& by) { return smooth(grid, denser(n_hat, by)); },
          {false, true, false}};
}

Coating read_lambertian(YamlMap& map, const WavelengthGrid& grid) {
  const ArrayXd reflectance = read_reflectance(map.required("reflectance"), grid);
  return {[=](const SampleDeviation& by) { return lambertian(grid, lighter(reflectance, by)); },
          {false, false, true}};
}

Coating read_cook_torrance(YamlMap& map, const WavelengthGrid& grid) {
  const double rms_slope = map.required("rms_slope").number(roughness_range());
  auto normalization = Normalization::energy_conserving;
  if (const auto node = map.optional("normalization")) {
    normalization = node->choice({"energy_conserving", "as_printed"}) == "as_printed"
                        ? Normalization::as_printed
                        : Normalization::energy_conserving;
  }
  const Amplitudes amplitudes = read_amplitudes(map, grid, false);
  const ArrayXcd n_hat = read_index(map, grid);
  return {[=](const SampleDeviation& by) {
            return cook_torrance(grid, rougher("rms_slope", rms_slope, by), denser(n_hat, by),
                                 lighter(amplitudes, by), normalization);
          },
          {true, true, amplitudes.diffuse.size() > 0}};
}

Coating read_ggx(YamlMap& map, const WavelengthGrid& grid) {
  const double alpha = map.required("alpha").number(roughness_range());
  auto masking = Masking::height_correlated;
  if (const auto node = map.optional("masking")) {
    masking = node->choice({"height_correlated", "separable"}) == "separable"
                  ? Masking::separable
                  : Masking::height_correlated;
  }
  const Amplitudes amplitudes = read_amplitudes(map, grid, false);
  const ArrayXcd n_hat = read_index(map, grid);
  return {[=](const SampleDeviation& by) {
            return ggx(grid, rougher("alpha", alpha, by), denser(n_hat, by),
                       lighter(amplitudes, by), masking);
          },
          {true, true, amplitudes.diffuse.size() > 0}};
}

Coating read_ward(YamlMap& map, const WavelengthGrid& grid) {
  const double alpha_x = map.required("alpha_x").number(roughness_range());
  const double alpha_y = map.required("alpha_y").number(roughness_range());
  const Amplitudes amplitudes = read_amplitudes(map, grid, true);
  return {[=](const SampleDeviation& by) {
            return ward(grid, rougher("alpha_x", alpha_x, by), rougher("alpha_y", alpha_y, by),
                        lighter(amplitudes, by));
          },
          {true, false, amplitudes.diffuse.size() > 0}};
}

Coating read_coherent_roughness(YamlMap& map, const WavelengthGrid& grid) {
  const double rms_height_nm =
      map.required("rms_height").length(Range::not_negative()).nanometres();
  const Length correlation_length = map.required("correlation_length").length(Range::positive());
  const ArrayXcd n_hat = read_index(map, grid);
  if (rms_height_nm == 0.0) {
    return {[=](const SampleDeviation& by) { return smooth(grid, denser(n_hat, by)); },
            {false, true, false}};
  }
  return {[=](const SampleDeviation& by) {
            constexpr double highest_nm = 1e9;
            const double sigma_nm = rougher("rms_height [nm]", rms_height_nm, by, highest_nm);
            return coherent_roughness(grid, nanometres(sigma_nm), correlation_length,
                                      denser(n_hat, by));
          },
          {true, true, false}};
}

Coating read_coated(YamlMap& map, const WavelengthGrid& grid) {
  constexpr double clear = 1e-3;  // a coat of larger k is opaque within some wavelengths
  const ArrayXd base = read_reflectance(map.required("base"), grid);
  const YamlNode index = map.required("refractive_index");
  const ArrayXcd n_hat = RefractiveIndex::read(index).sample(grid);
  if (n_hat.real().minCoeff() <= 1.0 || n_hat.imag().maxCoeff() > clear) {
    index.fail("a clear coat, n > 1 and k <= 0.001",
               fmt::format("n down to {:g}, k up to {:g}", n_hat.real().minCoeff(),
                           n_hat.imag().maxCoeff()));
  }
  const ArrayXcd n = n_hat.real().cast<std::complex<double>>();
  const auto slope = map.optional("rms_slope");
  const double rms_slope = slope ? slope->number(Range::closed(0.0, 1.0)) : 0.0;
  return {[=](const SampleDeviation& by) {
            const double m = rms_slope > 0.0 ? rougher("rms_slope", rms_slope, by) : 0.0;
            return coated(grid, lighter(base, by), denser(n, by).real(), m);
          },
          {rms_slope > 0.0, true, true}};
}

using ModelReader = Coating (*)(YamlMap&, const WavelengthGrid&);

const std::map<std::string, ModelReader>& model_readers() {
  static const std::map<std::string, ModelReader> readers{
      {"smooth", read_smooth},
      {"lambertian", read_lambertian},
      {"cook_torrance", read_cook_torrance},
      {"ggx", read_ggx},
      {"ward", read_ward},
      {"coherent_roughness", read_coherent_roughness},
      {"coated", read_coated},
      {"measured", read_measured}};
  return readers;
}

Coating read_model(YamlMap& map, const WavelengthGrid& grid) {
  std::vector<std::string> names;
  for (const auto& [name, reader] : model_readers()) {
    names.push_back(name);
  }
  return model_readers().at(map.required("model").choice(names))(map, grid);
}

/// `lobes:`, a mixture by area: models with a weight each.
Coating read_lobes(const YamlNode& list, const WavelengthGrid& grid) {
  std::vector<Coating> coatings;
  std::vector<double> weights;
  double total = 0.0;
  for (const YamlNode& item : list.list()) {
    coatings.push_back(item.read_map([&](YamlMap& map) {
      const YamlNode weight = map.required("weight");
      weights.push_back(weight.number(Range::closed(0.0, 1.0)));
      total += weights.back();
      if (total > 1.0 + rounding) {
        weight.fail("weights of sum <= 1", fmt::format("{:g}", total));
      }
      return read_model(map, grid);
    }));
  }
  Coating::Parameters has{};
  for (std::size_t i = 0; i < has.size(); ++i) {
    has[i] = std::ranges::any_of(
        coatings, [i](const Coating& coating) { return coating.has(SampleParameter(i)); });
  }
  return {[coatings, weights](const SampleDeviation& by) {
            std::vector<Surface> surfaces;
            for (const Coating& coating : coatings) {
              surfaces.push_back(coating.surface(by));
            }
            return mixture(surfaces, weights);
          },
          has};
}

}  // namespace

Surface Coating::surface(const SampleDeviation& deviation) const {
  for (std::size_t i = 0; i < sample_parameter_count; ++i) {
    const double value = deviation[SampleParameter(i)];
    if (!std::isfinite(value)) {
      throw std::domain_error(
          fmt::format("a deviation of {} must be finite, is {}", sample_parameter_names[i], value));
    }
  }
  return make_(deviation);
}

Coating read_coating(YamlMap& map, const WavelengthGrid& grid) {
  if (const auto lobes = map.optional("lobes")) {
    if (const auto surface = map.optional("surface")) {
      surface->fail("either surface or lobes", "both");
    }
    return read_lobes(*lobes, grid);
  }
  return map.required("surface").read_map([&](YamlMap& model) { return read_model(model, grid); });
}

}  // namespace gonio
