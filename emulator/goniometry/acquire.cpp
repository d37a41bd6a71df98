#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "emulator/goniometry/acquisition.hpp"
#include "emulator/goniometry/resampling.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// From so many repeats on each pixel speaks for itself: u is then known to about a quarter.
constexpr Index enough_repeats = 10;
/// The least that a reading in whole counts is uncertain by: rectangular.
constexpr double rounding_variance = 1.0 / 12.0;
/// A mirror of less than so many uncertainties makes a ratio that is far from normal.
constexpr double low_signal = 10.0;

/// The variance of one reading, a + b * counts.
struct Noise {
  NoiseModel model = NoiseModel::none;
  double a = 0.0, b = 0.0;
};

std::vector<const Counts*> all_counts(const Acquisition& acquisition) {
  std::vector<const Counts*> all;
  for (const TimedCounts& dark : acquisition.darks) {
    all.push_back(&dark.counts);
  }
  for (const AcquiredGeometry& geometry : acquisition.geometries) {
    all.push_back(&geometry.mirror.counts);
    all.push_back(&geometry.sample.counts);
  }
  return all;
}

ArrayXd mean_of(const Counts& counts) { return counts.repeats.rowwise().mean(); }

/// Sample variance of one reading, shape (n).
ArrayXd spread_of(const Counts& counts) {
  const Eigen::ArrayXXd away = counts.repeats.colwise() - mean_of(counts);
  return away.square().rowwise().sum() / double(counts.repeats.cols() - 1);
}

/// Least squares of variances over means, each weighted by its degrees of freedom.
Noise pooled_noise(const std::vector<const Counts*>& all, double saturation) {
  double w = 0.0;
  double wx = 0.0;
  double wy = 0.0;
  double wxx = 0.0;
  double wxy = 0.0;
  for (const Counts* counts : all) {
    if (counts->repeats.cols() < 2) {
      continue;
    }
    const ArrayXd x = mean_of(*counts);
    const ArrayXd y = spread_of(*counts);
    const double freedom = double(counts->repeats.cols() - 1);
    for (Index p = 0; p < x.size(); ++p) {
      if ((counts->repeats.row(p) < saturation).all()) {
        // A variance varies as its own square: that of the light as its counts.
        const double weight = freedom / std::pow(std::max(x(p), 0.0) + 100.0, 2.0);
        w += weight;
        wx += weight * x(p);
        wy += weight * y(p);
        wxx += weight * x(p) * x(p);
        wxy += weight * x(p) * y(p);
      }
    }
  }
  if (!(w > 0.0)) {
    return {};
  }
  const double determinant = w * wxx - wx * wx;
  const double slope =
      determinant > 1e-12 * w * wxx ? std::max(0.0, (w * wxy - wx * wy) / determinant) : 0.0;
  const double constant = (wy - slope * wx) / w;
  return constant > 0.0 ? Noise{NoiseModel::pooled, constant, slope}
                        : Noise{NoiseModel::pooled, 0.0, wx > 0.0 ? std::max(0.0, wy / wx) : 0.0};
}

Noise noise_of(const Acquisition& acquisition) {
  const std::vector<const Counts*> all = all_counts(acquisition);
  if (std::ranges::all_of(
          all, [](const Counts* one) { return one->repeats.cols() >= enough_repeats; })) {
    return {.model = NoiseModel::repeats};
  }
  const Noise pooled = pooled_noise(all, acquisition.detector.saturation);
  if (pooled.model != NoiseModel::none) {
    return pooled;
  }
  const Detector& detector = acquisition.detector;
  if (detector.read_noise || detector.electrons_per_count) {
    return {.model = NoiseModel::detector,
            .a = std::pow(detector.read_noise.value_or(0.0), 2.0),
            .b = detector.electrons_per_count ? 1.0 / *detector.electrons_per_count : 0.0};
  }
  return {};
}

/// A mean and its variance, shape (n).
struct MeanCounts {
  ArrayXd mean, variance;
};

/// @param dark  what no light counts: only what is above it is light, with noise of its own.
MeanCounts mean_counts(const Counts& counts, const Noise& noise) {
  MeanCounts result{.mean = mean_of(counts), .variance = {}};
  const double n = double(counts.repeats.cols());
  const ArrayXd one = noise.model == NoiseModel::repeats
                          ? spread_of(counts)
                          : ArrayXd(noise.a + noise.b * result.mean.max(0.0));
  result.variance = (one.max(rounding_variance)) / n;
  return result;
}

