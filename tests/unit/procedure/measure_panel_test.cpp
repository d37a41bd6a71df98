#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "emulator/procedure/measure.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/procedure/laboratory.hpp"

// Samples that are not the same everywhere.

namespace gonio {
namespace {

using test::message_of;
using test::observer;
using test::shipped_meter;
using test::shipped_sample;

constexpr double tolerance_gu = 1e-6;

Measurement measured(const std::string& sample, const std::optional<PanelPosition>& position,
                     const std::string& instrument = "triangle_gloss") {
  return measure(shipped_sample(sample), shipped_meter(instrument), observer(),
                 {.tolerance = tolerance_gu, .position = position});
}

double gloss_at(const Measurement& measurement, const std::string& geometry) {
  return measurement.find(geometry)->reading.gloss;
}

TEST(MeasurePanel, IsAtItsCentreUnlessAPositionIsGiven) {
  const Measurement centre = measured("black_high_gloss_striped", {});
  const Measurement stated =
      measured("black_high_gloss_striped", PanelPosition{.x_mm = 75, .y_mm = 50});
  EXPECT_EQ(centre.position, stated.position);
  EXPECT_EQ(gloss_at(centre, "85"), gloss_at(stated, "85"));
  EXPECT_EQ(measured("black_satin", {}).position, std::nullopt);
}

TEST(MeasurePanel, AwayFromTheStripeReadsTheSampleOfTheBase) {
  const Measurement aside =
      measured("black_high_gloss_striped", PanelPosition{.x_mm = 40, .y_mm = 50});
  const Measurement plain = measured("black_high_gloss", {});
  for (const GeometryResult& result : plain.geometries) {
    EXPECT_EQ(gloss_at(aside, result.id), result.reading.gloss) << result.id;
  }
}

TEST(MeasurePanel, ReadsTheMeanOfWhatTheSpotCovers) {
  // The stripe ends at 85 mm: at t half lengths beyond that, (acos t - t sqrt(1 - t^2)) / pi of the
  // ellipse lies on it.
  constexpr double area_tolerance = 1e-3;
  const Measurement base = measured("black_high_gloss", {});
  const Measurement stripe = measured("black_matt", {});
  const Measurement edge =
      measured("black_high_gloss_striped", PanelPosition{.x_mm = 87, .y_mm = 30});
  for (const char* geometry : {"20", "60"}) {
    const double half = edge.find(geometry)->spot->spot.half_length_mm;
    const double t = 2.0 / half;
    const double share = (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
    const double high = gloss_at(base, geometry), low = gloss_at(stripe, geometry);
    EXPECT_NEAR(gloss_at(edge, geometry), high + share * (low - high),
                area_tolerance * (high - low) + tolerance_gu)
        << geometry;
    ASSERT_EQ(edge.find(geometry)->spot->regions.size(), 2u);
    EXPECT_EQ(edge.find(geometry)->spot->regions[1].id, "stripe");
    EXPECT_NEAR(edge.find(geometry)->spot->regions[1].share, share, area_tolerance);
  }
}

TEST(MeasurePanel, TellsSpotsThatGrowTowardsGrazingIncidence) {
  constexpr double tenth_mm = 0.05;
  const Measurement measurement = measured("clearcoat_orange_peel", {});
  const double lengths_mm[] = {10.0, 15.0, 37.6}, widths_mm[] = {10.0, 9.0, 5.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Spot& spot = measurement.geometries[i].spot->spot;
    EXPECT_NEAR(2.0 * spot.half_length_mm, lengths_mm[i], tenth_mm);
    EXPECT_NEAR(2.0 * spot.half_width_mm, widths_mm[i], tenth_mm);
  }
}

TEST(MeasurePanel, VariesLessUnderAWiderSpot) {
  // A spot averages the map over its area; the nominal instrument measures at points.
  const auto spread = [](const Glossmeter& meter) {
    const Sample sample = shipped_sample("clearcoat_orange_peel");
    double sum = 0.0, squares = 0.0;
    constexpr int places = 8;
    for (int i = 0; i < places; ++i) {
      const PanelPosition position{.x_mm = 40.0 + 9.0 * i, .y_mm = 20.0 + 7.0 * i};
      const double gloss =
          measure(sample, meter, observer(), {.geometries = {"20"}, .position = position})
              .geometries[0]
              .reading.gloss;
      sum += gloss;
      squares += gloss * gloss;
    }
    return std::sqrt(squares / places - sum * sum / places / places);
  };
  const double points = spread(test::meter_by_standard("iso_2813/2014"));
  const double spots = spread(shipped_meter("triangle_gloss"));
  EXPECT_GT(points, 1.0);
  EXPECT_LT(spots, 0.5 * points);
}

TEST(MeasurePanel, RefusesAPlaceThatTheSpotDoesNotFitOn) {
  EXPECT_EQ(
      message_of([] {
        (void)measured("black_high_gloss_striped", PanelPosition{.x_mm = 15, .y_mm = 50});
      }),
      "black_high_gloss_striped: the spot of geometry 85, 37.6 mm x 5 mm at 15 mm, 50 mm, hangs "
      "over the edge of the panel of 150 mm x 100 mm");
  EXPECT_THROW((void)measured("black_high_gloss_striped", PanelPosition{.x_mm = -1, .y_mm = 50},
                              "paper_setup"),
               std::invalid_argument);
}

TEST(MeasurePanel, RefusesAPositionOnASampleThatIsNone) {
  EXPECT_EQ(
      message_of([] { (void)measured("black_satin", PanelPosition{.x_mm = 75, .y_mm = 50}); }),
      "black_satin: a position needs a sample whose file states 'panel:', this one is the "
      "same everywhere");
}

}  // namespace
}  // namespace gonio
