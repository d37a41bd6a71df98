#include "emulator/quality/product_panels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "emulator/instrument/glossmeter.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/statistics/running_statistics.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/quality/made_batch.hpp"
#include "tests/unit/quality/made_product.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {

namespace {

using test::MadeProduct;

constexpr std::size_t roughness = 0;
constexpr double small = 0.01;  // a spread whose square does not matter

RunningStatistics statistics_of(std::size_t n, const std::function<double(std::size_t)>& value) {
  RunningStatistics result;
  for (std::size_t i = 0; i < n; ++i) {
    result.add(value(i));
  }
  return result;
}

/// Five standard deviations of a standard deviation that was found from n values.
double scatter(double sd, std::size_t n) { return 5.0 * sd / std::sqrt(2.0 * double(n - 1)); }

double truth(const PanelRecord& panel) { return panel.channels.at(0).truth.value(); }

}  // namespace

TEST(ProductPanels, AllReadTheSampleWhereNothingVaries) {
  MadeProduct made("black_semi_gloss", {"20", "60"});
  const auto panels = made.panels();
  const PanelRecord panel = panels.inspect(1);
  ASSERT_EQ(panel.readings.size(), 6U);
  for (const ReadingRecord& reading : panel.readings) {
    EXPECT_NEAR(reading.value, made.gloss(reading.channel), made.optics().error() + 1e-3);
  }
  for (const ChannelResult& result : panel.channels) {
    EXPECT_NEAR(result.truth.value(), made.gloss(result.channel), made.optics().error() + 1e-3);
  }
}

TEST(ProductPanels, DependOnTheirNumberAndTheSeedAlone) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.product->spread[roughness] = made.normal(small, small, small);
  const auto panels = made.panels();
  const PanelRecord seventh = panels.inspect(7);
  (void)panels.inspect(1);
  EXPECT_EQ(panels.inspect(7), seventh);
  made.batch.seed = 2;
  EXPECT_NE(made.panels().inspect(7), seventh);
}

// dG / G = gain dr: what one panel deviates by is that of its roughness.
TEST(ProductPanels, SpreadAsTheirRoughnessDoes) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.product->spread[roughness] = made.normal(0.0, small, 0.0);
  const auto panels = made.panels();
  const std::size_t n = test::trials(4000);
  const double sd = statistics_of(n, [&](std::size_t i) { return truth(panels.inspect(i + 1)); })
                        .result()
                        .standard_deviation;
  const double expected = small * std::abs(made.slope(roughness));
  EXPECT_NEAR(sd, expected, scatter(expected, n) + 0.01 * expected);
}

TEST(ProductPanels, OfALotShareWhatItDeviatesBy) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.plan.lots = 3;
  made.batch.plan.panels = 4;
  made.batch.product->spread[roughness] = made.normal(small, 0.0, 0.0);
  const auto panels = made.panels();
  std::set<double> found;
  for (std::uint64_t number = 1; number <= 12; ++number) {
    const PanelRecord panel = panels.inspect(number);
    EXPECT_EQ(panel.lot, (number - 1) / 4 + 1);
    EXPECT_NEAR(truth(panel), panels.truth(panel.lot).mean.at(0), 1e-9);
    found.insert(truth(panel));
  }
  EXPECT_EQ(found.size(), 3U);
}

TEST(ProductPanels, VaryFromPlaceToPlaceAsTheFilmDoes) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.product->spread[roughness] = made.normal(0.0, 0.0, small);
  const double expected = small * std::abs(made.slope(roughness));
  const std::size_t n = test::trials(2000);
  const auto within = [&] {
    const auto panels = made.panels();
    double variance = 0.0;
    for (std::uint64_t number = 1; number <= n; ++number) {
      variance += std::pow(panels.inspect(number).channels.at(0).standard_deviation, 2);
    }
    return std::sqrt(variance / double(n));
  };
  EXPECT_NEAR(within(), expected, scatter(expected, 2 * n) + 0.01 * expected);
  // A film that is the same over much more than the panel does not vary within it.
  made.batch.product->correlation_length_mm = 1e5;
  EXPECT_LT(within(), 0.01 * expected);
  // Neighbours 35 and 70 mm apart that have half of it in common: by the mean of 1 - c.
  const double L = 35.0 / std::sqrt(2.0 * std::log(2.0));
  made.batch.product->correlation_length_mm = L;
  const double mean_correlation = (2.0 * 0.5 + std::pow(0.5, 4)) / 3.0;
  const double left = expected * std::sqrt(1.0 - mean_correlation);
  EXPECT_NEAR(within(), left, scatter(left, 2 * n) + 0.01 * left);
}

