#include "emulator/store/names.hpp"

#include <gtest/gtest.h>

#include "emulator/store/store.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

TEST(Names, LeadBackToTheirValues) {
  for (const auto kind : {RunRecord::Kind::simulated, RunRecord::Kind::measured}) {
    EXPECT_EQ(run_kind_of(run_kind_name(kind)), kind);
  }
  for (const auto kind : {BatchChannel::Kind::gloss, BatchChannel::Kind::colour_difference,
                          BatchChannel::Kind::haze}) {
    EXPECT_EQ(channel_kind_of(channel_kind_name(kind)), kind);
  }
  using enum ConformanceVerdict;
  for (const auto verdict : {pass, fail, inconclusive, not_applicable, skipped, error}) {
    EXPECT_EQ(verdict_of(verdict_name(verdict)), verdict);
  }
  for (const char* name : panel_verdict_names) {
    EXPECT_STREQ(panel_verdict_name(panel_verdict_of(name)), name);
  }
}

TEST(Names, OfNothingAreRefused) {
  for (const std::string name : {"", "Pass", "pass ", "glossy"}) {
    EXPECT_THROW(static_cast<void>(run_kind_of(name)), StoreError);
    EXPECT_THROW(static_cast<void>(channel_kind_of(name)), StoreError);
    EXPECT_THROW(static_cast<void>(verdict_of(name)), StoreError);
    EXPECT_THROW(static_cast<void>(panel_verdict_of(name)), StoreError);
  }
  EXPECT_EQ(test::message_of([] { static_cast<void>(channel_kind_of("glossy")); }),
            "the store is damaged: expected a kind of channel, found 'glossy'");
}

}  // namespace
}  // namespace gonio
