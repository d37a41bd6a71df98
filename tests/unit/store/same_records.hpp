#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "emulator/store/store.hpp"

// Equal to the last bit: == takes -0.0 for 0.0.

namespace gonio::test {

using Bits = std::vector<std::uint64_t>;

inline void append(Bits& bits, double number) {
  bits.push_back(std::bit_cast<std::uint64_t>(number));
}
inline void append(Bits& bits, const std::optional<double>& number) {
  bits.push_back(number.has_value() ? 1U : 0U);
  append(bits, number.value_or(0.0));
}

inline Bits bits_of(const PanelRecord& panel) {
  Bits bits;
  for (const ReadingRecord& reading : panel.readings) {
    append(bits, reading.value);
  }
  for (const ChannelResult& channel : panel.channels) {
    append(bits, channel.mean);
    append(bits, channel.range);
    append(bits, channel.standard_deviation);
    append(bits, channel.truth);
  }
  return bits;
}

inline Bits bits_of(const RunOutcome& outcome) {
  Bits bits;
  append(bits, outcome.producer_risk);
  append(bits, outcome.consumer_risk);
  for (const ChannelTrend& trend : outcome.channels) {
    append(bits, trend.mean);
    append(bits, trend.standard_deviation);
    for (const auto& number : {trend.low, trend.high, trend.cpk, trend.ppk}) {
      append(bits, number);
    }
  }
  return bits;
}

template <class Record>
testing::AssertionResult is_same(const Record& got, const Record& expected) {
  if (!(got == expected)) {
    return testing::AssertionFailure() << "the records differ";
  }
  return bits_of(got) == bits_of(expected)
             ? testing::AssertionSuccess()
             : testing::AssertionFailure() << "a number differs in its last bits";
}

inline std::vector<PanelRecord> panels_of(const Store& store, std::int64_t run,
                                          PanelRecord::Study study) {
  std::vector<PanelRecord> panels;
  store.for_each_panel(run, study, [&](const PanelRecord& panel) { panels.push_back(panel); });
  return panels;
}

inline void expect_panels(const Store& store, std::int64_t run,
                          const std::vector<PanelRecord>& expected) {
  ASSERT_FALSE(expected.empty());
  const PanelRecord::Study study = expected.front().study;
  EXPECT_EQ(store.panels(run, study), expected.size());
  const std::vector<PanelRecord> got = panels_of(store, run, study);
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_TRUE(is_same(got[i], expected[i])) << "panel " << expected[i].number;
  }
}

}  // namespace gonio::test
