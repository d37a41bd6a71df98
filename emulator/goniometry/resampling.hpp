#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"

namespace gonio {

/// The weights with which pixels of a spectrometer make the mean spectral density of a band.
struct BandWeights {
  Eigen::Index first = 0;      ///< pixel of the first weight
  Eigen::ArrayXd weight = {};  ///< per nm; empty: the band has no value
  bool is_mean = true;         ///< else linear between two pixels
};

/// Resampling of counts by conservation. A pixel counts what falls between the middles to its
/// neighbours; its density [counts / nm] is that over its width. A band of the grid, half a step to
/// both sides of its wavelength, has the mean density of the pixels in it, each by the length of
/// its overlap, so that band sums hold: bands times their step add up to the counts of the pixels
/// that they cover. Where pixels lie wider than the step of the grid the density is linear between
/// their middles instead.
/// @param wavelength_nm  of the pixels, ascending, at least 2, shape (n).
/// @param is_valid       of each pixel, shape (n). A band of which less than half is covered by
///                       valid pixels has no value; nor has a linear one with an invalid neighbour.
/// @return  one for each wavelength of the grid.
/// @throws std::invalid_argument  for pixels that do not ascend, or other shapes.
[[nodiscard]] std::vector<BandWeights> band_weights(const Eigen::ArrayXd& wavelength_nm,
                                                    const std::vector<bool>& is_valid,
                                                    const WavelengthGrid& grid);

/// sum weight * counts: the mean density of the band. @param counts  of all pixels.
[[nodiscard]] double band_density(const BandWeights& band, const Eigen::ArrayXd& counts);
/// sum weight^2 * variance, of independent pixels.
[[nodiscard]] double band_variance(const BandWeights& band, const Eigen::ArrayXd& variance);

}  // namespace gonio
