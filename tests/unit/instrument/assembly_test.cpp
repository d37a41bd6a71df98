#include "emulator/instrument/assembly.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "emulator/integration/aperture_integrator.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/instrument/test_device.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio {
namespace {

using test::is_close;
using test::reading_gu;
using test::shipped;
using test::shipped_standard;

constexpr double tolerance_gu = 1e-4;  // as `gonio measure` asks for
const WavelengthGrid grid = WavelengthGrid::visible();

Glossmeter glossmeter(const Instrument& instrument) {
  return {instrument, grid, std::make_shared<ApertureIntegrator>()};
}

Instrument instrument_of(const std::string& id) {
  return load_instrument(shipped().find(Catalog::Kind::instrument, id), shipped());
}

std::vector<Sample> samples_of(const Instrument& instrument) {
  std::vector<Sample> samples;
  for (const auto& file : instrument.samples) {
    samples.push_back(load_sample(file, grid));
  }
  return samples;
}

TEST(AssembleDevice, MeasuresWhatTheGlossmeterReadsToTheLastBitIfItIsIdeal) {
  for (const char* id : {"triangle_gloss", "pocket_gloss_60"}) {
    const Instrument instrument = instrument_of(id);
    const Glossmeter meter = glossmeter(instrument);
    const std::vector<Sample> samples = samples_of(instrument);
    Device device = assemble_device(meter, instrument.behaviour.ideal(), samples, tolerance_gu);
    ASSERT_EQ(test::calibrate(device), DeviceError::none);
    for (std::size_t s = 0; s < samples.size(); ++s) {
      ASSERT_EQ(test::measure(device, int(s)), DeviceError::none);
      for (std::size_t c = 0; c < device.channels().size(); ++c) {
        const auto expected = meter.read(samples[s].surface, device.channels()[c].geometry_id,
                                         tolerance_gu, samples[s].tilt);
        EXPECT_EQ(reading_gu(device, c), expected.gloss) << samples[s].id;
      }
    }
  }
}

TEST(AssembleDevice, LaysASampleOnItsWedge) {
  const Instrument instrument = instrument_of("nominal_iso_2813");
  std::vector<Sample> samples;
  for (const char* id : {"perfect_mirror", "mirror_tilted_0_2deg", "mirror_tilted_1_0deg"}) {
    samples.push_back(load_sample(shipped().find(Catalog::Kind::sample, id), grid));
  }
  Device device =
      assemble_device(glossmeter(instrument), instrument.behaviour.ideal(), samples, tolerance_gu);
  ASSERT_EQ(test::calibrate(device), DeviceError::none);
  const auto at = [&](int sample) {
    EXPECT_EQ(test::measure(device, sample), DeviceError::none);
    return std::array{reading_gu(device, 0), reading_gu(device, 1), reading_gu(device, 2)};
  };
  const auto flat = at(0);
  const auto within_the_clearance = at(1);
  const auto beyond = at(2);
  for (std::size_t c = 0; c < 3; ++c) {
    const Angle theta_i = device.channels()[c].theta_i;
    const double less_light =
        std::cos((theta_i + degrees(0.2)).radians()) / std::cos(theta_i.radians());
    EXPECT_TRUE(is_close(within_the_clearance[c], flat[c] * less_light, 1e-3)) << c;
    EXPECT_LT(beyond[c], 0.8 * flat[c]) << c;
  }
}

TEST(AssembleDevice, NamesChannelsAndSamples) {
  const Instrument instrument = instrument_of("triangle_gloss");
  const Device device = assemble_device(glossmeter(instrument), instrument.behaviour,
                                        samples_of(instrument), tolerance_gu);
  EXPECT_EQ(device.identity().serial_number, "TG-2813-0042");
  ASSERT_EQ(device.channels().size(), 3U);
  EXPECT_EQ(device.channels()[0].geometry_id, "20");
  EXPECT_EQ(device.channels()[2].theta_i, degrees(85));  // nominal: as it is called
  ASSERT_EQ(device.samples().size(), instrument.samples.size());
  EXPECT_EQ(device.samples().front().id, "black_matt");
  EXPECT_EQ(device.samples()[14].title, "Smooth gold, Johnson and Christy 1972");
}

TEST(AssembleDevice, StatesTheSetUpAsItWasBuilt) {
  const Instrument instrument = instrument_of("triangle_gloss");
  const Device device =
      assemble_device(glossmeter(instrument), instrument.behaviour, {}, tolerance_gu);
  const StatedSetup& at_60 = device.channels()[1].setup;
  EXPECT_EQ(at_60[std::size_t(SetupQuantity::theta_i)],
            (StatedAngle{.value = degrees(60.04), .expanded_uncertainty = degrees(0.01)}));
  EXPECT_EQ(at_60[std::size_t(SetupQuantity::receptor_perpendicular)]->value, degrees(11.62));
  EXPECT_FALSE(at_60[std::size_t(SetupQuantity::receptor_diameter)]);  // it has sides
}

// With all its deviations a calibrated instrument reads black glass within what they allow.
TEST(AssembleDevice, OfTheShippedInstrumentReadsItsTileAfterCalibration) {
  const Instrument instrument = instrument_of("triangle_gloss");
  Device device = assemble_device(glossmeter(instrument), instrument.behaviour, {}, tolerance_gu);
  device.advance(30.0);
  ASSERT_EQ(test::zero(device), DeviceError::none);
  ASSERT_EQ(test::calibrate(device), DeviceError::none);
  ASSERT_EQ(test::run(device, DeviceCommand::measure), DeviceError::none);
  constexpr double noise_and_resolution_gu = 5 * 0.05 + 0.1;
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_TRUE(is_close(reading_gu(device, c), 100.0, noise_and_resolution_gu)) << c;
  }
}

