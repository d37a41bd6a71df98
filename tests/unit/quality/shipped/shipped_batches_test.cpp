#include <gtest/gtest.h>

#include "emulator/quality/batch_studies.hpp"
#include "emulator/quality/batch_summary.hpp"
#include "emulator/quality/measured_readings.hpp"
#include "emulator/quality/product_panels.hpp"
#include "tests/unit/quality/batch_text.hpp"
#include "tests/unit/quality/made_product.hpp"

// What the batches that ship come to.

namespace gonio {
namespace {

using enum ConformanceVerdict;

Batch shipped_batch(const std::string& id) {
  return load_batch(test::shipped().find(Catalog::Kind::batch, id), test::shipped());
}

QaResult inspected(const Batch& batch) {
  const auto uncertainties = reading_uncertainties(
      batch, load_sample(batch.product.value().sample, WavelengthGrid::visible()));
  const ProductOptics optics(batch, reach(batch), test::observer_1931());
  const ProductPanels panels(batch, optics, uncertainties);
  const PanelJudge judge(batch, uncertainties);
  BatchSummary summary(batch, judge);
  for (std::uint64_t number = 1; number <= batch.plan.lots * batch.plan.panels; ++number) {
    summary.add(panels.inspect(number));
  }
  return summary.result();
}

QaResult judged(const Batch& batch, const std::string& readings) {
  const auto uncertainties = reading_uncertainties(batch, {});
  const PanelJudge judge(batch, uncertainties);
  BatchSummary summary(batch, judge);
  for (PanelRecord& panel :
       load_measured_readings(test::shipped().fixture("measured/" + readings), batch)) {
    judge.judge(panel);
    summary.add(panel);
  }
  return summary.result();
}

TEST(ShippedBatches, CoilCoatingIsIn) {
  const QaResult result = inspected(shipped_batch("coil_coating_60"));
  EXPECT_EQ(result.verdict, pass);
  EXPECT_EQ(result.panels_passed, result.panels);
}

TEST(ShippedBatches, RoughCoilCoatingIsOut) {
  const QaResult result = inspected(shipped_batch("coil_coating_60_out"));
  EXPECT_EQ(result.verdict, fail);
  EXPECT_EQ(result.panels_failed, result.panels);
}

TEST(ShippedBatches, CoilCoatingNearItsLimitIsInconclusiveByItsGuardBandAlone) {
  Batch batch = shipped_batch("coil_coating_60_guard_band");
  const QaResult guarded = inspected(batch);
  EXPECT_EQ(guarded.verdict, inconclusive);
  EXPECT_EQ(guarded.panels_inconclusive, guarded.panels);
  batch.decision.rule = DecisionRule::simple;
  const QaResult simple = inspected(batch);
  EXPECT_EQ(simple.verdict, pass);
  EXPECT_EQ(simple.panels_passed, simple.panels);
}

TEST(ShippedBatches, ClearCoatScattersAsTenPanelsOfACarDid) {
  const QaResult result = inspected(shipped_batch("automotive_clearcoat_20"));
  EXPECT_EQ(result.verdict, pass);
  // The batch file names mean and standard deviation; they are met roughly, as it says.
  EXPECT_NEAR(result.channels.at(0).mean, 88.7, 1.0);
  EXPECT_NEAR(result.channels.at(0).standard_deviation, 0.95, 0.35);
}

TEST(ShippedBatches, WallPaintIsMatt) {
  const QaResult result = inspected(shipped_batch("wall_paint_85"));
  EXPECT_EQ(result.verdict, pass);
  EXPECT_NEAR(result.channels.at(0).mean, 2.2, 0.3);
  EXPECT_EQ(result.channels.at(0).uniformity[std::size_t(PanelVerdict::rejected)], 0u);
}

TEST(ShippedBatches, RealReadingsAreTooFewForAPass) {
  const QaResult result = judged(shipped_batch("bleskomer_export"), "bleskomer_export.txt");
  EXPECT_EQ(result.panels, 2u);
  EXPECT_EQ(result.readings, 2u);
  EXPECT_DOUBLE_EQ(result.channels.at(0).mean, (21.23 + 20.90) / 2);
  EXPECT_EQ(result.verdict, inconclusive);
  EXPECT_EQ(result.channels[0].uniformity[std::size_t(PanelVerdict::more_readings)], 2u);
}

TEST(ShippedBatches, InventedReadingsAreIn) {
  const QaResult result =
      judged(shipped_batch("coil_coating_60_measured"), "coil_coating_60_invented.csv");
  EXPECT_EQ(result.panels, 12u);
  EXPECT_EQ(result.readings, 36u);
  EXPECT_EQ(result.verdict, pass);
}

}  // namespace
}  // namespace gonio
