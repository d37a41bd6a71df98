#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "emulator/goniometry/setup_model.hpp"
#include "emulator/procedure/prior_fit.hpp"

namespace gonio {

/// A parameter as the spectra tell it.
struct CalibratedParameter {
  SetupParameter parameter;
  double start = 0.0;  ///< where the search began
  double estimate = 0.0;
  double u = 0.0;    ///< standard uncertainty
  double low = 0.0;  ///< of its own 95 % interval
  double high = 0.0;
  double effect = 0.0;         ///< of one range on the spectra: root sum of squares, in their u
  bool is_determined = false;  ///< the spectra tell at least half of what was not known
};

/// A semi-axis of the joint region, an ellipsoid round the estimate.
struct RegionAxis {
  std::vector<double> direction = {};  ///< by parameter, in its unit, to the surface
  /// Chi squared at both ends above that of the estimate, over what the ellipsoid says; 1 for a
  /// model that is linear. Not finite where the model has no answer.
  double growth_low = 0.0, growth_high = 0.0;
};

/// How a spectrum is met.
struct CalibratedSpectrum {
  std::string sample;
  ReflectanceSpectrum measured;
  Eigen::ArrayXd at_start, simulated;  ///< shape (n)
  double rmse_at_start = 0.0, rmse = 0.0;
  double relative_rmse = 0.0;  ///< rmse over the root mean square of the measured
  double mirror_share = 0.0;   ///< of the light of a perfect mirror, that comes to the receptor
};

/// The set-up that explains spectra best.
struct SetupCalibration {
  Instrument instrument;  ///< with the estimates, and their uncertainties
  std::vector<CalibratedParameter> parameters = {};
  Eigen::MatrixXd covariance = {};         ///< shape (p, p)
  double region_quantile = 0.0;            ///< of the joint 95 % region: squared distance <= it
  std::vector<RegionAxis> axes = {};       ///< the longest first, in ranges of the parameters
  std::vector<Confusion> confusions = {};  ///< what the spectra cannot tell apart
  std::vector<CalibratedSpectrum> spectra = {};
  double rmse_at_start = 0.0, rmse = 0.0;  ///< of all spectra
  double chi_squared = 0.0;                ///< of the spectra
  std::size_t degrees_of_freedom = 0;
  double p_value = 0.0;         ///< that chi squared is at least so large if the model holds
  bool is_weighted = false;     ///< by stated uncertainties; else u comes from the residuals
  double u_of_residuals = 0.0;  ///< root of residual squares over degrees of freedom
  bool has_converged = false;

  /// The squared distance of parameters from the estimate, in its covariance.
  [[nodiscard]] double distance(const Eigen::VectorXd& x) const;
};

/// Fits the parameters of a model to its spectra by Levenberg-Marquardt, weighted by 1 / u^2 where
/// all spectra state u, else alike. Parameters that the spectra do not tell stay within their range
/// of where the search began. The covariance follows from derivatives at the estimate; the joint
/// region is the ellipsoid of chi squared with p degrees of freedom, or of p F(p, n - p) where u
/// comes from the residuals, and a parameter's own interval that of the normal or Student's t.
/// @param start  shape (n_parameters).
/// @throws std::invalid_argument  for no parameters, or not more values than parameters.
/// @throws InputError             if no light comes to a receptor where the search begins.
[[nodiscard]] SetupCalibration calibrate_setup(const SetupModel& model,
                                               const Eigen::VectorXd& start);

/// Another set-up that explains the spectra.
struct OtherSetup {
  Eigen::VectorXd estimate;  ///< shape (n_parameters)
  double chi_squared = 0.0;  ///< in the u of the calibration
};

/// Set-ups outside of the joint region that explain the spectra as well: whose chi squared is above
/// that of the estimate by no more than the region's quantile, the best first. They are looked for
/// from both sides of the estimate in each parameter; who finds none has no proof.
[[nodiscard]] std::vector<OtherSetup> other_setups(const SetupModel& model,
                                                   const SetupCalibration& found);

/// What a search from several places found.
struct SearchedSetup {
  SetupCalibration best;
  std::vector<OtherSetup> others = {};
};

/// The best calibration from those starts, and from whatever other set-ups explain the spectra
/// better than it.
/// @param starts  at least one, each of shape (n_parameters).
/// @throws as calibrate_setup.
[[nodiscard]] SearchedSetup search_setup(const SetupModel& model,
                                         const std::vector<Eigen::VectorXd>& starts);

/// The root of the mean of squares; 0 of nothing.
[[nodiscard]] double root_mean_square(const Eigen::ArrayXd& values);

}  // namespace gonio
