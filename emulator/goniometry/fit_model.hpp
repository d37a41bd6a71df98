#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/surface/surface.hpp"

namespace gonio {

/// Values of parameters, by name.
using FitValues = std::map<std::string, double>;

/// A parameter of a reflection model, in the unit that its name ends with, if any.
struct FitParameter {
  /// What it is searched in: its logarithm, its logit within its range, or nothing: an amplitude
  /// is linear, and is solved for. Amplitudes of a model are >= 0 and of sum <= 1.
  enum class Scale { log, logit, amplitude };

  std::string name;
  double low = 0.0, high = 1.0;  ///< its range; a search ends at either
  Scale scale = Scale::log;
};

/// A part of a model: a surface, which is multiplied by an amplitude.
struct FitTerm {
  std::string amplitude = {};           ///< empty: 1
  std::vector<std::string> shape = {};  ///< the parameters that its surface depends on
  /// The surface for an amplitude of 1. @param n_hat  shape (grid.size())
  std::function<Surface(const WavelengthGrid& grid, const Eigen::ArrayXcd& n_hat,
                        const FitValues& values)>
      surface;
};

/// A reflection model whose parameters can be fitted.
struct FittableModel {
  std::string name;
  std::string title;
  std::vector<FitParameter> parameters;  ///< amplitudes last
  std::vector<FitTerm> terms;
  std::vector<FitValues> starts = {};  ///< shapes from which searches begin; none without shapes
  bool has_index = true;               ///< whether it needs a refractive index
  /// What stands below `id`, `title` and `notes` in a sample file, for a refractive index in YAML.
  std::function<std::string(const FitValues& values, const std::string& index)> yaml;
};

/// The name of the refractive index as a parameter: a number, the same at all wavelengths.
inline constexpr const char* index_parameter = "refractive_index";

/// All models, those of fewest parameters first.
[[nodiscard]] const std::vector<FittableModel>& fittable_models();
/// @throws std::invalid_argument  that lists the models, if there is none of that name.
[[nodiscard]] const FittableModel& fittable_model(const std::string& name);
/// The same model with the refractive index as a parameter; as it is if it needs none.
[[nodiscard]] FittableModel with_free_index(FittableModel model);

}  // namespace gonio
