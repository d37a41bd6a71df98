#include "emulator/goniometry/fit_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "emulator/surface/models.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Scale = FitParameter::Scale;

/// A narrower lobe is a mirror to any instrument, and a wider one is beyond the models.
constexpr double finest = 0.004, roughest = 1.0;

/// Slopes a factor of 2 apart: a lobe is never missed between two of them.
constexpr std::array first_slopes{1.0 / 128, 1.0 / 64, 1.0 / 32, 1.0 / 16, 0.125, 0.25, 0.5};

FitParameter slope(const std::string& name) {
  return {.name = name, .low = finest, .high = roughest, .scale = Scale::log};
}

/// The same slope for all names.
std::vector<FitValues> slope_starts(const std::vector<std::string>& names) {
  std::vector<FitValues> starts;
  for (const double slope : first_slopes) {
    FitValues& start = starts.emplace_back();
    for (const std::string& name : names) {
      start[name] = slope;
    }
  }
  return starts;
}

/// All pairs of slopes of which the second is the larger.
std::vector<FitValues> pair_starts(const std::string& narrow, const std::string& wide) {
  std::vector<FitValues> starts;
  for (const double first : first_slopes) {
    for (const double second : first_slopes) {
      if (second > first) {
        starts.push_back({{narrow, first}, {wide, second}});
      }
    }
  }
  return starts;
}

/// Mirrors with a little haze, and rough surfaces.
std::vector<FitValues> coherent_starts() {
  std::vector<FitValues> starts;
  for (const double height : {20.0, 60.0, 150.0, 400.0}) {
    for (const double length : {2.0, 10.0, 50.0}) {
      starts.push_back({{"rms_height_nm", height}, {"correlation_length_um", length}});
    }
  }
  return starts;
}

std::vector<FitValues> coated_starts() {
  constexpr double base = 0.2;
  std::vector<FitValues> starts = slope_starts({"rms_slope"});
  for (FitValues& start : starts) {
    start["base"] = base;
  }
  return starts;
}

FitParameter amplitude(const std::string& name) {
  return {.name = name, .scale = Scale::amplitude};
}

FitTerm diffuse_term(const std::string& name) {
  return {.amplitude = name,
          .surface = [](const WavelengthGrid& grid, const ArrayXcd&, const FitValues&) {
            return lambertian(grid, ArrayXd::Ones(grid.size()));
          }};
}

FitTerm beckmann_term(const std::string& amplitude, const std::string& slope) {
  return {.amplitude = amplitude,
          .shape = {slope},
          .surface = [slope](const WavelengthGrid& grid, const ArrayXcd& n_hat,
                             const FitValues& values) {
            return cook_torrance(grid, values.at(slope), n_hat);
          }};
}

FittableModel lambertian_model() {
  return {.name = "lambertian",
          .title = "Lambert's law",
          .parameters = {amplitude("reflectance")},
          .terms = {diffuse_term("reflectance")},
          .has_index = false,
          .yaml = [](const FitValues& values, const std::string&) {
            return fmt::format("surface:\n  model: lambertian\n  reflectance: {}\n",
                               values.at("reflectance"));
          }};
}

FittableModel cook_torrance_model() {
  return {.name = "cook_torrance",
          .title = "Cook and Torrance, energy conserving",
          .parameters = {slope("rms_slope"), amplitude("specular"), amplitude("diffuse")},
          .terms = {beckmann_term("specular", "rms_slope"), diffuse_term("diffuse")},
          .starts = slope_starts({"rms_slope"}),
          .yaml = [](const FitValues& values, const std::string& index) {
            return fmt::format(
                "surface:\n  model: cook_torrance\n  rms_slope: {}\n  specular: {}\n  diffuse: "
                "{}\n  normalization: energy_conserving\n  refractive_index: {}\n",
                values.at("rms_slope"), values.at("specular"), values.at("diffuse"), index);
          }};
}

FittableModel ggx_model() {
  return {
      .name = "ggx",
      .title = "Trowbridge and Reitz (GGX), height-correlated masking",
      .parameters = {slope("alpha"), amplitude("specular"), amplitude("diffuse")},
      .terms = {{.amplitude = "specular",
                 .shape = {"alpha"},
                 .surface =
                     [](const WavelengthGrid& grid, const ArrayXcd& n_hat,
                        const FitValues& values) { return ggx(grid, values.at("alpha"), n_hat); }},
                diffuse_term("diffuse")},
      .starts = slope_starts({"alpha"}),
      .yaml = [](const FitValues& values, const std::string& index) {
        return fmt::format(
            "surface:\n  model: ggx\n  alpha: {}\n  specular: {}\n  diffuse: {}\n  "
            "refractive_index: {}\n",
            values.at("alpha"), values.at("specular"), values.at("diffuse"), index);
      }};
}