/// Pixels that are good in both measurements, and why others are not.
struct Pixels {
  std::vector<bool> is_valid = {};
  std::size_t saturated = 0, beyond_linear = 0;
};

Pixels pixels_of(const AcquiredGeometry& geometry, const Acquisition& acquisition) {
  const ArrayXd highest = geometry.mirror.counts.repeats.rowwise().maxCoeff().max(
      geometry.sample.counts.repeats.rowwise().maxCoeff());
  Pixels pixels;
  for (const double counts : highest) {
    const bool is_full = counts >= acquisition.detector.saturation;
    const bool is_beyond = !is_full && counts > acquisition.detector.linear_up_to;
    pixels.saturated += is_full ? 1 : 0;
    pixels.beyond_linear += is_beyond ? 1 : 0;
    pixels.is_valid.push_back(!is_full && !is_beyond);
  }
  if (std::ranges::none_of(pixels.is_valid, [](bool valid) { return valid; })) {
    throw InputError(geometry.sample.mark,
                     "a pixel within the linear range of the detector, in sample and mirror",
                     "none");
  }
  return pixels;
}

/// What enters the ratio of one geometry.
struct Readings {
  MeanCounts sample, mirror, sample_dark, mirror_dark;
  double t_sample = 0.0, t_mirror = 0.0;
  bool shares_dark = false;
};

/// One band of the ratio.
struct BandRatio {
  double ratio = 0.0;
  double mirror_over_u = 0.0;
  double of_sample = 0.0, of_mirror = 0.0, of_dark = 0.0;  ///< parts of its variance
};

BandRatio ratio_of(const BandWeights& band, const Readings& read) {
  const double sample =
      band_density(band, read.sample.mean - read.sample_dark.mean) / read.t_sample;
  const double mirror =
      band_density(band, read.mirror.mean - read.mirror_dark.mean) / read.t_mirror;
  const double by_sample = 1.0 / (mirror * read.t_sample);
  const double by_mirror = sample / mirror / (mirror * read.t_mirror);
  const auto part = [&](double sensitivity, const MeanCounts& counts) {
    return sensitivity * sensitivity * band_variance(band, counts.variance);
  };
  BandRatio result{.ratio = sample / mirror};
  result.of_sample = part(by_sample, read.sample);
  result.of_mirror = part(by_mirror, read.mirror);
  result.of_dark = read.shares_dark
                       ? part(by_sample - by_mirror, read.sample_dark)
                       : part(by_sample, read.sample_dark) + part(by_mirror, read.mirror_dark);
  const double u_mirror = std::sqrt(band_variance(band, read.mirror.variance) +
                                    band_variance(band, read.mirror_dark.variance)) /
                          read.t_mirror;
  result.mirror_over_u = mirror / u_mirror;
  return result;
}

double median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Collects the bands of a spectrum.
class SpectrumMaker {
 public:
  SpectrumMaker(const Acquisition& acquisition, AcquiredSpectrum& result)
      : lambda_(acquisition.grid.nanometres()),
        reflectance_of_mirror_(acquisition.mirror_reflectance
                                   ? acquisition.mirror_reflectance->sample(acquisition.grid)
                                   : ArrayXd::Ones(acquisition.grid.size())),
        result_(result) {}

  void add(Index j, const BandWeights& band, const Readings& read) {
    if (band.weight.size() == 0) {
      ++result_.without_value;
      return;
    }
    const BandRatio one = ratio_of(band, read);
    if (!(one.mirror_over_u > 1.0)) {  // no light of the lamp there
      ++result_.without_value;
      return;
    }
    result_.low_signal += one.mirror_over_u < low_signal ? 1 : 0;
    result_.linear_bands += band.is_mean ? 0 : 1;
    const double rho = reflectance_of_mirror_(j);
    wavelength_.push_back(lambda_(j));
    value_.push_back(one.ratio * rho);
    const double variance = one.of_sample + one.of_mirror + one.of_dark;
    u_.push_back(rho * std::sqrt(variance));
    result_.sample_share += one.of_sample / variance;
    result_.mirror_share += one.of_mirror / variance;
    result_.dark_share += one.of_dark / variance;
  }

