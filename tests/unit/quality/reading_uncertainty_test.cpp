#include "emulator/quality/reading_uncertainty.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "emulator/core/input_error.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/quality/made_batch.hpp"

namespace gonio {

namespace {

const std::filesystem::path fixtures = std::string(GONIO_SOURCE_DIR) + "/fixtures";

Instrument triangle_gloss() {
  return load_instrument(fixtures / "instruments/triangle_gloss.yaml", Catalog({GONIO_SOURCE_DIR}));
}

Sample semi_gloss() {
  return load_sample(fixtures / "samples/black_semi_gloss.yaml", WavelengthGrid::visible());
}

Batch stated_batch() {
  Batch batch = test::made_batch({"60"});
  batch.instruments = {triangle_gloss()};
  batch.decision.rule = DecisionRule::guarded;
  batch.requirements = {{.channel = 0, .limits = {.low = 48.0, .high = 56.0}}};
  return batch;
}

}  // namespace

// The file states 0.05 GU of repeatability and half a step of 0.1 GU of resolution; the rest of U
// is what readings share.
TEST(ReadingUncertainty, IsMadeOfWhatReadingsShareAndWhatTheyDoNot) {
  const ReadingUncertainty found = reading_uncertainties(stated_batch(), semi_gloss()).at(0);
  const double of_one_reading = std::hypot(0.05, 0.05 / std::sqrt(3.0));
  constexpr double rounding = 1e-4;  // 0.05 GU is a display's worth of the reading itself
  EXPECT_NEAR(std::pow(found.expanded.value() / 2.0, 2),
              std::pow(found.systematic, 2) + std::pow(of_one_reading, 2), rounding);
  EXPECT_NEAR(found.repeatability, of_one_reading, rounding);
  EXPECT_GT(found.systematic, 0.0);
}

TEST(ReadingUncertainty, OfTheBatchGoesBeforeThatOfTheInstrument) {
  Batch batch = stated_batch();
  batch.decision.expanded_uncertainty_gu = 0.7;
  EXPECT_EQ(reading_uncertainties(batch, semi_gloss()).at(0).expanded, 0.7);
}

// Without a product: at the sample of the ladder that reads most like the limits.
TEST(ReadingUncertainty, OfMeasuredReadingsIsThatOfASampleLikeTheLimits) {
  const double at_product =
      reading_uncertainties(stated_batch(), semi_gloss()).at(0).expanded.value();
  const double at_ladder =
      reading_uncertainties(stated_batch(), std::nullopt).at(0).expanded.value();
  // Lobes of another width feel the set-up more or less.
  EXPECT_GT(at_ladder, at_product / 3.0);
  EXPECT_LT(at_ladder, at_product * 3.0);
}

TEST(ReadingUncertainty, MustBeStatedForAGuardBand) {
  Batch batch = stated_batch();
  batch.instruments = {nominal_instrument(batch.standard)};
  batch.decision.mark = {.file = "batch.yaml", .line = 9, .column = 11};
  EXPECT_EQ(test::message_of([&] { (void)reading_uncertainties(batch, semi_gloss()); }),
            "batch.yaml:9:11: decision.expanded_uncertainty: expected an uncertainty, since " +
                batch.instruments.front().id + " states none, or `rule: simple`, found nothing");
  batch.decision.rule = DecisionRule::simple;
  EXPECT_FALSE(reading_uncertainties(batch, semi_gloss()).at(0).expanded);
}

TEST(ReadingUncertainty, OfHazeComesFromBothGeometries) {
  Batch batch = stated_batch();
  batch.channels = {{"20", "20", BatchChannel::Kind::gloss, "GU"},
                    {"60", "60", BatchChannel::Kind::gloss, "GU"},
                    {"haze", "", BatchChannel::Kind::haze, "GU"}};
  batch.requirements.clear();
  batch.decision.expanded_uncertainty_gu = 0.5;
  batch.standard.haze.resize(1);
  batch.standard.haze[0].id = "haze";
  batch.standard.haze[0].from = "60";
  batch.standard.haze[0].minus = "20";
  EXPECT_DOUBLE_EQ(reading_uncertainties(batch, semi_gloss()).at(2).expanded.value(),
                   0.5 * std::sqrt(2.0));
}

}  // namespace gonio
