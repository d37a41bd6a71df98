#include "emulator/uncertainty/normal_quantile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "emulator/core/multiversion.hpp"

namespace gonio {

namespace {

constexpr double split_q = 0.425;  // the central rational function holds up to there
constexpr double split_r = 5.0;    // and the first one of the tails

using Polynomial = std::array<double, 8>;  // the lowest power first

constexpr Polynomial centre_above{3.3871328727963666080e0, 1.3314166789178437745e2,
                                  1.9715909503065514427e3, 1.3731693765509461125e4,
                                  4.5921953931549871457e4, 6.7265770927008700853e4,
                                  3.3430575583588128105e4, 2.5090809287301226727e3};
constexpr Polynomial centre_below{1.0,
                                  4.2313330701600911252e1,
                                  6.8718700749205790830e2,
                                  5.3941960214247511077e3,
                                  2.1213794301586595867e4,
                                  3.9307895800092710610e4,
                                  2.8729085735721942674e4,
                                  5.2264952788528545610e3};
constexpr Polynomial tail_above{1.42343711074968357734e0,  4.63033784615654529590e0,
                                5.76949722146069140550e0,  3.64784832476320460504e0,
                                1.27045825245236838258e0,  2.41780725177450611770e-1,
                                2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr Polynomial tail_below{1.0,
                                2.05319162663775882187e0,
                                1.67638483018380384940e0,
                                6.89767334985100004550e-1,
                                1.48103976427480074590e-1,
                                1.51986665636164571966e-2,
                                5.47593808499534494600e-4,
                                1.05075007164441684324e-9};
constexpr Polynomial far_above{6.65790464350110377720e0,  5.46378491116411436990e0,
                               1.78482653991729133580e0,  2.96560571828504891230e-1,
                               2.65321895265761230930e-2, 1.24266094738807843860e-3,
                               2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr Polynomial far_below{1.0,
                               5.99832206555887937690e-1,
                               1.36929880922735805310e-1,
                               1.48753612908506148525e-2,
                               7.86869131145613259100e-4,
                               1.84631831751005468180e-5,
                               1.42151175831644588870e-7,
                               2.04426310338993978564e-15};

constexpr double value_of(const Polynomial& c, double x) {
  return ((((((c[7] * x + c[6]) * x + c[5]) * x + c[4]) * x + c[3]) * x + c[2]) * x + c[1]) * x +
         c[0];
}

double in_tail(double p) {
  const double r = std::sqrt(-std::log(std::min(p, 1.0 - p)));
  const double size = r <= split_r
                          ? value_of(tail_above, r - 1.6) / value_of(tail_below, r - 1.6)
                          : value_of(far_above, r - split_r) / value_of(far_below, r - split_r);
  return p < 0.5 ? -size : size;
}

/// For all, without branches; what lies in the tails is of no use.
GONIO_CLONES void in_centre(std::size_t n, const double* __restrict p, double* __restrict z) {
  for (std::size_t i = 0; i < n; ++i) {
    const double q = p[i] - 0.5;
    const double r = split_q * split_q - q * q;
    z[i] = q * value_of(centre_above, r) / value_of(centre_below, r);
  }
}

}  // namespace

void to_normal_quantile(std::span<double> values) {
  std::array<double, 512> p;
  for (std::size_t first = 0; first < values.size(); first += p.size()) {
    const std::size_t n = std::min(p.size(), values.size() - first);
    std::copy_n(values.data() + first, n, p.data());
    in_centre(n, p.data(), values.data() + first);
    for (std::size_t i = 0; i < n; ++i) {
      if (!(std::abs(p[i] - 0.5) <= split_q)) {
        values[first + i] = in_tail(p[i]);
      }
    }
  }
}

}  // namespace gonio