FittableModel ward_model() {
  return {.name = "ward",
          .title = "Ward, bounded albedo",
          .parameters = {slope("alpha_x"), slope("alpha_y"), amplitude("specular"),
                         amplitude("diffuse")},
          .terms = {{.amplitude = "specular",
                     .shape = {"alpha_x", "alpha_y"},
                     .surface =
                         [](const WavelengthGrid& grid, const ArrayXcd&, const FitValues& values) {
                           return ward(grid, values.at("alpha_x"), values.at("alpha_y"), {});
                         }},
                    diffuse_term("diffuse")},
          .starts = slope_starts({"alpha_x", "alpha_y"}),
          .has_index = false,
          .yaml = [](const FitValues& values, const std::string&) {
            return fmt::format(
                "surface:\n  model: ward\n  alpha_x: {}\n  alpha_y: {}\n  specular: {}\n  "
                "diffuse: {}\n",
                values.at("alpha_x"), values.at("alpha_y"), values.at("specular"),
                values.at("diffuse"));
          }};
}

FittableModel coherent_roughness_model() {
  return {
      .name = "coherent_roughness",
      .title = "Gaussian rough interface in scalar diffraction",
      .parameters = {{.name = "rms_height_nm", .low = 1.0, .high = 5000.0},
                     {.name = "correlation_length_um", .low = 0.1, .high = 1000.0}},
      .terms = {{.shape = {"rms_height_nm", "correlation_length_um"},
                 .surface =
                     [](const WavelengthGrid& grid, const ArrayXcd& n_hat,
                        const FitValues& values) {
                       constexpr double nm_per_um = 1000.0;
                       return coherent_roughness(
                           grid, nanometres(values.at("rms_height_nm")),
                           nanometres(nm_per_um * values.at("correlation_length_um")), n_hat);
                     }}},
      .starts = coherent_starts(),
      .yaml = [](const FitValues& values, const std::string& index) {
        return fmt::format(
            "surface:\n  model: coherent_roughness\n  rms_height: {} nm\n  correlation_length: {} "
            "um\n  refractive_index: {}\n",
            values.at("rms_height_nm"), values.at("correlation_length_um"), index);
      }};
}

FittableModel coated_model() {
  return {.name = "coated",
          .title = "Diffuse base under a rough dielectric interface",
          .parameters = {slope("rms_slope"),
                         {.name = "base", .low = 0.0, .high = 1.0, .scale = Scale::logit}},
          .terms = {{.shape = {"rms_slope", "base"},
                     .surface =
                         [](const WavelengthGrid& grid, const ArrayXcd& n_hat,
                            const FitValues& values) {
                           return coated(grid, ArrayXd::Constant(grid.size(), values.at("base")),
                                         n_hat.real(), values.at("rms_slope"));
                         }}},
          .starts = coated_starts(),
          .yaml = [](const FitValues& values, const std::string& index) {
            return fmt::format(
                "surface:\n  model: coated\n  rms_slope: {}\n  base: {}\n  refractive_index: {}\n",
                values.at("rms_slope"), values.at("base"), index);
          }};
}

/// A sharp lobe within a wide one, both of Beckmann's facets: hazy gloss.
FittableModel hazy_model() {
  return {.name = "hazy",
          .title = "Two lobes of Cook and Torrance: gloss and haze",
          .parameters = {slope("rms_slope"), slope("haze_slope"), amplitude("specular"),
                         amplitude("haze"), amplitude("diffuse")},
          .terms = {beckmann_term("specular", "rms_slope"), beckmann_term("haze", "haze_slope"),
                    diffuse_term("diffuse")},
          .starts = pair_starts("rms_slope", "haze_slope"),
          .yaml = [](const FitValues& values, const std::string& index) {
            const auto lobe = [&](const char* weight, const char* slope) {
              return fmt::format(
                  "  - {{weight: {}, model: cook_torrance, rms_slope: {}, refractive_index: {}}}\n",
                  values.at(weight), values.at(slope), index);
            };
            return fmt::format(
                "lobes:\n{}{}  - {{weight: {}, model: lambertian, reflectance: 1.0}}\n",
                lobe("specular", "rms_slope"), lobe("haze", "haze_slope"), values.at("diffuse"));
          }};
}

}  // namespace

const std::vector<FittableModel>& fittable_models() {
  static const std::vector<FittableModel> models{
      lambertian_model(),    coated_model(), coherent_roughness_model(),
      cook_torrance_model(), ggx_model(),    ward_model(),
      hazy_model()};
  return models;
}

const FittableModel& fittable_model(const std::string& name) {
  const auto& models = fittable_models();
  const auto found = std::ranges::find(models, name, &FittableModel::name);
  if (found == models.end()) {
    std::vector<std::string> names;
    std::ranges::transform(models, std::back_inserter(names), &FittableModel::name);
    throw std::invalid_argument(
        fmt::format("--model: expected one of {}, found '{}'", fmt::join(names, ", "), name));
  }
  return *found;
}

FittableModel with_free_index(FittableModel model) {
  if (!model.has_index) {
    return model;
  }
  constexpr double lowest = 1.01, highest = 4.0, usual = 1.5;
  model.parameters.insert(model.parameters.begin(),
                          {.name = index_parameter, .low = lowest, .high = highest});
  for (FitValues& start : model.starts) {
    start[index_parameter] = usual;
  }
  for (FitTerm& term : model.terms) {
    if (!term.shape.empty()) {
      term.shape.emplace_back(index_parameter);
    }
  }
  return model;
}

}  // namespace gonio
