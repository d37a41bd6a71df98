#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "emulator/goniometry/reflectance_spectrum.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/instrument/setup.hpp"
#include "emulator/integration/flux.hpp"
#include "emulator/surface/sample_family.hpp"

namespace gonio {

/// The perfect mirror that a reflectance is relative to.
enum class MirrorReference {
  source,   ///< all light of the source, for which the mirror stands: [Mihalik] eq. (17)
  receptor  ///< what the mirror sends into the same receptor: the ratio of two measurements
};

/// A measured spectrum, and what it is of.
struct CalibrationSpectrum {
  SampleFamily sample;  ///< on calibration_grid of all spectra
  ReflectanceSpectrum spectrum;
};

/// A grid for simulations of spectra: from their first to their last wavelength in steps of their
/// smallest one, 0.5 nm at least. A spectrum whose wavelengths lie between those of the grid is
/// compared with what is linear between them.
/// @throws std::invalid_argument  for no spectra.
[[nodiscard]] WavelengthGrid calibration_grid(const std::vector<ReflectanceSpectrum>& spectra);

/// A number that a calibration may set.
struct SetupParameter {
  enum class Kind {
    quantity,
    theta,  ///< theta_i, with theta_r as far from it as built: both arms are off alike
    scale,
    index_offset
  };
  Kind kind = Kind::quantity;
  SetupQuantity quantity = SetupQuantity::theta_i;  ///< of Kind::quantity
  std::vector<std::string> geometries = {};         ///< where it holds
  std::string name = {};                            ///< e.g. "theta_i 60", "source_diameter"
  std::string unit = {};                            ///< deg, or empty
  double assumed = 0.0;                             ///< as built
  double range = 0.0;  ///< how far it may be off: standard uncertainty before the data
};

/// The parameters that names stand for: `theta_i`, `theta_r`, `theta` (both alike), `source`,
/// `receptor` (the sizes that the opening has), `scale` (a factor of all reflectances), `index`
/// (added to n of all samples); of one geometry alone with its id behind a colon, `theta_i:60`. An
/// opening that is built alike in all geometries is one opening, as in [Mihalik] section 8.
/// @throws std::invalid_argument  for another name, a geometry that is not among those, or a
///                                parameter twice.
[[nodiscard]] std::vector<SetupParameter> setup_parameters(
    const Instrument& instrument, const std::vector<std::string>& geometries,
    const std::vector<std::string>& names);

/// The instrument with that parameter, in deg, known as well as that; unchanged by one that is not
/// of the set-up.
[[nodiscard]] Instrument with_parameter(Instrument instrument, const SetupParameter& parameter,
                                        double value, Angle expanded_uncertainty);

/// The reflectance spectra of samples that a set-up simulates, as a function of parameters.
class SetupModel {
 public:
  /// @throws InputError             for a geometry that the instrument has not.
  /// @throws std::invalid_argument  for no spectra.
  SetupModel(Instrument instrument, std::vector<CalibrationSpectrum> spectra,
             std::vector<SetupParameter> parameters, MirrorReference reference,
             std::shared_ptr<const FluxIntegrator> integrator);

  [[nodiscard]] const std::vector<SetupParameter>& parameters() const { return parameters_; }
  [[nodiscard]] const std::vector<CalibrationSpectrum>& spectra() const { return spectra_; }
  [[nodiscard]] const Instrument& instrument() const { return instrument_; }
  [[nodiscard]] MirrorReference reference() const { return reference_; }
  [[nodiscard]] Eigen::VectorXd assumed() const;  ///< shape (n_parameters)
  [[nodiscard]] Eigen::VectorXd range() const;    ///< shape (n_parameters)

  /// All spectra, one behind the other; infinite where a parameter leaves its range, or no light
  /// comes to the receptor that it is relative to. May be called from several threads.
  /// @param x  shape (n_parameters).
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& x) const;
  /// Its derivatives by central differences, shape (n, n_parameters).
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const;

  /// The instrument with those parameters.
  [[nodiscard]] Instrument instrument(const Eigen::VectorXd& x) const;
  /// One spectrum, as that instrument measures it.
  /// @throws InputError, std::domain_error  where it has no answer.
  [[nodiscard]] Eigen::ArrayXd spectrum(std::size_t i, const Instrument& instrument,
                                        double index_offset = 0.0) const;
  /// The share of the light of a perfect mirror that comes to the receptor.
  [[nodiscard]] double mirror_share(const Instrument& instrument,
                                    const std::string& geometry) const;

 private:
  Instrument instrument_;
  std::vector<CalibrationSpectrum> spectra_;
  std::vector<Sample> samples_;  // of the spectra, without deviation
  std::vector<SetupParameter> parameters_;
  MirrorReference reference_;
  std::shared_ptr<const FluxIntegrator> integrator_;
};

}  // namespace gonio