TEST(ProductPanels, CorrelatedParametersAddOrCancel) {
  MadeProduct made("blue_semi_gloss", {"60"});
  constexpr std::size_t diffuse = 2;
  constexpr double tiny = 0.001;  // a larger one would make some diffuse reflectances negative
  made.batch.product->spread[roughness] = made.normal(0.0, tiny, 0.0);
  const double a = tiny * made.slope(roughness);
  const double d = std::abs(a) / std::abs(made.slope(diffuse));
  made.batch.product->spread[diffuse] = made.normal(0.0, d, 0.0);
  const std::size_t n = test::trials(4000);
  const auto sd_for = [&](double coefficient) {
    made.batch.product->correlations = {{.a = roughness, .b = diffuse, .coefficient = coefficient}};
    const auto panels = made.panels();
    return statistics_of(n, [&](std::size_t i) { return truth(panels.inspect(i + 1)); })
        .result()
        .standard_deviation;
  };
  const double sign = a * made.slope(diffuse) > 0.0 ? 1.0 : -1.0;
  const double most = 2.0 * std::abs(a);
  EXPECT_NEAR(sd_for(0.999 * sign), most, scatter(most, n) + 0.02 * most);
  EXPECT_LT(sd_for(-0.999 * sign), 0.05 * most);
}

TEST(ProductPanels, GoFromAppraiserToAppraiser) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.instruments.push_back(made.batch.instruments.front());
  made.batch.operators = {{.id = "anna"}, {.id = "ben", .bias_gu = 5.0}};
  const auto panels = made.panels();
  for (std::uint64_t number = 1; number <= 8; ++number) {
    const ReadingRecord reading = panels.inspect(number).readings.front();
    EXPECT_EQ(reading.instrument, (number - 1) / 2 % 2);
    EXPECT_EQ(reading.operator_, (number - 1) % 2);
    EXPECT_NEAR(reading.value, made.gloss(0) + (reading.operator_ == 1 ? 5.0 : 0.0),
                made.optics().error() + 1e-3);
  }
}

TEST(ProductPanels, ReadFurtherPositionsWhenTheRuleAsksForThem) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.plan.further_positions = {{20.0, 20.0}, {75.0, 20.0}, {130.0, 20.0}};
  made.batch.operators = {{.id = "clumsy", .repeatability_gu = 2.5}};
  const auto panels = made.panels();
  std::set<std::size_t> counts;
  for (std::uint64_t number = 1; number <= 40; ++number) {
    const PanelRecord panel = panels.inspect(number);
    counts.insert(panel.readings.size());
    const std::vector<ReadingRecord> first(panel.readings.begin(), panel.readings.begin() + 3);
    PanelRecord as_begun{.readings = first};
    EXPECT_EQ(PanelJudge(made.batch, made.uncertainties).judge(as_begun),
              panel.readings.size() - 3);
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{3, 6}));
}

// A spot within the stripe reads the stripe, one far from it what lies around.
TEST(ProductPanels, AreReadRegionByRegion) {
  MadeProduct made("black_high_gloss_striped", {"60"});
  const auto family = SampleFamily::load(made.batch.product->sample, WavelengthGrid::visible());
  ASSERT_EQ(family.regions(), 2U);
  const Outline& stripe = family.layout()->regions.at(1).outline.value();
  made.batch.product->panel_length_mm = family.layout()->length_mm;
  made.batch.product->panel_width_mm = family.layout()->width_mm;
  made.batch.plan.positions = {{stripe.x_mm, stripe.y_mm}, {1.0, 1.0}};
  made.batch.plan.further_positions = {{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}};
  const PanelRecord panel = made.panels().inspect(1);
  EXPECT_NEAR(panel.readings.at(0).value, made.gloss(0, {}, 1), 0.01);
  EXPECT_NEAR(panel.readings.at(1).value, made.gloss(0, {}, 0), 0.01);
  const double share = stripe.area_mm2() / family.layout()->outline().area_mm2();
  constexpr double area_error = 1e-3;
  EXPECT_NEAR(panel.channels.at(0).truth.value(),
              share * made.gloss(0, {}, 1) + (1.0 - share) * made.gloss(0, {}, 0),
              100.0 * area_error);
}

