#include "emulator/quality/acceptance_probability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "emulator/statistics/sampling_plan.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/quality/normal_batch.hpp"

namespace gonio {
namespace {

using Kind = AcceptanceRule::Kind;
using test::batch_of;
using test::is_close;
using test::uncertainties_of;

/// As the class says.
constexpr double stated_error = 1e-9;
constexpr double pi = std::numbers::pi;

Batch batch_by(Kind kind, std::uint64_t panels, const Interval& limits) {
  Batch batch = batch_of(limits);
  batch.plan.panels = panels;
  batch.plan.accept.kind = kind;
  return batch;
}

double accepted(const Batch& batch, const ReadingUncertainty& each,
                const NormalComponents& product) {
  const ReadingUncertainties uncertainties = uncertainties_of(batch, each);
  return AcceptanceProbability(batch, uncertainties, 0)(product).value();
}

// By attributes.

TEST(AcceptanceProbability, IsBinomialWherePanelsAreIndependent) {
  for (const std::uint64_t panels : {1U, 5U, 50U}) {
    for (const std::uint64_t c : {0U, 1U, 4U}) {
      Batch batch = batch_by(Kind::attributes, panels, {.low = 80.0, .high = 90.0});
      batch.plan.accept.nonconforming = c;
      batch.plan.repetitions = 4;
      const NormalComponents product{.mean = 87.0, .sd_panels = 1.5, .sd_readings = 2.0};
      const double p = beyond_limits(87.0, std::hypot(1.5, 1.0), {.low = 80.0, .high = 90.0});
      EXPECT_TRUE(is_close(accepted(batch, {}, product), accepted_by_attributes(panels, c, p),
                           stated_error));
    }
  }
}

TEST(AcceptanceProbability, CountsWhatIsInTheGuardBandAsNotAccepted) {
  Batch batch = batch_by(Kind::attributes, 1, {.low = 80.0});
  batch.decision = {.rule = DecisionRule::guarded, .guard_band_factor = 0.5};
  EXPECT_TRUE(is_close(accepted(batch, {.expanded = 2.0}, {.mean = 82.0, .sd_panels = 1.0}),
                       within_limits(82.0, 1.0, {.low = 81.0}), stated_error));
}

// Where all is at the limit on average, the signs of normal values decide: all of two are positive
// with 1/4 + asin(rho) / 2 pi, all of three with 1/8 + 3 asin(rho) / 4 pi.
TEST(AcceptanceProbability, KnowsThatPanelsShareTheirLotAndTheirInstrument) {
  for (const double shared : {0.0, 0.1, 1.0, 10.0}) {
    const double rho = 2.0 * shared * shared / (2.0 * shared * shared + 1.0);
    const NormalComponents product{.mean = 80.0, .sd_lots = shared, .sd_panels = 1.0};
    const ReadingUncertainty error{.systematic = shared};
    const auto of_panels = [&](std::uint64_t n) {
      return accepted(batch_by(Kind::attributes, n, {.low = 80.0}), error, product);
    };
    EXPECT_TRUE(is_close(of_panels(1), 0.5, stated_error));
    EXPECT_TRUE(is_close(of_panels(2), 0.25 + std::asin(rho) / (2.0 * pi), stated_error));
    EXPECT_TRUE(is_close(of_panels(3), 0.125 + 0.75 * std::asin(rho) / pi, stated_error));
  }
}

TEST(AcceptanceProbability, KnowsThatInstrumentsErrApart) {
  for (const double error : {0.0, 1.0, 10.0}) {
    const NormalComponents product{.mean = 80.0, .sd_lots = 2.0, .sd_panels = 1.0};
    Batch batch = batch_by(Kind::attributes, 2, {.low = 80.0});
    batch.instruments.push_back(batch.instruments.front());
    const double rho = 4.0 / (5.0 + error * error);
    EXPECT_TRUE(is_close(accepted(batch, {.systematic = error}, product),
                         0.25 + std::asin(rho) / (2.0 * pi), stated_error));
    // One of two: not both negative.
    batch.plan.accept.nonconforming = 1;
    EXPECT_TRUE(is_close(accepted(batch, {.systematic = error}, product),
                         0.75 - std::asin(rho) / (2.0 * pi), stated_error));
  }
}

// Nine panels of which each instrument reads a part: as if one had read them all.
TEST(AcceptanceProbability, CountsThePanelsOfAllInstrumentsTogether) {
  for (const double mean : {79.0, 80.5, 83.0}) {
    Batch batch = batch_by(Kind::attributes, 9, {.low = 80.0});
    batch.instruments.assign(4, batch.instruments.front());
    batch.plan.accept.nonconforming = 5;
    const double p = beyond_limits(mean, 1.0, {.low = 80.0});
    EXPECT_TRUE(is_close(accepted(batch, {}, {.mean = mean, .sd_panels = 1.0}),
                         accepted_by_attributes(9, 5, p), stated_error));
  }
}

// Three panels by two instruments: two are read by one of them, and which alternates.
TEST(AcceptanceProbability, AveragesOverWhichInstrumentBegins) {
  Batch batch = batch_by(Kind::attributes, 3, {.low = 80.0});
  batch.instruments.push_back(batch.instruments.front());
  const NormalComponents product{.mean = 80.5, .sd_panels = 1.0};
  ReadingUncertainties uncertainties = uncertainties_of(batch);
  batch.decision.rule = DecisionRule::guarded;
  uncertainties[0].expanded = 1.0;
  uncertainties[1].expanded = 0.0;
  const double strict = within_limits(80.5, 1.0, {.low = 81.0});
  const double lax = within_limits(80.5, 1.0, {.low = 80.0});
  EXPECT_TRUE(is_close(AcceptanceProbability(batch, uncertainties, 0)(product).value(),
                       0.5 * strict * lax * (strict + lax), stated_error));
}

TEST(AcceptanceProbability, ShiftsWhatAnInstrumentReadsByItsBias) {
  Batch batch = batch_by(Kind::attributes, 2, {.low = 80.0});
  batch.instruments.push_back(batch.instruments.front());
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const NormalComponents product{.mean = 80.5, .sd_panels = 1.0};
  const auto within = [](double mean, double sd) { return within_limits(mean, sd, {.low = 80.0}); };
  EXPECT_TRUE(is_close(AcceptanceProbability(batch, uncertainties, 0)(product, {0.5, -1.0}).value(),
                       within(81.0, 1.0) * within(79.5, 1.0), stated_error));
  batch.plan.accept.kind = Kind::mean;
  EXPECT_TRUE(is_close(AcceptanceProbability(batch, uncertainties, 0)(product, {0.5, -1.0}).value(),
                       within(80.25, std::sqrt(0.5)), stated_error));
  batch.instruments.pop_back();
  for (const Kind kind : {Kind::attributes, Kind::mean, Kind::variables}) {
    batch.plan.accept.kind = kind;
    const AcceptanceProbability of(batch, uncertainties, 0);
    EXPECT_TRUE(is_close(of(product, {0.7}).value(), of({.mean = 81.2, .sd_panels = 1.0}).value(),
                         stated_error));
  }
}

TEST(AcceptanceProbability, IsOneWhereAllPanelsMayFail) {
  Batch batch = batch_by(Kind::attributes, 3, {.low = 80.0});
  batch.plan.accept.nonconforming = 3;
  EXPECT_EQ(accepted(batch, {}, {.mean = 0.0, .sd_panels = 1.0}), 1.0);
}

// By the mean.

TEST(AcceptanceProbability, OfAMeanIsNormal) {
  Batch batch = batch_by(Kind::mean, 4, {.low = 80.0, .high = 90.0});
  batch.plan.repetitions = 9;
  batch.decision.rule = DecisionRule::guarded;
  const NormalComponents product{
      .mean = 88.0, .sd_lots = 0.7, .sd_panels = 1.2, .sd_readings = 2.4};
  // Of a panel 1.2^2 + 0.8^2 = 2.08; of the mean of four 0.52, and 0.49 and 0.25 that they share.
  EXPECT_TRUE(is_close(accepted(batch, {.systematic = 0.5, .expanded = 1.0}, product),
                       within_limits(88.0, std::sqrt(1.26), {.low = 81.0, .high = 89.0}),
                       stated_error));
  // Of two instruments each has half the weight.
  batch.instruments.push_back(batch.instruments.front());
  EXPECT_TRUE(is_close(accepted(batch, {.systematic = 0.5, .expanded = 1.0}, product),
                       within_limits(88.0, std::sqrt(1.135), {.low = 81.0, .high = 89.0}),
                       stated_error));
}

// By variables.

TEST(AcceptanceProbability, ByVariablesIsThatOfNoncentralT) {
  Batch batch = batch_by(Kind::variables, 10, {.high = 90.0});
  batch.plan.accept.k = 1.5;
  const NormalComponents product{.mean = 87.0, .sd_panels = 1.5};
  EXPECT_TRUE(is_close(accepted(batch, {}, product),
                       accepted_by_variables(10, 1.5, 87.0, 1.5, {.high = 90.0}).value(),
                       stated_error));
  // With nothing to spread a lot about its mean, the mean alone decides.
  const NormalComponents even{.mean = 89.0, .sd_lots = 2.0};
  EXPECT_TRUE(
      is_close(accepted(batch, {}, even), within_limits(89.0, 2.0, {.high = 90.0}), stated_error));
}

// What there is no closed form for.

std::string closed_form(const Batch& batch, const ReadingUncertainty& each = {}) {
  const ReadingUncertainties uncertainties = uncertainties_of(batch, each);
  return AcceptanceProbability(batch, uncertainties, 0).closed_form();
}

TEST(AcceptanceProbability, SaysWhatItIs) {
  EXPECT_EQ(closed_form(batch_by(Kind::attributes, 5, {.low = 1.0, .high = 2.0})), "binomial");
  EXPECT_EQ(closed_form(batch_by(Kind::mean, 5, {.low = 1.0, .high = 2.0})), "normal");
  EXPECT_EQ(closed_form(batch_by(Kind::variables, 5, {.low = 1.0})), "noncentral t");
}

TEST(AcceptanceProbability, IsNotThereForWhatItDoesNotCover) {
  EXPECT_EQ(closed_form(batch_by(Kind::variables, 5, {.low = 1.0, .high = 2.0})), "");
  EXPECT_EQ(closed_form(batch_by(Kind::variables, 1, {.low = 1.0})), "");
  EXPECT_EQ(closed_form(batch_of({})), "");
  Batch selecting = batch_by(Kind::mean, 5, {.low = 1.0});
  selecting.selected_only = true;
  EXPECT_EQ(closed_form(selecting), "");
  Batch two = batch_of({.low = 1.0}, {"60", "20"});
  two.requirements.push_back({.channel = 1, .limits = {.low = 1.0}});
  EXPECT_EQ(closed_form(two), "");
  Batch instruments = batch_by(Kind::variables, 6, {.low = 1.0});
  instruments.instruments.push_back(instruments.instruments.front());
  EXPECT_EQ(closed_form(instruments), "noncentral t");
  EXPECT_EQ(closed_form(instruments, {.systematic = 0.1}), "");
}

TEST(AcceptanceProbability, IsNotThereWhereTheReadingRuleHasASay) {
  Batch batch = batch_by(Kind::attributes, 5, {.low = 80.0});
  batch.plan.repetitions = 3;
  batch.standard.readings = ReadingRule{.count = {.at_least = 3}};
  batch.standard.readings->more = ReadingRule::More{.when_range_above_gu = 5.0, .count = 3};
  const ReadingUncertainties uncertainties = uncertainties_of(batch);
  const auto with = [&](double sd_readings) {
    return AcceptanceProbability(batch, uncertainties,
                                 0)({.mean = 85.0, .sd_panels = 1.0, .sd_readings = sd_readings});
  };
  EXPECT_TRUE(with(0.5));
  EXPECT_FALSE(with(2.0));
  batch.plan.repetitions = 2;
  EXPECT_FALSE(with(0.0));
  batch.plan.repetitions = 6;  // as many as the rule may ask for
  EXPECT_TRUE(with(2.0));
  batch.standard.readings->reject = ReadingRule::Reject{.share_at_least = 0.1};
  EXPECT_FALSE(with(2.0));
  // The mean of a lot does not ask whether its panels were uniform.
  batch.plan.accept.kind = Kind::mean;
  EXPECT_TRUE(with(2.0));
}

}  // namespace
}  // namespace gonio
