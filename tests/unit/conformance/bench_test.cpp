#include "tests/conformance/bench.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/conformance/fake_port.hpp"
#include "tests/unit/expect_close.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using test::bench_with;
using test::FakePort;
using test::is_close;
using test::message_of;

constexpr double rounding = 1e-12;

TEST(Bench, PreparesOnceUntilItForgets) {
  FakePort port;
  Bench bench = bench_with(port);
  bench.prepare();
  bench.prepare();
  EXPECT_EQ(port.count(DeviceCommand::zero), 1);
  EXPECT_EQ(port.count(DeviceCommand::calibrate), 1);
  bench.forget();
  bench.prepare();
  EXPECT_EQ(port.count(DeviceCommand::calibrate), 2);
}

TEST(Bench, FindsTheZeroBeforeItCalibrates) {
  FakePort port;
  port.warm_up_s = 0.0;
  bench_with(port).prepare();
  EXPECT_EQ(port.log, (std::vector<std::string>{
                          "place black_trap", fmt::format("command {}", int(DeviceCommand::zero)),
                          "place tile", fmt::format("command {}", int(DeviceCommand::calibrate))}));
}

TEST(Bench, WaitsUntilTheDeviceIsWarm) {
  FakePort port;
  port.warm_up_s = 12.0;
  bench_with(port).wait_until_ready();
  EXPECT_EQ(port.count("pass 5 s"), 3);
}

TEST(Bench, GivesUpOnADeviceThatNeverGetsWarm) {
  FakePort port;
  port.warm_up_s = 1e9;
  Bench bench = bench_with(port);
  EXPECT_THROW(bench.wait_until_ready(), DeviceRefused);
}

TEST(Bench, SaysWhatTheDeviceRefuses) {
  FakePort port;
  port.refusals[DeviceCommand::zero] = DeviceError::zero_out_of_tolerance;
  Bench bench = bench_with(port);
  EXPECT_EQ(message_of([&] { bench.prepare(); }),
            "the device does not find its zero: the zero is out of tolerance");
  EXPECT_THROW(bench.prepare(), DeviceRefused);
}

TEST(Bench, KnowsAChannelByItsGeometry) {
  FakePort port;
  std::swap(port.known.front(), port.known.back());
  Bench bench = bench_with(port);
  EXPECT_EQ(bench.channel("20"), 2U);
  EXPECT_EQ(bench.channel("85"), 0U);
  EXPECT_EQ(bench.channel("45"), std::nullopt);
}

TEST(Bench, KnowsAChannelOfUnknownGeometryByItsAngle) {
  FakePort port;
  for (PortChannel& channel : port.known) {
    channel.geometry_id.clear();
  }
  port.known[1].theta_i = degrees(45.0);
  Bench bench = bench_with(port);
  EXPECT_EQ(bench.channel("85"), 2U);
  EXPECT_EQ(bench.channel("60"), std::nullopt);
}

TEST(Bench, ReadsAsOftenAsAsked) {
  FakePort port;
  port.laid["panel"] = {.gloss_gu = {10.0, 20.0, 30.0}, .scatter = {0.0, 0.1, 0.5}};
  Bench bench = bench_with(port);
  bench.prepare();
  const auto readings = bench.read(PortCover::sample, "panel", 3);
  ASSERT_EQ(readings.size(), 3U);
  EXPECT_EQ(readings[1].geometry, "60");
  EXPECT_EQ(readings[1].gloss_gu, (std::vector{20.0, 20.1, 20.5}));
  EXPECT_TRUE(is_close(readings[1].mean_gu(), 20.2, rounding));
  EXPECT_TRUE(is_close(readings[1].deviation_gu(), std::sqrt(0.07), rounding));
}

TEST(Bench, ToldOverRangeOnceKeepsItInMind) {
  FakePort port;
  port.known[0].full_scale_gu = 100.0;
  port.laid["panel"] = {.gloss_gu = {99.5, 20.0, 30.0}, .scatter = {0.0, 1.0}};
  Bench bench = bench_with(port);
  bench.prepare();
  const auto readings = bench.read(PortCover::sample, "panel", 2);
  EXPECT_TRUE(readings[0].is_over_range);
  EXPECT_EQ(readings[0].gloss_gu.size(), 1U);
  EXPECT_FALSE(readings[1].is_over_range);
}

/// U of a mean of equal readings: nothing but the step of the display.
double uncertainty_of_display(const std::vector<double>& shown) {
  FakePort port;
  port.laid["panel"] = {.gloss_gu = shown};
  Bench bench = bench_with(port);
  bench.prepare();
  return bench.expanded_uncertainty_gu(bench.read(PortCover::sample, "panel", 2)[0]);
}

TEST(BenchUncertainty, OfReadingsThatScatterIsThatOfTheirMean) {
  FakePort port;
  port.laid["panel"] = {.gloss_gu = {10.0, 20.0, 30.0}, .scatter = {0.0, 0.2, 0.4, 0.2}};
  Bench bench = bench_with(port);
  bench.prepare();
  const ChannelReadings readings = bench.read(PortCover::sample, "panel", 4)[0];
  const double of_one = std::hypot(readings.deviation_gu(), 0.1 / std::sqrt(12.0));
  EXPECT_TRUE(is_close(bench.expanded_uncertainty_gu(readings), of_one, rounding));  // 2 / sqrt(4)
}

TEST(BenchUncertainty, OfReadingsThatAreAllTheSameDoesNotShrinkWithTheirNumber) {
  FakePort port;
  Bench bench = bench_with(port);
  const ChannelReadings many{.geometry = "60", .gloss_gu = std::vector(100, 12.3)};
  EXPECT_TRUE(is_close(bench.expanded_uncertainty_gu(many), 0.2 / std::sqrt(12.0), rounding));
}

TEST(BenchUncertainty, FindsTheStepOfTheDisplayFromReadings) {
  const double coverage = 2.0 / std::sqrt(12.0);
  EXPECT_TRUE(is_close(uncertainty_of_display({10.1, 20.0, 30.0}), 0.1 * coverage, rounding));
  EXPECT_TRUE(is_close(uncertainty_of_display({10.11, 20.0, 30.0}), 0.01 * coverage, rounding));
  EXPECT_LT(uncertainty_of_display({10.11234, 20.0, 30.0}), 1e-5);
}

TEST(BenchUncertainty, TakesNumbersOfAWireForTheDecimalsTheyShow) {
  const double coverage = 2.0 / std::sqrt(12.0);
  for (const double as_float : {double(2037.6F), double(0.1F), double(-0.3F)}) {
    EXPECT_TRUE(is_close(uncertainty_of_display({as_float, 20.0, 30.0}), 0.1 * coverage, rounding));
  }
  const double with_hundredths = double(2037.61F);
  EXPECT_TRUE(
      is_close(uncertainty_of_display({with_hundredths, 20.0, 30.0}), 0.01 * coverage, rounding));
}

TEST(BenchUncertainty, OfASingleReadingIsThatOfTheDisplay) {
  FakePort port;
  Bench bench = bench_with(port);
  const ChannelReadings one{.geometry = "60", .gloss_gu = {12.3}};
  EXPECT_TRUE(is_close(bench.expanded_uncertainty_gu(one), 0.2 / std::sqrt(12.0), rounding));
}

TEST(Bench, PassesOnThatTheDeviceIsLost) {
  FakePort port;
  port.is_lost = true;
  Bench bench = bench_with(port);
  EXPECT_THROW(bench.prepare(), DeviceLost);
}

}  // namespace
}  // namespace gonio::conformance
