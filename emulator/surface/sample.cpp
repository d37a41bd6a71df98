#include "emulator/surface/sample.hpp"

#include <fmt/format.h>

#include <map>
#include <vector>

#include "emulator/core/table.hpp"
#include "emulator/core/yaml_map.hpp"
#include "emulator/optics/refractive_index.hpp"
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

Surface read_smooth(YamlMap& map, const WavelengthGrid& grid) {
  if (const auto reflectance = map.optional("reflectance")) {
    if (map.has("refractive_index")) {
      reflectance->fail("either reflectance or refractive_index", "both");
    }
    return smooth(grid, reflectance->number(Range::closed(0.0, 1.0)));
  }
  return smooth(grid, read_index(map, grid));
}

Surface read_lambertian(YamlMap& map, const WavelengthGrid& grid) {
  return lambertian(grid, read_reflectance(map.required("reflectance"), grid));
}

Surface read_cook_torrance(YamlMap& map, const WavelengthGrid& grid) {
  const double rms_slope = map.required("rms_slope").number(roughness_range());
  auto normalization = Normalization::energy_conserving;
  if (const auto node = map.optional("normalization")) {
    normalization = node->choice({"energy_conserving", "as_printed"}) == "as_printed"
                        ? Normalization::as_printed
                        : Normalization::energy_conserving;
  }
  const Amplitudes amplitudes = read_amplitudes(map, grid, false);
  return cook_torrance(grid, rms_slope, read_index(map, grid), amplitudes, normalization);
}

Surface read_ggx(YamlMap& map, const WavelengthGrid& grid) {
  const double alpha = map.required("alpha").number(roughness_range());
  auto masking = Masking::height_correlated;
  if (const auto node = map.optional("masking")) {
    masking = node->choice({"height_correlated", "separable"}) == "separable"
                  ? Masking::separable
                  : Masking::height_correlated;
  }
  const Amplitudes amplitudes = read_amplitudes(map, grid, false);
  return ggx(grid, alpha, read_index(map, grid), amplitudes, masking);
}

Surface read_ward(YamlMap& map, const WavelengthGrid& grid) {
  const double alpha_x = map.required("alpha_x").number(roughness_range());
  const double alpha_y = map.required("alpha_y").number(roughness_range());
  return ward(grid, alpha_x, alpha_y, read_amplitudes(map, grid, true));
}

Surface read_coherent_roughness(YamlMap& map, const WavelengthGrid& grid) {
  const Length rms_height = map.required("rms_height").length(Range::not_negative());
  const Length correlation_length = map.required("correlation_length").length(Range::positive());
  return coherent_roughness(grid, rms_height, correlation_length, read_index(map, grid));
}

Surface read_coated(YamlMap& map, const WavelengthGrid& grid) {
  constexpr double clear = 1e-3;  // a coat of larger k is opaque within some wavelengths
  const ArrayXd base = read_reflectance(map.required("base"), grid);
  const YamlNode index = map.required("refractive_index");
  const ArrayXcd n_hat = RefractiveIndex::read(index).sample(grid);
  if (n_hat.real().minCoeff() <= 1.0 || n_hat.imag().maxCoeff() > clear) {
    index.fail("a clear coat, n > 1 and k <= 0.001",
               fmt::format("n down to {:g}, k up to {:g}", n_hat.real().minCoeff(),
                           n_hat.imag().maxCoeff()));
  }
  const auto slope = map.optional("rms_slope");
  return coated(grid, base, n_hat.real(), slope ? slope->number(Range::closed(0.0, 1.0)) : 0.0);
}

using ModelReader = Surface (*)(YamlMap&, const WavelengthGrid&);

const std::map<std::string, ModelReader>& model_readers() {
  static const std::map<std::string, ModelReader> readers{
      {"smooth", read_smooth},
      {"lambertian", read_lambertian},
      {"cook_torrance", read_cook_torrance},
      {"ggx", read_ggx},
      {"ward", read_ward},
      {"coherent_roughness", read_coherent_roughness},
      {"coated", read_coated}};
  return readers;
}

Surface read_model(YamlMap& map, const WavelengthGrid& grid) {
  std::vector<std::string> names;
  for (const auto& [name, reader] : model_readers()) {
    names.push_back(name);
  }
  return model_readers().at(map.required("model").choice(names))(map, grid);
}

/// `lobes:`, a mixture by area: models with a weight each.
Surface read_lobes(const YamlNode& list, const WavelengthGrid& grid) {
  std::vector<Surface> surfaces;
  std::vector<double> weights;
  double total = 0.0;
  for (const YamlNode& item : list.list()) {
    surfaces.push_back(item.read_map([&](YamlMap& map) {
      const YamlNode weight = map.required("weight");
      weights.push_back(weight.number(Range::closed(0.0, 1.0)));
      total += weights.back();
      if (total > 1.0 + rounding) {
        weight.fail("weights of sum <= 1", fmt::format("{:g}", total));
      }
      return read_model(map, grid);
    }));
  }
  return mixture(surfaces, weights);
}

}  // namespace

Sample load_sample(const std::filesystem::path& path, const WavelengthGrid& grid) {
  return YamlNode::load(path).read_map([&](YamlMap& map) {
    map.expect_schema("gonio/sample/1");
    Sample sample{.file = path, .surface = {.grid = grid}};
    sample.id = map.required("id").id();
    sample.title = map.required("title").line();
    if (const auto notes = map.optional("notes")) {
      sample.notes = notes->text();
    }
    if (const auto tilt = map.optional("tilt")) {
      sample.tilt = tilt->angle(Range::closed(-45.0, 45.0));
    }
    if (const auto lobes = map.optional("lobes")) {
      if (const auto surface = map.optional("surface")) {
        surface->fail("either surface or lobes", "both");
      }
      sample.surface = read_lobes(*lobes, grid);
    } else {
      sample.surface =
          map.required("surface").read_map([&](YamlMap& model) { return read_model(model, grid); });
    }
    return sample;
  });
}

}  // namespace gonio
