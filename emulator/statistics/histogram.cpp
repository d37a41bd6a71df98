#include "emulator/statistics/histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gonio {
namespace {

constexpr std::int64_t most_bins = 256;
constexpr int smallest_exponent = -1074;  // of a double

// Rounds down, other than the division of C++.
std::int64_t half_of(std::int64_t index) { return index >> 1; }

}  // namespace

std::int64_t Histogram::index_of(double value) const {
  return std::int64_t(std::floor(std::ldexp(value, -exponent_)));
}

// The width is the smallest power of two with which all values so far fit: bins begin at its
// multiples, so that wider ones hold narrower ones as a whole and counts are exact in any order.
void Histogram::begin_bins(double other) {
  const double span = std::abs(std::ldexp(other, -8) - std::ldexp(only_value_, -8));
  exponent_ = span > 0.0 ? std::max(std::ilogb(span) - 1, smallest_exponent) : smallest_exponent;
  while (std::abs(index_of(other) - index_of(only_value_)) >= most_bins) {
    ++exponent_;
  }
  first_ = index_of(only_value_);
  counts_.assign(1, values_);
}

void Histogram::widen() {
  std::vector<std::uint64_t> wider;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const auto place = std::size_t(half_of(first_ + std::int64_t(i)) - half_of(first_));
    wider.resize(place + 1);
    wider[place] += counts_[i];
  }
  counts_ = std::move(wider);
  first_ = half_of(first_);
  ++exponent_;
}

void Histogram::add(double value) {
  if (!std::isfinite(value)) {
    throw std::domain_error(
        fmt::format("Histogram::add: expected a finite number, found {}", value));
  }
  if (values_ == 0) {
    only_value_ = value;
  }
  if (counts_.empty() && value == only_value_) {
    ++values_;
    return;
  }
  if (counts_.empty()) {
    begin_bins(value);
  }
  const auto count = [&] { return std::int64_t(counts_.size()); };
  // Compared as doubles: a far value has an index that no integer holds.
  const auto place = [&] { return std::floor(std::ldexp(value, -exponent_)) - double(first_); };
  while (place() >= double(most_bins) || double(count()) - place() > double(most_bins)) {
    widen();
  }
  const std::int64_t index = index_of(value);
  if (index < first_) {
    counts_.insert(counts_.begin(), std::size_t(first_ - index), 0);
    first_ = index;
  }
  counts_.resize(std::size_t(std::max(count(), index - first_ + 1)));
  ++counts_[std::size_t(index - first_)];
  ++values_;
}

Histogram::Bins Histogram::bins(std::size_t most) const {
  if (most == 0) {
    throw std::domain_error("Histogram::bins: expected one bin or more, found 0");
  }
  if (values_ == 0) {
    return {};
  }
  if (counts_.empty()) {
    return {.low = only_value_, .width = 0.0, .counts = {values_}};
  }
  const std::size_t joined = (counts_.size() + most - 1) / most;
  Bins result{.low = std::ldexp(double(first_), exponent_),
              .width = std::ldexp(double(joined), exponent_),
              .counts = std::vector<std::uint64_t>((counts_.size() + joined - 1) / joined)};
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    result.counts[i / joined] += counts_[i];
  }
  return result;
}

}  // namespace gonio
