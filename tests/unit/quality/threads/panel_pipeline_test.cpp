#include "emulator/quality/panel_pipeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace gonio {

namespace {

PanelRecord numbered(std::uint64_t number) { return {.number = number}; }

}  // namespace

TEST(ComputePanels, HandsOverAllPanelsInOrder) {
  for (const std::uint64_t last : {1U, 7U, 8U, 16U, 17U, 100U}) {
    std::vector<std::uint64_t> taken;
    std::size_t largest = 0;
    compute_panels(
        1, last, numbered,
        [&](std::span<const PanelRecord> chunk) {
          largest = std::max(largest, chunk.size());
          for (const PanelRecord& panel : chunk) {
            taken.push_back(panel.number);
          }
        },
        16);
    std::vector<std::uint64_t> expected(last);
    std::iota(expected.begin(), expected.end(), 1U);
    EXPECT_EQ(taken, expected);
    EXPECT_LE(largest, 16U);
  }
}

TEST(ComputePanels, GoesOnWhereItIsTold) {
  std::vector<std::uint64_t> taken;
  compute_panels(5, 7, numbered, [&](std::span<const PanelRecord> chunk) {
    for (const PanelRecord& panel : chunk) {
      taken.push_back(panel.number);
    }
  });
  EXPECT_THAT(taken, testing::ElementsAre(5U, 6U, 7U));
}

TEST(ComputePanels, DoesNothingForNone) {
  compute_panels(
      4, 3, [](std::uint64_t) -> PanelRecord { throw std::logic_error("nothing to compute"); },
      [](std::span<const PanelRecord>) { FAIL(); });
}

// A store that is full ends the work within two chunks.
TEST(ComputePanels, EndsWithWhatTheTakerThrows) {
  std::atomic<std::uint64_t> computed = 0;
  EXPECT_THROW(compute_panels(
                   1, 1'000'000,
                   [&](std::uint64_t number) {
                     ++computed;
                     return numbered(number);
                   },
                   [](std::span<const PanelRecord>) { throw std::runtime_error("full"); }, 16),
               std::runtime_error);
  EXPECT_LE(computed, 32U);
}

TEST(ComputePanels, EndsWithWhatAPanelThrows) {
  EXPECT_THROW(compute_panels(
                   1, 100,
                   [](std::uint64_t number) {
                     if (number == 50) {
                       throw std::domain_error("50");
                     }
                     return numbered(number);
                   },
                   [](std::span<const PanelRecord>) {}, 16),
               std::domain_error);
}

}  // namespace gonio
