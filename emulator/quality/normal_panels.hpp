#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "emulator/quality/panel_judgement.hpp"
#include "emulator/quality/panel_source.hpp"
#include "emulator/quality/qa_result.hpp"

namespace gonio {

/// What is known of a product from its readings: normal distributions, by channel, independent of
/// each other. That of haze follows from its geometries: its own place is not asked.
struct NormalProduct {
  using OfChannel = NormalComponents;
  std::vector<OfChannel> channels = {};
};

/// Panels of such a product, with an error of measurement that all readings of an instrument in a
/// lot share, as its uncertainty states.
///
///   reading = mean + lot + panel + error(instrument, lot) + noise
///
/// The truth of a panel is mean + lot + panel: what varies within it averages out over all of it.
/// Panel n is read by appraiser (n - 1) % appraisers, and where the reading rule asks for more
/// readings, at all further positions. Operators have no bias here, and displays no steps: both are
/// in what the readings scatter already.
class NormalPanels : public PanelSource {
 public:
  /// The batch and the uncertainties must outlive this object.
  /// @throws std::invalid_argument  for a product of other channels than the batch has.
  NormalPanels(const Batch& batch, const ReadingUncertainties& uncertainties,
               NormalProduct product);

  [[nodiscard]] PanelRecord inspect(std::uint64_t number) const override;
  /// In closed form. Haze: of independent geometries, where the standard defines it for the mean.
  [[nodiscard]] LotTruth truth(std::uint64_t lot) const override;
  [[nodiscard]] std::optional<NormalComponents> normal_components(
      std::uint32_t channel) const override;

 private:
  [[nodiscard]] std::vector<double> lot_means(std::uint64_t lot) const;
  [[nodiscard]] std::vector<double> errors(std::uint64_t lot, std::size_t instrument) const;
  void read(PanelRecord& panel, std::span<const double> shown, std::size_t first,
            std::size_t end) const;
  void add_haze(std::vector<double>& truth) const;

  const Batch& batch_;
  const ReadingUncertainties& uncertainties_;
  PanelJudge judge_;
  NormalProduct product_;
  std::vector<std::uint32_t> read_channels_ = {};  // all but haze
};

/// The one that fits the readings of a run, by analysis of variance. What its instruments erred by
/// is in it: in the spread of lots what they shared, in that of readings their noise.
[[nodiscard]] NormalProduct normal_product(const QaResult& result);

}  // namespace gonio
