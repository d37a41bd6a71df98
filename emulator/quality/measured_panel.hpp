#pragma once

#include <string>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/records.hpp"

namespace gonio {

/// A panel while its readings come from a file.
struct MeasuredPanel {
  struct Place {
    int line = 0, column = 0;
  };
  PanelRecord record = {};
  std::vector<Place> places = {};  ///< of each reading

  /// Gives readings in the order of rows the positions 1, 2, ...: of each channel, instrument,
  /// operator and repetition on its own.
  void number_positions();
  /// @throws InputError  at the second of two readings that nothing tells apart.
  void expect_no_doubles(const Batch& batch, const std::string& file) const;
  /// @throws InputError  at the first row of the panel, if a channel has no reading.
  void expect_all_channels(const Batch& batch, const std::string& file) const;
};

}  // namespace gonio
