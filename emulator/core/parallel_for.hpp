#pragma once

#include <cstddef>
#include <functional>

namespace gonio {

/// Calls body(0) .. body(n - 1) on all cores, in no order, and returns when all are done. The first
/// exception of a body is thrown on; bodies not yet begun are then left out.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

}  // namespace gonio
