#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "emulator/core/text_file.hpp"
#include "tests/unit/procedure/laboratory.hpp"

// Everything that ships can be used, or says which number is missing.

namespace gonio {
namespace {

using test::ids_of_shipped;
using test::observer;
using test::shipped_meter;
using test::shipped_sample;
using test::shipped_standard;

constexpr double tolerance_gu = 1e-3;

/// The word at a place of a file.
std::string word_at(const SourceMark& mark) {
  std::istringstream lines(read_text_file(mark.file));
  std::string line;
  for (int i = 0; i < mark.line; ++i) {
    std::getline(lines, line);
  }
  std::string word;
  std::istringstream(line.substr(std::size_t(mark.column - 1))) >> word;
  return word;
}

/// Measures in one geometry. @return  whether it could.
bool measures(const std::string& standard, const std::string& geometry) {
  const Glossmeter meter = test::meter_by_standard(standard);
  try {
    const Measurement measurement = measure(shipped_sample("black_satin"), meter, observer(),
                                            {.geometries = {geometry}, .tolerance = tolerance_gu});
    EXPECT_GT(measurement.find(geometry)->reading.gloss, 0.0) << standard << " " << geometry;
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(word_at(error.mark()), "unknown") << error.what();
    EXPECT_THAT(error.mark().key, testing::MatchesRegex("geometries.[0-9]+..(source|receptor)."
                                                        "(in_plane|perpendicular|diameter)"));
    EXPECT_EQ(
        std::string(error.what()),
        error.mark().text() + ": expected a number, to measure in this geometry, found 'unknown'");
    return false;
  }
}

TEST(ShippedStandards, MeasureInEachGeometryOrNameTheMissingNumber) {
  int measuring = 0;
  int missing = 0;
  for (const std::string& id : ids_of_shipped(Catalog::Kind::standard)) {
    if (shipped_standard(id).scale.is_of_colour()) {
      continue;
    }
    for (const GeometryLimits& geometry : shipped_standard(id).geometries) {
      ++(measures(id, geometry.id) ? measuring : missing);
    }
  }
  EXPECT_GE(measuring, 22);
  EXPECT_GE(missing, 1);
}

TEST(ShippedInstruments, ReadTheReferenceGlassAt100) {
  for (const std::string& id : ids_of_shipped(Catalog::Kind::instrument)) {
    if (load_instrument(test::shipped().find(Catalog::Kind::instrument, id), test::shipped())
            .standard.scale.is_of_colour()) {
      continue;
    }
    const Glossmeter meter = shipped_meter(id);
    for (const std::string& geometry : meter.instrument().geometries) {
      EXPECT_NEAR(meter.read(shipped_sample("black_glass_n1567").surface, geometry, 1e-6).gloss,
                  100.0, 1e-9)
          << id << " at " << geometry;
    }
  }
}

// An instrument within the limits of the standard reads within a unit or so of the nominal one.
TEST(ShippedInstruments, WithinTheLimitsReadNearTheNominalOne) {
  constexpr double few_units = 3.0;
  const Sample paint = shipped_sample("black_high_gloss");
  const Measurement nominal =
      measure(paint, shipped_meter("nominal_iso_2813"), observer(), {.tolerance = tolerance_gu});
  const Measurement built =
      measure(paint, shipped_meter("triangle_gloss"), observer(), {.tolerance = tolerance_gu});
  for (const GeometryResult& result : nominal.geometries) {
    EXPECT_NE(built.find(result.id)->reading.gloss, result.reading.gloss);
    EXPECT_NEAR(built.find(result.id)->reading.gloss, result.reading.gloss, few_units) << result.id;
  }
}

TEST(ShippedSamples, HaveTheIdOfTheirFileAndATitle) {
  const auto ids = ids_of_shipped(Catalog::Kind::sample);
  EXPECT_GE(ids.size(), 35u);
  for (const std::string& id : ids) {
    const Sample sample = shipped_sample(id);
    EXPECT_EQ(sample.id, id);
    EXPECT_FALSE(sample.title.empty()) << id;
    EXPECT_FALSE(sample.notes.empty()) << id;
  }
}

/// Between the nodes of a table a BRDF has kinks, and its integral ends with the budget of cells; a
/// tenth of what a display shows is enough.
double tolerance_of(const Sample& sample) {
  constexpr double of_tables_gu = 0.1;
  return sample.surface.measured.empty() ? tolerance_gu : of_tables_gu;
}

TEST(ShippedSamples, ReadAGlossThatIsNotNegativeAndAReflectanceUpToOne) {
  constexpr double rounding = 1e-12;
  const Glossmeter meter = test::meter_by_standard("iso_2813/2014");
  const Measurement mirror =
      measure(shipped_sample("perfect_mirror"), meter, observer(), {.tolerance = tolerance_gu});
  for (const std::string& id : ids_of_shipped(Catalog::Kind::sample)) {
    const Sample sample = shipped_sample(id);
    const Measurement measurement = measure(sample, meter, observer(), {.tolerance = tolerance_gu});
    for (const GeometryResult& result : measurement.geometries) {
      const GlossReading& reading = result.reading;
      EXPECT_GE(reading.gloss, 0.0) << id << " at " << result.id;
      EXPECT_LE(reading.gloss, mirror.find(result.id)->reading.gloss + tolerance_gu) << id;
      EXPECT_LE(reading.quadrature_error, tolerance_of(sample)) << id << " at " << result.id;
      EXPECT_GE(reading.reflectance.minCoeff(), 0.0) << id << " at " << result.id;
      EXPECT_LE(reading.reflectance.maxCoeff(), 1.0 + rounding) << id << " at " << result.id;
    }
  }
}

// fixtures/reference/fresnel_gloss_vs_n.csv, to the three decimals printed there; n = 1.527 is the
// example of ASTM D523.
TEST(ShippedSamples, OfPolishedGlassReadTheirAssignedValues) {
  struct Glass {
    const char* id;
    double at_20, at_60, at_85, decimals;
  };
  const Glossmeter meter = shipped_meter("collimated_iso_2813");
  for (const Glass& glass : {Glass{"glass_n1400", 57.048, 71.936, 96.636, 5e-4},
                             Glass{"glass_n1500", 82.045, 89.137, 98.975, 5e-4},
                             Glass{"glass_n1527", 89.2, 93.6, 99.4, 0.05},
                             Glass{"glass_n1600", 109.120, 105.179, 100.390, 5e-4},
                             Glass{"glass_n1700", 137.610, 120.268, 101.219, 5e-4},
                             Glass{"glass_n1800", 167.010, 134.568, 101.655, 5e-4}}) {
    const Surface surface = shipped_sample(glass.id).surface;
    const double rounded = glass.decimals + 1e-6;
    EXPECT_NEAR(meter.read(surface, "20", 1e-7).gloss, glass.at_20, rounded) << glass.id;
    EXPECT_NEAR(meter.read(surface, "60", 1e-7).gloss, glass.at_60, rounded) << glass.id;
    EXPECT_NEAR(meter.read(surface, "85", 1e-7).gloss, glass.at_85, rounded) << glass.id;
  }
}

// What the notes of a sample promise.
TEST(ShippedSamples, ReadWhatTheirNotesSayAtSixtyDegrees) {
  constexpr double about = 1.0;
  const Glossmeter meter = test::meter_by_standard("iso_2813/2014");
  const auto gloss = [&](const std::string& id) {
    return meter.read(shipped_sample(id).surface, "60", tolerance_gu).gloss;
  };
  EXPECT_NEAR(gloss("black_high_gloss"), 83.0, about);
  EXPECT_NEAR(gloss("black_semi_gloss"), 52.0, about);
  EXPECT_NEAR(gloss("black_satin"), 35.0, about);
  EXPECT_NEAR(gloss("black_eggshell"), 16.0, about);
}

}  // namespace
}  // namespace gonio