TEST(ProductPanels, TellHazeAndDifferencesOfColour) {
  MadeProduct made("red_satin", {"20", "60"});
  made.batch.channels.push_back({"60/colour", "60", BatchChannel::Kind::colour_difference, ""});
  made.batch.channels.push_back({"haze", "", BatchChannel::Kind::haze, "GU"});
  made.batch.colour_references.resize(4);
  made.batch.standard.haze.resize(1);
  made.batch.standard.haze[0].id = "haze";
  made.batch.standard.haze[0].from = "60";
  made.batch.standard.haze[0].minus = "20";
  const PanelRecord panel = made.panels().inspect(1);
  ASSERT_EQ(panel.channels.size(), 4U);
  EXPECT_NEAR(panel.channels[2].mean, 0.0, 1e-3) << "the sample itself is the reference";
  EXPECT_DOUBLE_EQ(panel.channels[3].mean, panel.channels[1].mean - panel.channels[0].mean);
  EXPECT_EQ(panel.channels[3].n, 0U);
  EXPECT_NEAR(panel.channels[3].truth.value(),
              panel.channels[1].truth.value() - panel.channels[0].truth.value(), 1e-9);
}

TEST(ProductPanels, AreNotReadOverTheirEdge) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.file = "batch.yaml";
  Instrument& instrument = made.batch.instruments.front();
  instrument.beam["60"] = {.in_plane_mm = 10.0, .perpendicular_mm = 10.0};
  made.batch.plan.positions.front() = {9.0, 50.0};
  EXPECT_THAT(test::message_of([&] { (void)made.panels(); }),
              testing::AllOf(testing::HasSubstr("batch.yaml: sampling: expected positions where "
                                                "the spot of"),
                             testing::HasSubstr("20 mm by 10 mm, lies on the panel of 150 mm by "
                                                "100 mm, found '9 mm, 50 mm'")));
  made.batch.plan.positions.front() = {10.5, 50.0};
  EXPECT_EQ(made.panels().inspect(1).readings.size(), 3U);
}

TEST(ProductPanels, AreShownInStepsOfTheDisplay) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.instruments.front().behaviour.resolution_gu = 0.1;
  made.batch.instruments.front().behaviour.repeatability_gu = 0.3;
  const auto panels = made.panels();
  for (const ReadingRecord& reading : panels.inspect(1).readings) {
    EXPECT_DOUBLE_EQ(reading.value, std::round(reading.value / 0.1) * 0.1);
  }
}

// An instrument errs by the same amount until it is calibrated again, for the next lot.
TEST(ProductPanels, ShareTheErrorOfTheInstrumentInALot) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.plan.panels = 2;
  made.batch.plan.lots = test::trials(4000);
  made.uncertainties = test::same_uncertainty(made.batch, 1.0);
  const auto panels = made.panels();
  RunningStatistics errors;
  for (std::uint64_t lot = 1; lot <= made.batch.plan.lots; ++lot) {
    const double first = panels.inspect(2 * lot - 1).readings.front().value;
    EXPECT_NEAR(panels.inspect(2 * lot).readings.back().value, first, 1e-9);
    errors.add(first - truth(panels.inspect(2 * lot)));
  }
  const std::size_t n = made.batch.plan.lots;
  EXPECT_NEAR(errors.result().standard_deviation, 0.5, scatter(0.5, n));
  EXPECT_NEAR(errors.result().mean, 0.0, 5.0 * 0.5 / std::sqrt(double(n)));
}

TEST(ProductPanels, TellTheShareOfALotBeyondItsLimits) {
  MadeProduct made("black_semi_gloss", {"60"});
  made.batch.product->spread[roughness] = made.normal(0.0, small, 0.0);
  const double sd = small * std::abs(made.slope(roughness));
  made.batch.requirements = {{.channel = 0, .limits = {.high = made.gloss(0) + sd}}};
  const LotTruth truth = made.panels().truth(1);
  EXPECT_NEAR(truth.mean.at(0), made.gloss(0), 0.02 * sd);
  EXPECT_NEAR(truth.sd.at(0), sd, 0.01 * sd);
  constexpr double beyond_one_sigma = 0.158655;
  EXPECT_NEAR(truth.beyond.at(0), beyond_one_sigma, 0.005);
}

TEST(ProductPanels, OfAGaugeStudyAreReadByAll) {
  MadeProduct made("black_semi_gloss", {"20", "60"});
  made.batch.instruments.push_back(made.batch.instruments.front());
  made.batch.operators = {{.id = "anna"}, {.id = "ben", .bias_gu = 1.0}};
  made.batch.gauge = GaugePlan{.panels = 5, .repetitions = 3};
  made.batch.product->spread[roughness] = made.normal(small, small, small);
  const PanelRecord panel = made.panels().gauge(2);
  EXPECT_EQ(panel.study, PanelRecord::Study::gauge);
  ASSERT_EQ(panel.readings.size(), 2U * 2U * 2U * 3U);
  const double first = panel.readings.front().value;
  for (const ReadingRecord& reading : panel.readings) {
    if (reading.channel == 0) {
      EXPECT_NEAR(reading.value, first + (reading.operator_ == 1 ? 1.0 : 0.0), 1e-9);
    }
  }
}

}  // namespace gonio
