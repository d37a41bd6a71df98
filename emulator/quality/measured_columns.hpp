#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/delimited_text.hpp"
#include "emulator/quality/batch.hpp"

namespace gonio {

/// Where a file of measured readings holds what: numbers of columns, from 0.
struct MeasuredColumns {
  struct OfChannel {
    std::uint32_t channel = 0;  ///< of Batch::channels
    std::size_t column = 0;
  };
  std::vector<std::string> names = {};  ///< of all columns
  std::array<std::optional<std::size_t>, measured_role_count> roles = {};
  std::vector<OfChannel> channels = {};  ///< none if each row is one reading
  std::optional<std::size_t> skip = {};  ///< of MeasuredFormat::Skip

  [[nodiscard]] std::optional<std::size_t> of(MeasuredRole role) const {
    return roles[std::size_t(role)];
  }
};

/// @throws InputError  at the header for a column that is missing, or there twice.
[[nodiscard]] MeasuredColumns find_columns(const std::vector<DelimitedCell>& header,
                                           const Batch& batch, const std::string& file);

}  // namespace gonio
