#include "emulator/procedure/measured_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/surface/models.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/model_brdf.hpp"
#include "tests/unit/procedure/laboratory.hpp"

namespace gonio {
namespace {

const WavelengthGrid grid(nanometres(555), nanometres(1), 1);

Glossmeter glossmeter() {
  return {nominal_instrument(test::shipped_standard("iso_2813/2014")), grid,
          std::make_shared<ApertureIntegrator>()};
}

const Surface& model_of(double m) {
  static std::map<double, Surface> models;
  return models.try_emplace(m, cook_torrance(grid, m, Eigen::ArrayXcd::Constant(1, 1.567)))
      .first->second;
}

Surface table_of(double m, double step_deg) {
  return test::measured(std::make_shared<test::SampledModelBrdf>(model_of(m), degrees(step_deg)),
                        grid);
}

TEST(ResolutionError, IsAtLeastHalfOfTheTrueError) {
  constexpr double stated_factor = 2.0;
  const Glossmeter meter = glossmeter();
  for (const double m : {0.02, 0.05, 0.2}) {
    for (const double step_deg : {1.0, 5.0}) {
      for (const char* id : {"20", "60"}) {
        const double truth = meter.read(model_of(m), id, 1e-4).gloss;
        const Surface table = table_of(m, step_deg);
        const GlossReading reading = meter.read(table, id, 2e-3 * truth);
        EXPECT_LE(std::abs(reading.gloss - truth),
                  stated_factor * resolution_error_gu(table, meter, id, reading) +
                      reading.quadrature_error)
            << "m " << m << ", step " << step_deg << " deg, at " << id;
      }
    }
  }
}

TEST(ResolutionError, IsNoneOfAModel) {
  const Glossmeter meter = glossmeter();
  EXPECT_EQ(resolution_error_gu(model_of(0.1), meter, "60", meter.read(model_of(0.1), "60", 1e-4)),
            0.0);
}

TEST(ReadingWarnings, NameACoarseTableAndItsStep) {
  const Glossmeter meter = glossmeter();
  const auto warnings_of = [&](double m, double step_deg) {
    const Surface table = table_of(m, step_deg);
    return reading_warnings(table, meter, "60", meter.read(table, "60", 1e-3));
  };
  EXPECT_THAT(warnings_of(0.05, 5.0),
              testing::ElementsAre(testing::StartsWith(
                  "at 60: the BRDF was measured in steps of 5 deg, coarse for the lobe it shows")));
  EXPECT_THAT(warnings_of(0.2, 1.0), testing::IsEmpty());
}

TEST(DataWarnings, NameWhatTheFileLacks) {
  Surface table = table_of(0.2, 5.0);
  table.measured[0].warnings = {"one side is missing"};
  EXPECT_THAT(data_warnings(table), testing::ElementsAre("one side is missing"));
}

// 37.6 and 1.1 GU were computed from these files by another program, for a collimated source.
TEST(MeasuredSample, ReadsTheGlossOfItsFile) {
  constexpr double satin_gu = 0.5;
  constexpr double matt_gu = 0.1;
  const Glossmeter meter = test::meter_by_standard("iso_2813/2014");
  const auto gloss = [&](const char* id) {
    return meter.read(test::shipped_sample(id).surface, "60", 1e-2).gloss;
  };
  EXPECT_TRUE(test::is_close(gloss("satin_film_measured"), 37.6, satin_gu));
  EXPECT_TRUE(test::is_close(gloss("wall_paint_measured"), 1.1, matt_gu));
}

}  // namespace
}  // namespace gonio
