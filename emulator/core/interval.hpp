#pragma once

#include <optional>

namespace gonio {

/// The limits on one quantity, in its unit; nothing where there is none on that side.
struct Interval {
  std::optional<double> low = {}, high = {};

  bool operator==(const Interval&) const = default;
};

}  // namespace gonio
