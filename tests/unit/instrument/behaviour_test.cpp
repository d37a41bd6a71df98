#include "emulator/instrument/behaviour.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::message_of;

const std::vector<std::string> ids{"20", "60"};

Behaviour behaviour_of(const std::string& text) {
  return read_behaviour(YamlNode::parse(text, "b.yaml"), ids);
}
Identity identity_of(const std::string& text) {
  return read_identity(YamlNode::parse(text, "i.yaml"));
}

struct Refused {
  std::string text, message;
};

// Identity.

TEST(ReadIdentity, TakesWhatIsStated) {
  const Identity identity = identity_of(
      "manufacturer: Acme\nmodel: A-1\nserial_number: '0042'\nurl: https://acme.invalid\n"
      "calibration_date: 2024-02-29\ncalibration_text: black glass\n");
  EXPECT_EQ(identity.manufacturer, "Acme");
  EXPECT_EQ(identity.model, "A-1");
  EXPECT_EQ(identity.serial_number, "0042");
  EXPECT_EQ(identity.url, "https://acme.invalid");
  EXPECT_EQ(identity.calibration_date, "2024-02-29");
  EXPECT_EQ(identity.calibration_text, "black glass");
}

TEST(ReadIdentity, KeepsTheDefaultOfWhatIsNot) {
  const Identity identity = identity_of("model: A-1\n");
  EXPECT_EQ(identity.manufacturer, Identity().manufacturer);
  EXPECT_EQ(identity.serial_number, Identity().serial_number);
  EXPECT_EQ(identity.calibration_date, "");
}

TEST(ReadIdentity, RefusesWhatNoDisplayShows) {
  const std::string long_text(101, 'x');
  const std::vector<Refused> table{
      {"model: \"caf\xC3\xA9\"",
       "i.yaml:1:8: model: expected at most 100 printable ASCII characters, found 'caf\xC3\xA9'"},
      {"url: " + long_text,
       "i.yaml:1:6: url: expected at most 100 printable ASCII characters, "
       "found '" +
           std::string(80, 'x') + "...'"},
      {"serial_number: [1]", "i.yaml:1:16: serial_number: expected text, found 'a list'"},
      {"colour: red",
       "i.yaml:1:1: colour: expected one of the keys calibration_date, calibration_text, "
       "manufacturer, model, serial_number, url, found 'colour'"}};
  for (const Refused& row : table) {
    EXPECT_EQ(message_of([&] { (void)identity_of(row.text); }), row.message);
  }
}

TEST(ReadIdentity, RefusesWhatIsNoDate) {
  for (const char* date : {"2023-02-29", "2024-13-01", "2024-00-10", "2024-01-32", "24-01-01",
                           "2024/01/01", "2024-1-01x", "yesterday", "2024-+1-01", "2024-01--1"}) {
    EXPECT_EQ(message_of([&] { (void)identity_of(std::string("calibration_date: ") + date); }),
              std::string("i.yaml:1:19: calibration_date: expected a date YYYY-MM-DD, found '") +
                  date + "'");
  }
}

// Behaviour.

