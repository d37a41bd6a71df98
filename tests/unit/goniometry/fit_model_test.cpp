#include "emulator/goniometry/fit_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

void expect_starts_in_range(const FittableModel& model) {
  for (const FitParameter& parameter : model.parameters) {
    for (const FitValues& start : model.starts) {
      if (parameter.scale != FitParameter::Scale::amplitude) {
        EXPECT_GT(start.at(parameter.name), parameter.low) << model.name;
        EXPECT_LT(start.at(parameter.name), parameter.high) << model.name;
      }
    }
  }
}

TEST(FittableModels, StartWithinTheRangesOfTheirParameters) {
  for (const FittableModel& model : fittable_models()) {
    expect_starts_in_range(model);
    expect_starts_in_range(with_free_index(model));
  }
}

TEST(FittableModels, AreListedWhereOneIsUnknown) {
  EXPECT_THAT(message_of([] { (void)fittable_model("phong"); }),
              testing::AllOf(testing::HasSubstr("cook_torrance, ggx, ward"),
                             testing::HasSubstr("found 'phong'")));
}

}  // namespace
}  // namespace gonio::test
