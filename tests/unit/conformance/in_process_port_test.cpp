#include "tests/conformance/in_process_port.hpp"

#include <gtest/gtest.h>

#include "emulator/core/input_error.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio::conformance {
namespace {

using test::is_close;
using test::message_of;

constexpr double tolerance_gu = 1e-3;  // of the integrator, and more

Instrument nominal() { return nominal_instrument(test::shipped_standard("iso_2813/2014")); }

InProcessPort port_of(Instrument instrument, std::vector<std::string> samples = {}) {
  return {std::move(instrument), std::move(samples), assemble_with(test::shipped())};
}

void warm_up_and_calibrate(InProcessPort& port) {
  port.pass(30.0);
  port.place(PortCover::tile, {});
  ASSERT_EQ(port.command(DeviceCommand::calibrate), DeviceError::none);
}

TEST(InProcessPort, NamesItsChannels) {
  Instrument instrument = nominal();
  instrument.behaviour.full_scale_gu = {2000.0, 1000.0, 160.0};
  instrument.behaviour.tile_index = 1.527;
  const InProcessPort port = port_of(instrument);
  ASSERT_EQ(port.channels().size(), 3U);
  EXPECT_EQ(port.channels()[1].geometry_id, "60");
  EXPECT_EQ(port.channels()[1].full_scale_gu, 1000.0);
  EXPECT_TRUE(is_close(port.channels()[1].tile_assigned_gu, 93.6, 0.05));  // the example of D523
}

TEST(InProcessPort, StatesTheSetUpAsBuilt) {
  InProcessPort port =
      port_of(with_quantity(nominal(), "60", SetupQuantity::theta_i,
                            {.value = degrees(60.2), .expanded_uncertainty = degrees(0.01)}));
  const auto stated = port.setup(1, SetupQuantity::theta_i);
  ASSERT_TRUE(stated);
  EXPECT_DOUBLE_EQ(stated->value.degrees(), 60.2);
  EXPECT_DOUBLE_EQ(stated->expanded_uncertainty.degrees(), 0.01);
  EXPECT_EQ(port.setup(1, SetupQuantity::receptor_diameter), std::nullopt);
}

TEST(InProcessPort, StatesASetUpWithoutAssemblingAnything) {
  int assembled = 0;
  InProcessPort port(nominal(), {}, [&](const Instrument&, const auto&) -> Device {
    ++assembled;
    throw InputError({}, "an aperture", "none");
  });
  EXPECT_TRUE(port.setup(0, SetupQuantity::theta_i));
  EXPECT_EQ(assembled, 0);
  EXPECT_THROW((void)port.status(), NotOffered);
  EXPECT_EQ(assembled, 1);
}

TEST(InProcessPort, RunsACommandToItsEnd) {
  InProcessPort port = port_of(nominal(), {"black_glass_n1567"});
  warm_up_and_calibrate(port);
  port.place(PortCover::sample, "black_glass_n1567");
  EXPECT_EQ(port.command(DeviceCommand::measure), DeviceError::none);
  const PortStatus status = port.status();
  ASSERT_EQ(status.readings.size(), 3U);
  for (const ChannelValue& reading : status.readings) {
    EXPECT_EQ(reading.status, ReadingStatus::valid);
    EXPECT_TRUE(is_close(reading.gloss_gu, 100.0, tolerance_gu));
  }
  EXPECT_EQ(status.statistics[0].n, 1);
}

TEST(InProcessPort, SaysWhyACommandIsRefused) {
  InProcessPort port = port_of(nominal());
  EXPECT_EQ(port.status().state, DeviceState::warm_up);
  EXPECT_EQ(port.command(DeviceCommand::measure), DeviceError::warming_up);
  port.pass(30.0);
  EXPECT_EQ(port.command(DeviceCommand::measure), DeviceError::not_calibrated);
  EXPECT_EQ(port.command(DeviceCommand::zero), DeviceError::not_on_trap);
}

TEST(InProcessPort, LetsTheDevicesTimePass) {
  InProcessPort port = port_of(nominal());
  warm_up_and_calibrate(port);
  EXPECT_FALSE(port.status().is_calibration_due);
  port.pass(8 * 3600.0);
  EXPECT_TRUE(port.status().is_calibration_due);
}

TEST(InProcessPort, HasNoOtherSamplesThanItWasGiven) {
  InProcessPort port = port_of(nominal(), {"black_glass_n1567"});
  EXPECT_EQ(message_of([&] { port.place(PortCover::sample, "perfect_mirror"); }),
            "there is no sample perfect_mirror");
  EXPECT_THROW(port.place(PortCover::sample, "perfect_mirror"), NotOffered);
}

TEST(InProcessPort, OffersNoReadingsWhereAnApertureIsUnknown) {
  InProcessPort port = port_of(nominal_instrument(test::shipped_standard("tappi_t480/om_15")));
  EXPECT_TRUE(port.setup(0, SetupQuantity::theta_i));
  EXPECT_THROW((void)port.command(DeviceCommand::measure), NotOffered);
}

}  // namespace
}  // namespace gonio::conformance
