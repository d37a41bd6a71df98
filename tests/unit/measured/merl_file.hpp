#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>

namespace gonio::test {

/// f_r [1/sr] of a channel at Rusinkiewicz' angles [rad].
using HalfVectorBrdf =
    std::function<double(double theta_h, double theta_d, double phi_d, int channel)>;

/// The bytes of a MERL file of a BRDF.
inline std::string merl_bytes(const HalfVectorBrdf& f_r,
                              std::array<std::int32_t, 3> counts = {90, 90, 180}) {
  constexpr std::array<double, 3> scale{1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
  const auto nodes = std::size_t(counts[0]) * std::size_t(counts[1]) * std::size_t(counts[2]);
  std::string bytes(12 + 3 * 8 * nodes, '\0');
  std::memcpy(bytes.data(), counts.data(), 12);
  char* at = bytes.data() + 12;
  for (int channel = 0; channel < 3; ++channel) {
    for (int h = 0; h < counts[0]; ++h) {
      for (int d = 0; d < counts[1]; ++d) {
        for (int p = 0; p < counts[2]; ++p, at += 8) {
          const double part = double(h) / counts[0];
          const double value =
              f_r(std::numbers::pi / 2.0 * part * part, std::numbers::pi / 2.0 * d / counts[1],
                  std::numbers::pi * p / counts[2], channel) /
              scale.at(std::size_t(channel));
          std::memcpy(at, &value, 8);
        }
      }
    }
  }
  return bytes;
}

}  // namespace gonio::test
