#include "emulator/procedure/parallel_for.hpp"

#include <tbb/parallel_for.h>

// oneTBB of the distribution is not built for ThreadSanitizer, which so does not see that it orders
// the bodies after the call and the return after the bodies. Those builds compile this file alone
// without the sanitizer and say the order here.
#ifdef GONIO_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace {

void begins_after(void* order) {
#ifdef GONIO_TSAN
  __tsan_acquire(order);
#else
  (void)order;
#endif
}

void ends_before(void* order) {
#ifdef GONIO_TSAN
  __tsan_release(order);
#else
  (void)order;
#endif
}

}  // namespace

namespace gonio {

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
  char begin = 0;
  char end = 0;
  ends_before(&begin);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    begins_after(&begin);
    body(i);
    ends_before(&end);
  });
  begins_after(&end);
}

}  // namespace gonio
