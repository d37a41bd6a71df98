#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/records.hpp"

namespace gonio {

/// What is true of a lot, by channel.
struct LotTruth {
  std::vector<double> mean = {};    ///< of all that was made of it
  std::vector<double> sd = {};      ///< of its panels
  std::vector<double> beyond = {};  ///< share of its panels beyond the limits; 0 without limits
};

/// A channel in which lots, panels and readings are normal.
struct NormalComponents {
  double mean = 0.0;
  double sd_lots = 0.0, sd_panels = 0.0;
  double sd_readings = 0.0;  ///< within a panel, instrument and film together
};

/// Where panels come from. All depends on the number of the panel and nothing else; calls may come
/// from several threads.
class PanelSource {
 public:
  virtual ~PanelSource() = default;

  /// A panel of the inspection as it is read and judged, with its truth. Panels 1 to
  /// plan.panels are of lot 1, and so on.
  [[nodiscard]] virtual PanelRecord inspect(std::uint64_t number) const = 0;
  [[nodiscard]] virtual LotTruth truth(std::uint64_t lot) const = 0;
  /// What the numbers of a channel are drawn from, where that is as simple: then there are closed
  /// forms.
  [[nodiscard]] virtual std::optional<NormalComponents> normal_components(
      std::uint32_t /*channel*/) const {
    return std::nullopt;
  }
};

/// Makes the source of a batch that differs in its plan, spread, offset or seed from another one.
using PanelSourceFactory = std::function<std::unique_ptr<PanelSource>(const Batch&)>;

}  // namespace gonio
