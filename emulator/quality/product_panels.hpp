#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "emulator/quality/panel_judgement.hpp"
#include "emulator/quality/panel_source.hpp"
#include "emulator/quality/product_optics.hpp"
#include "emulator/quality/reading_places.hpp"

namespace gonio {

/// Panels of a product as its batch file describes it, read by its instruments.
///
/// Each lot and each panel deviates as a whole; within a panel the film is a normal random field
/// with a correlation exp(-d^2 / 2 L^2), of which a spot takes the average. A reading sees what its
/// spot covers, and is shown with what its instrument errs in that lot, with its operator's bias,
/// with noise, and in steps of the display. Panel n is read by appraiser (n - 1) % appraisers.
/// Where the reading rule asks for more readings, they are taken at the further positions.
class ProductPanels : public PanelSource {
 public:
  /// All must outlive this object. The offset and the spread may differ from those that the optics
  /// were made for, as far as their half width reaches.
  ProductPanels(const Batch& batch, const ProductOptics& optics,
                const ReadingUncertainties& uncertainties);

  [[nodiscard]] PanelRecord inspect(std::uint64_t number) const override;
  [[nodiscard]] LotTruth truth(std::uint64_t lot) const override;
  /// A panel of the gauge study: read in its middle by all appraisers.
  [[nodiscard]] PanelRecord gauge(std::uint64_t number) const;

 private:
  using Parameters = Eigen::Vector3d;  // in the order of sample_parameter_names

  /// A panel in the hands of an appraiser.
  struct Panel {
    std::size_t instrument = 0, person = 0;
    Eigen::Matrix3Xd deviation = {};     // by place
    std::vector<double> error = {};      // of the instrument, by channel
    std::span<const double> noise = {};  // by place and repetition
  };

  [[nodiscard]] Parameters deviation(std::span<const double> normal,
                                     Distribution ParameterSpread::*level) const;
  [[nodiscard]] Parameters of_lot(std::uint64_t lot) const;
  [[nodiscard]] Eigen::Matrix3Xd film(std::span<const double> normal,
                                      const ReadingPlaces& places) const;
  [[nodiscard]] std::vector<double> errors(std::uint64_t lot, std::size_t instrument,
                                           std::uint64_t stream) const;
  [[nodiscard]] double read(const Panel& panel, std::size_t place, double noise) const;
  void read_positions(const Panel& panel, std::size_t first, std::size_t end,
                      std::vector<ReadingRecord>& readings) const;
  [[nodiscard]] double true_value(std::uint32_t channel, const Parameters& deviation) const;
  [[nodiscard]] std::vector<double> true_values(const Parameters& deviation) const;
  void tell_truth(PanelRecord& panel, const Parameters& deviation) const;

  const Batch& batch_;
  const ProductOptics& optics_;
  const ReadingUncertainties& uncertainties_;
  PanelJudge judge_;
  std::vector<std::uint32_t> read_channels_ = {};  // all but haze
  std::size_t positions_ = 0;                      // with the further ones
  Eigen::Matrix3d mixing_;                         // lower factor of the parameters' correlation
  Eigen::Matrix3d within_, panels_;                // the same times standard deviations
  std::vector<ReadingPlaces> places_ = {};         // by instrument
  std::vector<SpotShare> whole_ = {};              // of a whole panel
};

}  // namespace gonio