  void finish(bool is_u_known) {
    const auto array = [](const std::vector<double>& values) {
      return ArrayXd(Eigen::Map<const ArrayXd>(values.data(), Index(values.size())));
    };
    result_.spectrum.wavelength_nm = array(wavelength_);
    result_.spectrum.reflectance = array(value_);
    const double n = std::max(1.0, double(value_.size()));
    for (double* share : {&result_.sample_share, &result_.mirror_share, &result_.dark_share}) {
      *share = is_u_known ? *share / n : 0.0;
    }
    if (is_u_known) {
      result_.spectrum.u = array(u_);
      std::vector<double> ratios;
      for (std::size_t j = 0; j < value_.size(); ++j) {
        ratios.push_back(value_[j] / u_[j]);
      }
      result_.signal_to_noise = median(std::move(ratios));
    }
  }

 private:
  ArrayXd lambda_, reflectance_of_mirror_;
  AcquiredSpectrum& result_;
  std::vector<double> wavelength_ = {}, value_ = {}, u_ = {};
};

AcquiredSpectrum spectrum_of(const AcquiredGeometry& geometry, const Acquisition& acquisition,
                             const Noise& noise) {
  const auto mean = [&](const TimedCounts& timed) { return mean_counts(timed.counts, noise); };
  const Readings read{.sample = mean(geometry.sample),
                      .mirror = mean(geometry.mirror),
                      .sample_dark = mean(acquisition.darks[geometry.sample_dark]),
                      .mirror_dark = mean(acquisition.darks[geometry.mirror_dark]),
                      .t_sample = geometry.sample.time_s,
                      .t_mirror = geometry.mirror.time_s,
                      .shares_dark = geometry.sample_dark == geometry.mirror_dark};
  const Pixels pixels = pixels_of(geometry, acquisition);
  AcquiredSpectrum result{.spectrum = {.geometry = geometry.id,
                                       .wavelength_nm = {},
                                       .reflectance = {},
                                       .mark = geometry.sample.mark},
                          .saturated = pixels.saturated,
                          .beyond_linear = pixels.beyond_linear,
                          .shares_dark = read.shares_dark};
  const auto bands = band_weights(acquisition.wavelength_nm, pixels.is_valid, acquisition.grid);
  SpectrumMaker maker(acquisition, result);
  for (std::size_t j = 0; j < bands.size(); ++j) {
    maker.add(Index(j), bands[j], read);
  }
  maker.finish(noise.model != NoiseModel::none);
  if (result.spectrum.wavelength_nm.size() == 0) {
    throw InputError(geometry.mirror.mark, "light of the mirror in a band of the grid", "none");
  }
  const Counts& dark = acquisition.darks[geometry.mirror_dark].counts;
  const double one_reading =
      std::sqrt(read.mirror_dark.variance.mean() * double(dark.repeats.cols()));
  result.dynamic_range = noise.model == NoiseModel::none
                             ? 0.0
                             : (read.mirror.mean - read.mirror_dark.mean).maxCoeff() / one_reading;
  return result;
}

/// Geometries by the files that they share.
std::vector<std::string> correlated_of(const Acquisition& acquisition) {
  std::map<std::string, std::vector<std::string>> by_file;
  for (const AcquiredGeometry& geometry : acquisition.geometries) {
    std::vector<std::string> files{geometry.mirror.counts.mark.file,
                                   geometry.sample.counts.mark.file,
                                   acquisition.darks[geometry.mirror_dark].counts.mark.file,
                                   acquisition.darks[geometry.sample_dark].counts.mark.file};
    std::ranges::sort(files);
    files.erase(std::unique(files.begin(), files.end()), files.end());
    for (const std::string& file : files) {
      by_file[file].push_back(geometry.id);
    }
  }
  std::vector<std::string> groups;
  for (const auto& [file, ids] : by_file) {
    const std::string group = fmt::format("{}", fmt::join(ids, ", "));
    if (ids.size() > 1 && std::ranges::find(groups, group) == groups.end()) {
      groups.push_back(group);
    }
  }
  return groups;
}

}  // namespace

AcquisitionResult acquire(const Acquisition& acquisition) {
  const Noise noise = noise_of(acquisition);
  AcquisitionResult result{.id = acquisition.id,
                           .title = acquisition.title,
                           .sample = acquisition.sample,
                           .noise = noise.model,
                           .correlated = correlated_of(acquisition)};
  for (const AcquiredGeometry& geometry : acquisition.geometries) {
    result.spectra.push_back(spectrum_of(geometry, acquisition, noise));
  }
  return result;
}

}  // namespace gonio
