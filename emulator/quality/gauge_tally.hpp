#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/qa_result.hpp"
#include "emulator/quality/records.hpp"

namespace gonio {

/// Keeps the panels of a gauge study, of which there are few, until all have come.
class GaugeTally {
 public:
  explicit GaugeTally(const Batch& batch) : batch_(batch) {}

  void add(const PanelRecord& panel);
  /// The study of each channel in which two panels or more were read twice or more by all who read
  /// any; nothing of the others. What is not the same for all is left out: panels that an appraiser
  /// has not read, and repetitions that not all have.
  [[nodiscard]] std::vector<ChannelGauge> result() const;

 private:
  struct Cell {
    std::uint64_t panel = 1;
    std::size_t appraiser = 0;
    auto operator<=>(const Cell&) const = default;
  };
  using Cells = std::map<Cell, std::vector<double>>;

  [[nodiscard]] std::string appraiser_name(std::size_t appraiser) const;
  [[nodiscard]] std::optional<ChannelGauge> study(std::uint32_t channel, const Cells& cells) const;

  const Batch& batch_;
  std::map<std::uint32_t, Cells> channels_;
};

}  // namespace gonio
