#include "emulator/statistics/estimate.hpp"

#include <fmt/format.h>

#include <boost/math/special_functions/beta.hpp>
#include <stdexcept>

namespace gonio {

Estimate proportion(std::size_t successes, std::size_t trials, double confidence) {
  if (trials == 0 || successes > trials) {
    throw std::domain_error(
        fmt::format("proportion: expected successes among at least one trial, found {} of {}",
                    successes, trials));
  }
  if (!(confidence > 0.0 && confidence < 1.0)) {
    throw std::domain_error(
        fmt::format("proportion: expected confidence in (0, 1), found {}", confidence));
  }
  const double k = double(successes), n = double(trials);
  const double tail = (1.0 - confidence) / 2.0;
  return {.value = k / n,
          .low = successes == 0 ? 0.0 : boost::math::ibeta_inv(k, n - k + 1.0, tail),
          .high = successes == trials ? 1.0 : boost::math::ibetac_inv(k + 1.0, n - k, tail)};
}

}  // namespace gonio
