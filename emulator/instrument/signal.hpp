#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/instrument/behaviour.hpp"

// The terms of an instrument's signal, each a function of time since power on, so that a day of
// drift costs no more than a second. The formulas stand with Behaviour. @param t_s  seconds, >= 0.

namespace gonio {

/// lamp(t), relative to a lamp that is warm and new; exactly 1 without losses.
[[nodiscard]] double lamp_factor(const Behaviour& behaviour, double t_s);

/// T(t), degrees Celsius.
[[nodiscard]] double temperature_c(const Behaviour& behaviour, double t_s);

/// e(g); 0 if the channel has no full scale.
[[nodiscard]] double linearity_error_gu(const Behaviour& behaviour, std::size_t channel,
                                        double gloss_gu);

/// The signal without noise. @param stray_light_gu  all of it, with that from outside.
[[nodiscard]] double clean_signal_gu(const Behaviour& behaviour, std::size_t channel,
                                     double gloss_gu, double stray_light_gu, double t_s);

/// A normal deviate of mean 0 and standard deviation 1, which depends on nothing but the arguments:
/// however time is split into steps, reading 17 has the noise of reading 17.
[[nodiscard]] double normal_noise(std::uint64_t seed, std::size_t channel, std::uint64_t reading);

}  // namespace gonio
