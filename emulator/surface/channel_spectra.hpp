#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/core/wavelength_grid.hpp"
#include "emulator/measured/brdf_channel.hpp"

namespace gonio {

/// What a unit of each channel of a measured BRDF adds at each wavelength. The spectra sum to 1 at
/// all wavelengths, so that what is grey in its channels stays that grey.
///
/// - Wavelengths: linear between two channels, held constant beyond the first and the last.
/// - Luminance, or Y alone: all wavelengths alike.
/// - R, G and B, linear ones of Rec. 709 under D65: of all spectra that are not negative, sum to 1
///   and give back R, G and B for the observer of 1931, those of least slope (sum of squares).
/// - X, Y and Z, each relative to a white diffuser's under D65: those of R, G and B, through the
///   matrix of Rec. 709.
///
/// RGB and XYZ come back to 1e-5. Under CIE C times V(lambda) a unit of R, G and B gives 0.2161,
/// 0.7084 and 0.0756, where Rec. 709 has 0.2126, 0.7152 and 0.0722 under D65.
///
/// @return  shape (n_channels, n_lambda).
/// @throws std::invalid_argument  for channels that are not all of one of these kinds.
[[nodiscard]] Eigen::MatrixXd channel_spectra(const std::vector<BrdfChannel>& channels,
                                              const WavelengthGrid& grid);

}  // namespace gonio
