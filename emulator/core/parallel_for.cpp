#include "emulator/core/parallel_for.hpp"

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

/// Says at the end of a scope, an exception's way out included, that it ends before `order`.
struct EndsBefore {
  void* order;
  ~EndsBefore() { ends_before(order); }
};

/// Says at the end of a scope that what follows begins after `order`.
struct ThenBeginsAfter {
  void* order;
  ~ThenBeginsAfter() { begins_after(order); }
};

}  // namespace

namespace gonio {

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
  char begin = 0;
  char end = 0;
  const ThenBeginsAfter all_bodies{&end};
  ends_before(&begin);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    begins_after(&begin);
    const EndsBefore return_of_all{&end};
    body(i);
  });
}

}  // namespace gonio
