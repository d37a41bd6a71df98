#include "emulator/quality/panel_pipeline.hpp"

#include <algorithm>
#include <vector>

#include "emulator/core/parallel_for.hpp"

namespace gonio {

void compute_panels(std::uint64_t first, std::uint64_t last,
                    const std::function<PanelRecord(std::uint64_t)>& compute,
                    const std::function<void(std::span<const PanelRecord>)>& take,
                    std::uint64_t chunk) {
  constexpr std::uint64_t share = 8;  // panels that a thread computes at a time
  std::vector<PanelRecord> ready, next;
  while (first <= last || !ready.empty()) {
    next.resize(first <= last ? std::min(chunk, last - first + 1) : 0);
    const std::size_t shares = (next.size() + share - 1) / share;
    // The first body hands over, since bodies begin in about this order.
    parallel_for(shares + 1, [&](std::size_t body) {
      if (body == 0) {
        if (!ready.empty()) {
          take(ready);
        }
        return;
      }
      const std::size_t end = std::min(next.size(), body * share);
      for (std::size_t i = (body - 1) * share; i < end; ++i) {
        next[i] = compute(first + i);
      }
    });
    first += next.size();
    std::swap(ready, next);
  }
}

}  // namespace gonio
