#include "emulator/instrument/signal.hpp"

#include <cmath>
#include <numbers>

namespace gonio {

namespace {

constexpr double reference_temperature_c = 23.0;
constexpr double heating_time_constant_s = 600.0;
constexpr double seconds_per_hour = 3600.0;

/// One step of the generator SplitMix64: a bijection that spreads every bit over all.
/// @see Steele, Lea, Flood, OOPSLA 2014
std::uint64_t spread(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

/// In (0, 1], so that its logarithm is finite.
double uniform(std::uint64_t bits) { return (double(bits >> 11) + 1.0) * 0x1p-53; }

}  // namespace

double lamp_factor(const Behaviour& b, double t_s) {
  const double cold = b.warm_up_s > 0.0 ? b.warm_up_loss * std::exp(-5.0 * t_s / b.warm_up_s) : 0.0;
  const double aged =
      b.drift_limit > 0.0
          ? -b.drift_limit * std::expm1(-b.drift_per_h * (t_s / seconds_per_hour) / b.drift_limit)
          : 0.0;
  return (1.0 - cold) * (1.0 - aged);
}

double temperature_c(const Behaviour& b, double t_s) {
  return b.ambient_c - b.self_heating_k * std::expm1(-t_s / heating_time_constant_s);
}

double linearity_error_gu(const Behaviour& b, std::size_t channel, double gloss_gu) {
  if (b.full_scale_gu.empty()) {
    return 0.0;
  }
  return 4.0 * b.linearity * gloss_gu * (1.0 - gloss_gu / b.full_scale_gu[channel]);
}

double clean_signal_gu(const Behaviour& b, std::size_t channel, double gloss_gu,
                       double stray_light_gu, double t_s) {
  const double temperature_factor =
      1.0 + b.signal_per_k * (temperature_c(b, t_s) - reference_temperature_c);
  return lamp_factor(b, t_s) * temperature_factor *
         (gloss_gu + linearity_error_gu(b, channel, gloss_gu) + stray_light_gu);
}

double normal_noise(std::uint64_t seed, std::size_t channel, std::uint64_t reading) {
  const std::uint64_t bits = spread(spread(spread(seed) + channel) + reading);
  const double radius = std::sqrt(-2.0 * std::log(uniform(bits)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(spread(bits)));
}

}  // namespace gonio
