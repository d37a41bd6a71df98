#include "emulator/quality/batch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulator/core/text_file.hpp"
#include "tests/unit/quality/batch_text.hpp"

namespace gonio {
namespace {

using test::batch_error;
using test::batch_of;
using test::batch_text;
using test::batch_with;
using testing::ElementsAre;
using testing::StartsWith;

std::vector<std::string> channel_ids(const Batch& batch) {
  std::vector<std::string> ids;
  for (const BatchChannel& channel : batch.channels) {
    ids.push_back(channel.id);
  }
  return ids;
}

TEST(LoadBatch, ReadsWhatItNames) {
  const Batch batch = batch_of(batch_text);
  EXPECT_EQ(batch.id, "made");
  EXPECT_EQ(batch.title, "Made for a test");
  EXPECT_EQ(batch.standard.id, "iso_2813/2014");
  EXPECT_EQ(batch.product.value().sample.filename(), "black_semi_gloss.yaml");
  EXPECT_EQ(batch.instruments[0].id, "triangle_gloss");
  EXPECT_EQ(batch.instruments[1].id, "pocket_gloss_60");
  EXPECT_EQ(batch.operators[0].id, "anna");
  EXPECT_EQ(batch.appraisers(), 2u);
}

TEST(LoadBatch, LeavesTheRestAtItsDefaults) {
  const Batch batch = batch_of(
      "schema: gonio/batch/1\nid: a\ntitle: A\nstandard: iso_2813/2014\n"
      "specification: {gloss: {\"60\": \">= 40 GU\"}}\n");
  EXPECT_EQ(batch.notes, "");
  EXPECT_EQ(batch.seed, 1u);
  EXPECT_FALSE(batch.product);
  EXPECT_FALSE(batch.gauge);
  EXPECT_FALSE(batch.measured);
  EXPECT_EQ(batch.control_baseline, 100u);
  EXPECT_EQ(batch.instruments.at(0).id, "nominal");
  EXPECT_EQ(batch.operators.at(0).id, "operator");
  EXPECT_EQ(batch.decision.rule, DecisionRule::guarded);
  EXPECT_EQ(batch.decision.guard_band_factor, 1.0);
  EXPECT_FALSE(batch.decision.expanded_uncertainty_gu);
  EXPECT_EQ(batch.decision.mark.line, 1);
}

TEST(LoadBatch, ReadsOperatorsWithAndWithoutTheirErrors) {
  const Batch batch =
      batch_with("[anna]", "[{id: Anna K., bias: -0.05 GU, repeatability: 0.1 GU}, ben]");
  EXPECT_EQ(batch.operators.at(0).id, "Anna K.");
  EXPECT_EQ(batch.operators[0].bias_gu, -0.05);
  EXPECT_EQ(batch.operators[0].repeatability_gu, 0.1);
  EXPECT_EQ(batch.operators.at(1).id, "ben");
  EXPECT_EQ(batch.operators[1].bias_gu, 0.0);
}

TEST(LoadBatch, ReadsHowDecisionsAreMade) {
  const Batch batch = batch_with("{rule: simple}",
                                 "{rule: guarded, guard_band: 0.5, expanded_uncertainty: 0.6 GU}");
  EXPECT_EQ(batch.decision.rule, DecisionRule::guarded);
  EXPECT_EQ(batch.decision.guard_band_factor, 0.5);
  EXPECT_EQ(batch.decision.expanded_uncertainty_gu, 0.6);
  EXPECT_EQ(batch.decision.mark.line, 12);
  EXPECT_EQ(batch_of(batch_text).decision.rule, DecisionRule::simple);
}

TEST(LoadBatch, ReadsStudiesAndTheSeed) {
  const Batch batch = batch_of(batch_text +
                               "gauge_study: {panels: 5, repetitions: 2}\n"
                               "control_chart: {baseline: 20}\nseed: 2813\nnotes: some\n");
  EXPECT_EQ(batch.gauge.value().panels, 5u);
  EXPECT_EQ(batch.gauge.value().repetitions, 2u);
  EXPECT_EQ(batch.control_baseline, 20u);
  EXPECT_EQ(batch.seed, 2813u);
  EXPECT_EQ(batch.notes, "some");
  EXPECT_EQ(batch_of(batch_text + "gauge_study: {}\n").gauge.value().panels, 10u);
}

TEST(LoadBatch, FindsTheRequirementOfAChannel) {
  const Batch batch = batch_with("[triangle_gloss, pocket_gloss_60]",
                                 "[triangle_gloss], geometries: [\"20\", \"60\"]");
  ASSERT_THAT(channel_ids(batch), ElementsAre("20", "60"));
  EXPECT_EQ(batch.requirement(0), nullptr);
  EXPECT_EQ(batch.requirement(1)->limits, (Interval{.low = 46.0, .high = 58.0}));
  EXPECT_EQ(batch.requirement(1)->target, 52.0);
  EXPECT_EQ(batch.requirement(1)->mark.line, 9);
}

TEST(LoadBatch, ReadsFilesBesideItself) {
  const test::TemporaryFolder folder;
  const auto sample = folder.file(
      "mine.yaml", read_text_file(test::source_tree / "fixtures/samples/black_semi_gloss.yaml"));
  const auto file =
      folder.file("batch.yaml", test::replaced(batch_text, "black_semi_gloss", "mine.yaml"));
  EXPECT_EQ(load_batch(file, test::shipped()).product.value().sample, sample);
}

TEST(LoadBatch, SaysWhatItDoesNotKnow) {
  EXPECT_EQ(batch_error("batch/1", "batch/2"),
            "1:9: schema: expected gonio/batch/1, found 'gonio/batch/2'");
  EXPECT_THAT(batch_error("iso_2813/2014", "iso_2813/2099"),
              StartsWith("4:11: standard: expected a standard file, or one of the ids "));
  EXPECT_THAT(batch_error("black_semi_gloss", "black"),
              StartsWith("6:11: product.sample: expected a sample file, or one of the ids "));
  EXPECT_THAT(batch_error("triangle_gloss", "square_gloss"),
              StartsWith("11:27: measuring.instruments[0]: expected an instrument file, or one of "
                         "the ids "));
  EXPECT_THAT(batch_error("title", "titel"), StartsWith("1:1: title: expected the key 'title'"));
  EXPECT_THAT(batch_error(batch_text + "plan: 1\n"), StartsWith("13:1: plan: expected one of "));
}

TEST(LoadBatch, NeedsInstrumentsThatHaveEachGeometry) {
  EXPECT_EQ(batch_error("60 deg", "20 deg"),
            "11:43: measuring.instruments[1]: expected an instrument that has the geometry 20, "
            "found 'pocket_gloss_60'");
}

TEST(LoadBatch, TakesEachInstrumentAndOperatorOnce) {
  EXPECT_EQ(batch_error("pocket_gloss_60", "triangle_gloss"),
            "11:43: measuring.instruments[1]: expected each instrument once, found "
            "'triangle_gloss a second time'");
  EXPECT_EQ(batch_error("[anna]", "[anna, {id: anna}]"),
            "11:79: measuring.operators[1]: expected each operator once, found 'anna a second "
            "time'");
}

TEST(LoadBatch, RefusesNumbersOutsideTheirRange) {
  EXPECT_EQ(batch_error("[anna]", "[{id: anna, repeatability: -1 GU}]"),
            "11:99: measuring.operators[0].repeatability: expected a gloss value (GU) >= 0, "
            "found '-1 GU'");
  EXPECT_EQ(batch_error("rule: simple", "guard_band: -1"),
            "12:24: decision.guard_band: expected a number >= 0, found '-1'");
  EXPECT_EQ(batch_error("rule: simple", "rule: kind"),
            "12:18: decision.rule: expected one of guarded, simple, found 'kind'");
  EXPECT_EQ(batch_error(batch_text + "seed: -1\n"),
            "13:7: seed: expected a whole number in [0, 2147483647], found '-1'");
  EXPECT_EQ(batch_error(batch_text + "gauge_study: {panels: 1}\n"),
            "13:23: gauge_study.panels: expected a whole number in [2, 10000], found '1'");
  EXPECT_EQ(batch_error(batch_text + "gauge_study: {repetitions: 1}\n"),
            "13:28: gauge_study.repetitions: expected a whole number in [2, 1000], found '1'");
  EXPECT_EQ(batch_error(batch_text + "control_chart: {baseline: 1}\n"),
            "13:27: control_chart.baseline: expected a whole number in [2, 1000000], found '1'");
}

TEST(ShippedBatches, AreCalledAsTheirFilesAndReadable) {
  const auto batches = test::shipped().list(Catalog::Kind::batch);
  EXPECT_GE(batches.size(), 7u);
  for (const Catalog::Entry& entry : batches) {
    const Batch batch = load_batch(entry.file, test::shipped());
    EXPECT_EQ(batch.id, entry.id);
    EXPECT_FALSE(batch.notes.empty()) << entry.id;
    EXPECT_LE(batch.plan.lots * batch.plan.panels, 60u) << entry.id;
  }
}

TEST(ShippedBatches, AreFoundById) {
  EXPECT_EQ(test::shipped().find(Catalog::Kind::batch, "wall_paint_85").filename(),
            "wall_paint_85.yaml");
  EXPECT_THAT(
      test::message_of([] { (void)test::shipped().find(Catalog::Kind::batch, "wall_paint"); }),
      testing::AllOf(StartsWith("wall_paint: expected a batch file, or one of the ids "),
                     testing::HasSubstr("coil_coating_60, ")));
}

}  // namespace
}  // namespace gonio
