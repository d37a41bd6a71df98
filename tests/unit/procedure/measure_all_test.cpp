#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/procedure/laboratory.hpp"

namespace gonio {
namespace {

using test::observer;

constexpr double tolerance_gu = 1e-2;

std::vector<Sample> some_samples() {
  std::vector<Sample> samples;
  for (const char* id : {"black_high_gloss", "black_satin", "copper_polished", "red_satin",
                         "white_diffuser", "perfect_mirror", "clearcoat_hazy", "steel_brushed"}) {
    samples.push_back(test::shipped_sample(id));
  }
  return samples;
}

std::vector<Measurement> measured(const std::vector<Sample>& samples, const Glossmeter& meter,
                                  std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return measure_all(samples, meter, observer(), {.tolerance = tolerance_gu});
}

void expect_same_bits(const Measurement& a, const Measurement& b) {
  EXPECT_EQ(a.sample, b.sample);
  EXPECT_EQ(a.selected_geometry, b.selected_geometry);
  ASSERT_EQ(a.geometries.size(), b.geometries.size());
  for (std::size_t i = 0; i < a.geometries.size(); ++i) {
    const GlossReading& one = a.geometries[i].reading;
    const GlossReading& other = b.geometries[i].reading;
    EXPECT_EQ(one.gloss, other.gloss) << a.sample;
    EXPECT_EQ(one.quadrature_error, other.quadrature_error) << a.sample;
    EXPECT_EQ(one.luminous_reflectance, other.luminous_reflectance) << a.sample;
    EXPECT_TRUE((one.reflectance == other.reflectance).all()) << a.sample;
  }
}

TEST(MeasureAll, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Glossmeter meter = test::meter_by_standard("iso_2813/2014");
  const std::vector<Sample> samples = some_samples();
  const std::vector<Measurement> on_one = measured(samples, meter, 1);
  for (const std::size_t threads : {2, 4}) {
    const std::vector<Measurement> on_many = measured(samples, meter, threads);
    ASSERT_EQ(on_many.size(), on_one.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      expect_same_bits(on_many[i], on_one[i]);
    }
  }
}

TEST(MeasureAll, GivesWhatMeasureGivesInTheOrderOfTheSamples) {
  const Glossmeter meter = test::meter_by_standard("iso_2813/2014");
  const std::vector<Sample> samples = some_samples();
  const std::vector<Measurement> all = measured(samples, meter, 2);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(all[i].sample, samples[i].id);
    expect_same_bits(all[i], measure(samples[i], meter, observer(), {.tolerance = tolerance_gu}));
  }
}

TEST(MeasureAll, AdvancesOnceForEachSampleOneAtATime) {
  const Glossmeter meter = test::meter_by_standard("iso_2813/2014");
  const std::vector<Sample> samples = some_samples();
  std::size_t done = 0;  // no atomic: the calls must not overlap
  (void)measure_all(samples, meter, observer(), {.tolerance = tolerance_gu}, [&] { ++done; });
  EXPECT_EQ(done, samples.size());
}

TEST(MeasureAll, OfNothingIsNothing) {
  EXPECT_TRUE(measure_all({}, test::meter_by_standard("iso_2813/2014"), observer(), {}).empty());
}

TEST(MeasureAll, PassesAnErrorOn) {
  const std::vector<Sample> samples = some_samples();
  EXPECT_THROW((void)measure_all(samples, test::meter_by_standard("iso_2813/2014"), observer(),
                                 {.geometries = {"45"}}),
               std::invalid_argument);
  EXPECT_THROW(
      (void)measure_all(samples, test::meter_by_standard("tappi_t480/om_15"), observer(), {}),
      InputError);
}

}  // namespace
}  // namespace gonio
