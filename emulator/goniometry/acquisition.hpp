#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/core/table.hpp"
#include "emulator/core/wavelength_grid.hpp"
#include "emulator/goniometry/counts.hpp"
#include "emulator/goniometry/reflectance_spectrum.hpp"

namespace gonio {

/// What the detector of a spectrometer can count.
struct Detector {
  double saturation = 65535.0;                     ///< counts from which on a pixel is full
  double linear_up_to = 65535.0;                   ///< counts beyond which it is no longer linear
  std::optional<double> read_noise = {};           ///< standard deviation of one reading, counts
  std::optional<double> electrons_per_count = {};  ///< for the noise of the light itself
};

/// Counts at one integration time.
struct TimedCounts {
  Counts counts;
  double time_s = 0.0;
  SourceMark mark = {};  ///< where it is named
};

/// The measurements of one geometry.
struct AcquiredGeometry {
  std::string id;
  TimedCounts mirror, sample;
  std::size_t mirror_dark = 0, sample_dark = 0;  ///< of Acquisition::darks
};

/// Spectrometer readings of a sample and a mirror, from a file of schema gonio/acquisition/1.
struct Acquisition {
  std::string id, title;
  std::string sample = {};  ///< what was measured; may be empty
  Detector detector = {};
  Eigen::ArrayXd wavelength_nm = {};  ///< of the pixels of all files, shape (n)
  WavelengthGrid grid = WavelengthGrid::visible();
  std::optional<SpectralTable> mirror_reflectance = {};  ///< nothing: 1
  std::vector<TimedCounts> darks = {};                   ///< one for each integration time
  std::vector<AcquiredGeometry> geometries = {};
};

/// @throws InputError  for anything that is not as the schema says; for counts on other pixels than
///                     the first file, or a measurement without a dark of its integration time.
[[nodiscard]] Acquisition load_acquisition(const std::filesystem::path& path);

/// The file of an acquisition: an existing path, or an id among the shipped ones.
/// @throws InputError  if there is none.
[[nodiscard]] std::filesystem::path find_acquisition(const std::string& id_or_path,
                                                     const Catalog& catalog);

/// How the uncertainty of counts was found.
enum class NoiseModel {
  repeats,   ///< standard error of the mean of each pixel, of ten repeats or more
  pooled,    ///< variance a + b * counts, over all pixels and files with repeats
  detector,  ///< read noise and electrons per count, as stated
  none       ///< not known
};

/// A spectrum relative to the mirror, and what became of its pixels.
struct AcquiredSpectrum {
  ReflectanceSpectrum spectrum;
  std::size_t saturated = 0;      ///< pixels left out because a repeat of sample or mirror was full
  std::size_t beyond_linear = 0;  ///< left out because one was beyond the linear range, not full
  std::size_t without_value = 0;  ///< bands of the grid
  std::size_t low_signal = 0;     ///< bands where the mirror is less than ten times its uncertainty
  std::size_t linear_bands = 0;   ///< bands between pixels that lie wider than the grid
  double signal_to_noise = 0.0;   ///< median of reflectance over u; 0 where u is not known
  double dynamic_range = 0.0;     ///< largest net count of the mirror over the noise of one dark
  double sample_share = 0.0, mirror_share = 0.0, dark_share = 0.0;  ///< of the mean variance
  bool shares_dark = false;  ///< sample and mirror have one dark: its errors cancel in part
};

struct AcquisitionResult {
  std::string id, title, sample;
  NoiseModel noise = NoiseModel::none;
  std::vector<AcquiredSpectrum> spectra = {};
  /// Geometries that share a file, as "20, 60": their errors go together, which u does not tell.
  std::vector<std::string> correlated = {};
};

/// Reflectance relative to the mirror,
///
///   rho = ((S - D_s) / t_s) / ((M - D_m) / t_m) * rho_mirror,
///
/// of the mean counts, resampled by band_weights before the ratio is taken, with the same pixels
/// for both. Its variance is that of the law of propagation with the variances of the means S, M
/// and D; a dark that both share enters once, by the sum of its two sensitivities. Neighbouring
/// bands share a pixel at most.
/// @throws InputError  where all pixels are saturated, or the mirror has no light in any band.
/// @see    [Mihalik] section 6; JCGM 100:2008, 5.1.2 and 5.2.2
[[nodiscard]] AcquisitionResult acquire(const Acquisition& acquisition);

}  // namespace gonio
