#include "emulator/uncertainty/random.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "emulator/uncertainty/normal_quantile.hpp"

namespace gonio {

namespace {

constexpr std::size_t words = 4;  // draws that Philox gives at once

/// In the middle of one of 2^52 equal steps, so that neither 0 nor 1 comes about.
double in_open_interval(std::uint64_t bits) { return (double(bits >> 12U) + 0.5) * 0x1p-52; }

/// The uniform draws group * 4 .. group * 4 + 3.
std::array<double, words> four_draws(std::uint64_t seed, std::uint64_t stream, std::uint64_t trial,
                                     std::uint64_t group) {
  const r123::Philox4x64::ctr_type counter{{group, stream, trial, 0}};
  const r123::Philox4x64::key_type key{{seed, 0}};
  const auto bits = r123::Philox4x64()(counter, key);
  return {in_open_interval(bits[0]), in_open_interval(bits[1]), in_open_interval(bits[2]),
          in_open_interval(bits[3])};
}

}  // namespace

void Draws::uniform(std::span<double> values) const {
  for (std::size_t first = 0; first < values.size(); first += words) {
    const auto four = four_draws(seed_, stream_, trial_, first / words);
    std::copy_n(four.begin(), std::min(words, values.size() - first), values.data() + first);
  }
}

void Draws::normal(std::span<double> values) const {
  uniform(values);
  to_normal_quantile(values);
}

void uniform_draws(std::uint64_t seed, std::uint64_t stream, std::uint64_t first_trial,
                   Eigen::Ref<Eigen::ArrayXXd> values) {
  for (Eigen::Index column = 0; column < values.cols(); column += Eigen::Index(words)) {
    const Eigen::Index n = std::min(Eigen::Index(words), values.cols() - column);
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const auto four =
          four_draws(seed, stream, first_trial + std::uint64_t(i), std::uint64_t(column) / words);
      for (Eigen::Index j = 0; j < n; ++j) {
        values(i, column + j) = four[std::size_t(j)];
      }
    }
  }
}

void uniform_draws_of(std::uint64_t number, std::uint64_t seed, std::uint64_t stream,
                      std::uint64_t first_trial, std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = four_draws(seed, stream, first_trial + i, number / words)[number % words];
  }
}

}  // namespace gonio
