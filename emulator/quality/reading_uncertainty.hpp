#pragma once

#include <optional>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio {

/// How uncertain the readings of one instrument in one channel are, at the gloss of the product.
struct ReadingUncertainty {
  /// Standard uncertainty of what all readings after one calibration share; 0 if not stated.
  double systematic = 0.0;
  double repeatability = 0.0;  ///< standard deviation of a reading, of instrument and display
  /// Of a panel's mean, k = 2: what decisions rest on. As the batch states, else of a reading as
  /// the instrument's file states; nothing if neither does.
  std::optional<double> expanded = {};
};

/// By instrument and channel, shape (n_instruments, n_channels), row-major.
using ReadingUncertainties = std::vector<ReadingUncertainty>;

/// At the gloss of `sample`. Of colours nothing is known: 0.
/// @param sample  the product; for measured readings the sample of effect_ladder() that reads most
///                like the limits is taken.
/// @throws InputError  at the batch's decision if it is guarded and an instrument that is to decide
///                     about limits has no U; at an instrument's file for an uncertainty that is
///                     stated in part.
[[nodiscard]] ReadingUncertainties reading_uncertainties(const Batch& batch,
                                                         const std::optional<Sample>& sample);

}  // namespace gonio