TEST(AssembleDevice, GivesTheTileTheValueOfTheScaleIfItIsTheReferenceGlass) {
  const Instrument instrument = instrument_of("triangle_gloss");
  const Device device =
      assemble_device(glossmeter(instrument), instrument.behaviour, {}, tolerance_gu);
  for (const Channel& channel : device.channels()) {
    EXPECT_EQ(channel.tile_assigned_gu, 100.0);
    EXPECT_EQ(channel.tile_optics_gu, 100.0);
  }
}

TEST(AssembleDevice, ReadsATileOfAnotherGlassThroughTheOpticsAsBuilt) {
  const Instrument instrument = instrument_of("triangle_gloss");
  Behaviour behaviour = instrument.behaviour;
  behaviour.tile_index = 1.527;
  const Device device = assemble_device(glossmeter(instrument), behaviour, {}, tolerance_gu);
  const Channel& at_60 = device.channels()[1];
  EXPECT_EQ(at_60.tile_assigned_gu, assigned_gloss(1.527, degrees(60), instrument.standard.scale));
  constexpr double by_misaligned_optics_gu = 0.05;
  EXPECT_NE(at_60.tile_optics_gu, at_60.tile_assigned_gu);
  EXPECT_TRUE(is_close(at_60.tile_optics_gu, at_60.tile_assigned_gu, by_misaligned_optics_gu));
  EXPECT_EQ(device.settings().channels[1].tile_gu, at_60.tile_assigned_gu);
}

TEST(AssembleDevice, KnowsAScaleWithoutAReferenceGlass) {
  const Glossmeter meter = glossmeter(nominal_instrument(shipped_standard("astm_c346/87")));
  const Device device = assemble_device(meter, Behaviour(), {}, tolerance_gu);
  constexpr double over_the_source_image_gu = 0.02;  // 1.4 x 3.0 deg
  const Channel& at_45 = device.channels()[0];
  EXPECT_TRUE(is_close(at_45.tile_assigned_gu, 59.71, over_the_source_image_gu));
  EXPECT_TRUE(is_close(at_45.tile_optics_gu, 59.71, over_the_source_image_gu));
}

}  // namespace
}  // namespace gonio
