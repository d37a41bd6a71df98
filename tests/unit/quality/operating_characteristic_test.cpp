#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/quality/risk_study.hpp"
#include "emulator/statistics/sampling_plan.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/quality/normal_batch.hpp"
#include "tests/unit/quality/normal_source.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using Kind = AcceptanceRule::Kind;
using test::allows;
using test::batch_of;
using test::is_close;
using test::uncertainties_of;

const Interval both{.low = 80.0, .high = 90.0};
const std::size_t lots = test::trials(2000);

struct Model {
  std::string name = {};
  Kind kind = Kind::attributes;
  Interval limits = both;
  NormalComponents product = {.mean = 85.0, .sd_panels = 1.0};
  double systematic = 0.0;
  std::size_t instruments = 1;
  DecisionRule rule = DecisionRule::simple;
};

Batch batch_for(const Model& model) {
  Batch batch = batch_of(model.limits);
  batch.plan.panels = 9;
  batch.plan.repetitions = 4;
  batch.plan.accept = {.kind = model.kind, .nonconforming = 1, .k = 1.2};
  batch.instruments.assign(model.instruments, batch.instruments.front());
  batch.decision.rule = model.rule;
  return batch;
}

/// A product that is normal and does not say so.
class Unnamed : public NormalPanels {
 public:
  using NormalPanels::NormalPanels;
  [[nodiscard]] std::optional<NormalComponents> normal_components(
      std::uint32_t /*channel*/) const override {
    return std::nullopt;
  }
};

template <class Panels = NormalPanels>
OcCurve curve_of(const Model& model, std::size_t points = 11) {
  const Batch batch = batch_for(model);
  const ReadingUncertainties uncertainties =
      uncertainties_of(batch, {.systematic = model.systematic, .expanded = 1.0});
  return operating_characteristic(batch, uncertainties,
                                  {.channel = 0,
                                   .parameter = "mean",
                                   .low = -9.0,
                                   .high = 9.0,
                                   .points = points,
                                   .shifted =
                                       [&](double offset) {
                                         NormalProduct moved{{model.product}};
                                         moved.channels[0].mean += offset;
                                         return std::make_unique<Panels>(batch, uncertainties,
                                                                         moved);
                                       }},
                                  {.lots_per_point = lots});
}

/// Every model that has a closed form.
std::vector<Model> models() {
  const NormalComponents all{.mean = 85.0, .sd_lots = 0.8, .sd_panels = 1.0, .sd_readings = 1.0};
  return {
      {.name = "attributes, panels independent"},
      {.name = "attributes, guard band", .product = all, .rule = DecisionRule::guarded},
      {.name = "attributes, lots and errors", .product = all, .systematic = 0.6},
      {.name = "attributes, two instruments", .product = all, .systematic = 0.6, .instruments = 2},
      {.name = "mean", .kind = Kind::mean, .product = all, .systematic = 0.6, .instruments = 2},
      {.name = "mean, guard band",
       .kind = Kind::mean,
       .product = all,
       .rule = DecisionRule::guarded},
      {.name = "variables, panels independent", .kind = Kind::variables, .limits = {.low = 80.0}},
      {.name = "variables, lots and errors",
       .kind = Kind::variables,
       .limits = {.high = 88.0},
       .product = all,
       .systematic = 0.6,
       .rule = DecisionRule::guarded},
  };
}

TEST(OperatingCharacteristic, EqualsTheClosedFormWithinItsStatedError) {
  for (const Model& model : models()) {
    const OcCurve curve = curve_of(model);
    EXPECT_FALSE(curve.closed_form.empty()) << model.name;
    EXPECT_EQ(curve.lots, lots);
    ASSERT_EQ(curve.points.size(), 11U);
    for (const OcPoint& point : curve.points) {
      ASSERT_TRUE(point.exact) << model.name;
      EXPECT_TRUE(allows(point.accepted, lots, *point.exact))
          << model.name << " at " << point.mean << ": " << point.accepted.value << ", exact "
          << *point.exact;
    }
  }
}