TEST(ReadBehaviour, TakesWhatIsStatedInItsUnits) {
  const Behaviour b = behaviour_of(
      "warm_up: {time: 2 min, loss: 0.02}\n"
      "reading_time: 400 ms\n"
      "resolution: 0.1 GU\n"
      "linearity: -0.001\n"
      "full_scale: {\"60\": 1000 GU, \"20\": 2000 GU}\n"
      "stray_light: 0.2 GU\n"
      "ambient_light: 0.3 GU\n"
      "lamp_drift: {per_hour: 0.0002, limit: 0.004}\n"
      "temperature: {ambient: 21.5 degC, self_heating: 6 K, signal_per_kelvin: -0.0003}\n"
      "tile: {refractive_index: 1.54, contamination: 0.01, limit: 0.5 GU}\n"
      "calibration: {time: 4 s, interval: 12 h, required: false}\n"
      "faults:\n"
      "  - {fault: drift_step, after: 1 h, magnitude: -0.02}\n"
      "  - {fault: lamp_failure, after: 60 s}\n"
      "seed: 2147483647\n");
  EXPECT_EQ(b.warm_up_s, 120.0);
  EXPECT_EQ(b.warm_up_loss, 0.02);
  EXPECT_EQ(b.reading_s, 0.4);
  EXPECT_EQ(b.resolution_gu, 0.1);
  EXPECT_EQ(b.linearity, -0.001);
  EXPECT_EQ(b.full_scale_gu, (std::vector<double>{2000.0, 1000.0}));
  EXPECT_EQ(b.stray_light_gu, 0.2);
  EXPECT_EQ(b.ambient_light_gu, 0.3);
  EXPECT_EQ(b.drift_per_h, 0.0002);
  EXPECT_EQ(b.drift_limit, 0.004);
  EXPECT_EQ(b.ambient_c, 21.5);
  EXPECT_EQ(b.self_heating_k, 6.0);
  EXPECT_EQ(b.signal_per_k, -0.0003);
  EXPECT_EQ(b.tile_index, 1.54);
  EXPECT_EQ(b.tile_contamination, 0.01);
  EXPECT_EQ(b.tile_limit_gu, 0.5);
  EXPECT_EQ(b.calibration_s, 4.0);
  EXPECT_EQ(b.calibration_interval_s, 43'200.0);
  EXPECT_FALSE(b.calibration_required);
  EXPECT_EQ(b.seed, 2147483647U);
  ASSERT_EQ(b.faults.size(), 2U);
  EXPECT_EQ(b.faults[0].fault, InstrumentFault::drift_step);
  EXPECT_EQ(b.faults[0].after_s, 3600.0);
  EXPECT_EQ(b.faults[0].magnitude, -0.02);
  EXPECT_EQ(b.faults[1].fault, InstrumentFault::lamp_failure);
  EXPECT_EQ(b.faults[1].after_s, 60.0);
  EXPECT_EQ(b.repeatability_gu, 0.0);  // stands in the instrument file itself
}

TEST(ReadBehaviour, KeepsTheDefaultOfWhatIsNotStated) {
  const Behaviour b = behaviour_of("seed: 3\n");
  const Behaviour plain;
  EXPECT_EQ(b.warm_up_s, plain.warm_up_s);
  EXPECT_EQ(b.reading_s, plain.reading_s);
  EXPECT_EQ(b.calibration_required, plain.calibration_required);
  EXPECT_TRUE(b.full_scale_gu.empty());
  EXPECT_TRUE(b.faults.empty());
}

TEST(ReadBehaviour, LeavesWhatIsNotStatedAsItWas) {
  const std::vector<std::string> channels{"20", "60"};
  Behaviour before;
  before.full_scale_gu = {2000.0, 1000.0};
  before.ambient_c = 21.0;
  before.signal_per_k = -0.001;
  before.faults = {{.fault = InstrumentFault::lamp_failure, .after_s = 1.0}};
  const auto laid_over = [&](const std::string& text) {
    return read_behaviour(YamlNode::parse(text, "b.yaml"), channels, before);
  };
  EXPECT_EQ(laid_over("{}"), before);
  Behaviour expected = before;
  expected.signal_per_k = 0.002;
  EXPECT_EQ(laid_over("temperature: {signal_per_kelvin: 0.002}"), expected);
  expected = before;
  expected.full_scale_gu = {2000.0, 500.0};
  EXPECT_EQ(laid_over("full_scale: {\"60\": 500 GU}"), expected);
  expected = before;
  expected.linearity = 0.02;
  EXPECT_EQ(laid_over("linearity: 0.02"), expected);
  expected = before;
  expected.faults = {{.fault = InstrumentFault::over_range, .after_s = 2.0}};
  EXPECT_EQ(laid_over("faults: [{fault: over_range, after: 2 s}]"), expected);
}

TEST(ReadBehaviour, RefusesWhatIsNotAsTheSchemaSays) {
  const std::vector<Refused> table{
      {"[]", ":1:1: expected a map of keys and values, found 'a list'"},
      {"noise: 1",
       ":1:1: noise: expected one of the keys ambient_light, calibration, faults, "
       "full_scale, lamp_drift, linearity, reading_time, resolution, seed, "
       "stray_light, temperature, tile, warm_up, found 'noise'"},
      {"warm_up: 30 s", ":1:10: warm_up: expected a map of keys and values, found '30 s'"},
      {"warm_up: {loss: 0.1}", ":1:10: warm_up.time: expected the key 'time', found 'only loss'"},
      {"warm_up: {time: 30 s, loss: 1}",
       ":1:29: warm_up.loss: expected a number in [0, 1), found '1'"},
      {"warm_up: {time: 30 s, colour: red}",
       ":1:23: warm_up.colour: expected one of the keys loss, time, found 'colour'"},
      {"reading_time: 0.5",
       ":1:15: reading_time: expected a time (s, ms, min, h) in [0, 3600], found '0.5'"},
      {"resolution: -0.1 GU",
       ":1:13: resolution: expected a gloss value (GU) in [0, 100], found '-0.1 GU'"},
      {"linearity: 0.001",
       ":1:12: linearity: expected the key 'full_scale' beside it, found 'none'"},
      {"linearity: 0.2\nfull_scale: {\"20\": 100 GU, \"60\": 100 GU}",
       ":1:12: linearity: expected a number in [-0.1, 0.1], found '0.2'"},
      {"full_scale: {\"20\": 100 GU}",
       ":1:13: full_scale.60: expected the key '60', found 'only 20'"},
      {"full_scale: {\"20\": 0 GU, \"60\": 100 GU}",
       ":1:20: full_scale.20: expected a gloss value (GU) in (0, 10000], found '0 GU'"},
      {"full_scale: {\"20\": 100 GU, \"60\": 100 GU, \"85\": 100 GU}",
       ":1:42: full_scale.85: expected one of the keys 20, 60, found '85'"},
      {"stray_light: 1 nm",
       ":1:14: stray_light: expected a gloss value (GU) in [0, 1000], found '1 nm'"},
      {"lamp_drift: {per_hour: 0.1}",
       ":1:13: lamp_drift.limit: expected the key 'limit', found 'only per_hour'"},
      {"lamp_drift: {per_hour: 0.1, limit: 0}",
       ":1:36: lamp_drift.limit: expected a number in (0, 1), found '0'"},
      {"temperature: {ambient: 23 K}",
       ":1:24: temperature.ambient: expected a temperature (degC) in [-20, 60], found '23 K'"},
      {"temperature: {self_heating: 6 degC}",
       ":1:29: temperature.self_heating: expected a temperature difference (K) in [0, 40], found "
       "'6 degC'"},
      {"temperature: {signal_per_kelvin: 0.02}",
       ":1:34: temperature.signal_per_kelvin: expected a number in [-0.01, 0.01], found '0.02'"},
      {"tile: {refractive_index: 1}",
       ":1:26: tile.refractive_index: expected a number in (1, 5], found '1'"},
      {"tile: {contamination: 1.1}",
       ":1:23: tile.contamination: expected a number in [0, 1], found '1.1'"},
      {"tile: {limit: 0 GU}",
       ":1:15: tile.limit: expected a gloss value (GU) in (0, 100], found '0 GU'"},
      {"calibration: {time: -1 s}",
       ":1:21: calibration.time: expected a time (s, ms, min, h) in [0, 3600], found '-1 s'"},
      {"calibration: {interval: 0 h}",
       ":1:25: calibration.interval: expected a time (s, ms, min, h) in (0, 320000000], found '0 "
       "h'"},
      {"calibration: {required: yes}",
       ":1:25: calibration.required: expected one of true, false, found 'yes'"},
      {"seed: -1", ":1:7: seed: expected a whole number in [0, 2147483647], found '-1'"},
      {"faults: []", ":1:9: faults: expected a list of at least one item, found 'a list'"},
      {"faults: [{fault: smoke, after: 1 s}]",
       ":1:18: faults[0].fault: expected one of lamp_failure, over_range, frozen_reading, "
       "drift_step, tile_dirty, found 'smoke'"},
      {"faults: [{fault: over_range}]",
       ":1:10: faults[0].after: expected the key 'after', found 'only fault'"},
      {"faults: [{fault: drift_step, after: 1 s}]",
       ":1:10: faults[0].magnitude: expected the key 'magnitude', found 'only fault, after'"},
      {"faults: [{fault: tile_dirty, after: 1 s, magnitude: 2}]",
       ":1:53: faults[0].magnitude: expected a number in [0, 1], found '2'"},
      {"faults: [{fault: lamp_failure, after: 1 s, magnitude: 1}]",
       ":1:44: faults[0].magnitude: expected one of the keys after, fault, found 'magnitude'"}};
  for (const Refused& row : table) {
    EXPECT_EQ(message_of([&] { (void)behaviour_of(row.text); }), "b.yaml" + row.message);
  }
}

// Faults by name.

TEST(InstrumentFaultNames, StandForTheirFaults) {
  for (std::size_t i = 0; i < instrument_fault_count; ++i) {
    EXPECT_EQ(instrument_fault(instrument_fault_names[i]), InstrumentFault(i));
  }
  EXPECT_EQ(instrument_fault("tile_dirty"), InstrumentFault::tile_dirty);
  EXPECT_EQ(instrument_fault("smoke"), std::nullopt);
}

// Ideal.

TEST(IdealBehaviour, HasNoDeviationsAndTakesNoTime) {
  Behaviour b;
  b.repeatability_gu = b.resolution_gu = b.stray_light_gu = b.ambient_light_gu = 1.0;
  b.warm_up_loss = b.linearity = b.drift_per_h = b.drift_limit = b.signal_per_k = 0.1;
  b.tile_contamination = 0.5;
  b.full_scale_gu = {100.0, 100.0};
  b.faults = {{InstrumentFault::lamp_failure, 1.0}};
  b.tile_index = 1.54;
  b.seed = 7;
  const Behaviour ideal = b.ideal();
  for (const double none :
       {ideal.warm_up_s, ideal.warm_up_loss, ideal.reading_s, ideal.calibration_s,
        ideal.repeatability_gu, ideal.resolution_gu, ideal.linearity, ideal.stray_light_gu,
        ideal.ambient_light_gu, ideal.drift_per_h, ideal.drift_limit, ideal.signal_per_k,
        ideal.tile_contamination}) {
    EXPECT_EQ(none, 0.0);
  }
  EXPECT_FALSE(ideal.calibration_required);
  EXPECT_TRUE(ideal.full_scale_gu.empty());
  EXPECT_TRUE(ideal.faults.empty());
  EXPECT_EQ(ideal.tile_index, 1.54);  // the same instrument
  EXPECT_EQ(ideal.seed, 7U);
}

}  // namespace
TEST(Displayed, IsTheNearestDecimalFractionOfTheDisplay) {
  EXPECT_EQ(displayed(51.93, 0.1), 51.9);
  EXPECT_EQ(displayed(51.96, 0.1), 52.0);
  EXPECT_EQ(displayed(50.3, 0.5), 50.5);
  EXPECT_EQ(displayed(50.3, 2.0), 50.0);
  EXPECT_EQ(displayed(0.123456, 0.001), 0.123);
  EXPECT_EQ(displayed(51.93, 0.0), 51.93);
}

TEST(Displayed, HasNoNegativeZero) { EXPECT_FALSE(std::signbit(displayed(-0.04, 0.1))); }

}  // namespace gonio