// The closed form itself, where there is nothing to integrate over.
TEST(OperatingCharacteristic, IsBinomialNormalOrNoncentralT) {
  constexpr double rounding = 1e-12;
  for (const OcPoint& point : curve_of({}).points) {
    const double p = beyond_limits(point.mean, 1.0, both);
    EXPECT_TRUE(is_close(point.exact.value(), accepted_by_attributes(9, 1, p), rounding));
    EXPECT_TRUE(is_close(point.beyond, p, rounding));
    EXPECT_TRUE(is_close(point.mean, 85.0 + point.offset, rounding));
  }
  for (const OcPoint& point : curve_of({.kind = Kind::mean}).points) {
    EXPECT_TRUE(
        is_close(point.exact.value(), within_limits(point.mean, 1.0 / 3.0, both), rounding));
  }
  for (const OcPoint& point : curve_of({.kind = Kind::variables, .limits = {.low = 80.0}}).points) {
    EXPECT_TRUE(is_close(point.exact.value(),
                         accepted_by_variables(9, 1.2, point.mean, 1.0, {.low = 80.0}).value(),
                         rounding));
  }
}

TEST(OperatingCharacteristic, FallsOnBothSidesOfTheMiddle) {
  const OcCurve curve = curve_of({}, 21);
  EXPECT_EQ(curve.present_mean, 85.0);
  EXPECT_EQ(curve.points.front().offset, -9.0);
  EXPECT_EQ(curve.points.back().offset, 9.0);
  EXPECT_LT(curve.points.front().accepted.value, 0.01);
  EXPECT_LT(curve.points.back().accepted.value, 0.01);
  double last = 0.0;
  for (const OcPoint& point : curve.points) {
    if (point.offset <= 0.0) {
      EXPECT_GE(point.accepted.value, last);  // the same draws, moved as a whole
      last = point.accepted.value;
    }
  }
  EXPECT_GT(last, 0.99);
}

// The top lies in the middle of an even step, with the same acceptance at both of its ends.
TEST(OperatingCharacteristic, FindsItsTopAndThePresentProduct) {
  const Interval limits{.low = 87.3, .high = 90.7};
  const OcCurve curve = curve_of({.limits = limits}, 21);
  double top = 0.0;
  bool has_present = false;
  for (const OcPoint& point : curve.points) {
    top = std::max(top, point.exact.value());
    has_present = has_present || point.offset == 0.0;
  }
  EXPECT_TRUE(has_present);
  EXPECT_TRUE(is_close(top, accepted_by_attributes(9, 1, beyond_limits(89.0, 1.0, limits)), 1e-12));
}

TEST(OperatingCharacteristic, HasItsPointsWhereAcceptanceChanges) {
  const OcCurve curve = curve_of({.kind = Kind::mean}, 33);
  ASSERT_EQ(curve.points.size(), 33U);
  // All happens within a third of the range; even steps would put a third of the points there.
  std::size_t in_between = 0;
  double largest = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const OcPoint &a = curve.points[i - 1], &b = curve.points[i];
    EXPECT_LT(a.offset, b.offset);
    largest = std::max(largest, std::abs(a.accepted.value - b.accepted.value));
    in_between += std::abs(std::abs(b.offset) - 5.0) < 1.5 ? 1 : 0;
  }
  EXPECT_GE(in_between, 16U);
  EXPECT_LE(largest, 0.25);
}

TEST(OperatingCharacteristic, ComparesAnyProductWithTheNormalOneOfItsMoments) {
  const Model model{
      .product = {.mean = 85.0, .sd_lots = 0.8, .sd_panels = 1.0, .sd_readings = 1.0}};
  const OcCurve known = curve_of(model);
  const OcCurve seen = curve_of<Unnamed>(model);
  EXPECT_EQ(seen.closed_form, "binomial");
  // The mean of so many lots, of which all are 0.8 off: five times that.
  const double of_means = 5.0 * 0.8 / std::sqrt(double(lots));
  EXPECT_TRUE(is_close(seen.present_mean, 85.0, of_means));
  for (std::size_t i = 0; i < known.points.size(); ++i) {
    EXPECT_EQ(seen.points[i].accepted, known.points[i].accepted);
    EXPECT_TRUE(is_close(seen.points[i].mean, known.points[i].mean, of_means));
    // Acceptance changes by less than half over one unit of the mean.
    EXPECT_TRUE(is_close(seen.points[i].exact.value(), known.points[i].exact.value(), of_means));
  }
}

TEST(OperatingCharacteristic, HasNoClosedFormWhereThereIsNone) {
  const OcCurve curve = curve_of({.kind = Kind::variables, .limits = both});
  EXPECT_EQ(curve.closed_form, "");
  for (const OcPoint& point : curve.points) {
    EXPECT_FALSE(point.exact);
  }
}

TEST(OperatingCharacteristic, RefusesARangeThatIsNone) {
  const Batch batch = batch_of(both);
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  EXPECT_THROW((void)operating_characteristic(batch, uncertainties, {.low = 1.0, .high = 1.0}, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace gonio
