#include "emulator/protocol/fault_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

using test::message_of;
using Bytes = std::vector<std::uint8_t>;

FaultRule rule(const std::string& text) {
  return read_fault_rule(YamlNode::parse(text, "--fault"));
}
std::string rule_error(const std::string& text) {
  return message_of([&] { (void)rule(text); });
}

/// Whether a plan of that one rule strikes a request to unit 1.
bool strikes(const std::string& text, const Bytes& request, std::uint8_t unit = 1) {
  FaultPlan plan;
  plan.add(rule(text));
  return plan.strike(unit, request).has_value();
}

const Bytes read_3_from_10{3, 0, 10, 0, 3};

// Reading.

TEST(ReadFaultRule, TakesEveryFaultByName) {
  const std::vector<std::pair<std::string, WireFault>> faults = {
      {"{fault: delay, time: 20 ms}", WireFault::delay},
      {"{fault: no_reply}", WireFault::no_reply},
      {"{fault: exception, code: 6}", WireFault::exception},
      {"{fault: wrong_transaction}", WireFault::wrong_transaction},
      {"{fault: split, time: 1.5 s}", WireFault::split},
      {"{fault: truncated}", WireFault::truncated},
      {"{fault: stray}", WireFault::stray},
      {"{fault: corrupt_crc}", WireFault::corrupt_crc},
      {"{fault: close}", WireFault::close}};
  for (const auto& [text, fault] : faults) {
    EXPECT_EQ(rule(text).fault, fault) << text;
    EXPECT_THAT(text, testing::HasSubstr(std::string(name_of(fault))));
  }
}

TEST(ReadFaultRule, TakesEveryKey) {
  const FaultRule read = rule(
      "{fault: exception, code: 11, unit: 2, function: 3, addresses: 5-9, count: 7, probability: "
      "0.25}");
  EXPECT_EQ(read.code, modbus::Exception::gateway_target_failed);
  EXPECT_EQ(read.unit, 2);
  EXPECT_EQ(read.function, 3);
  EXPECT_EQ(read.addresses, std::pair(std::uint16_t{5}, std::uint16_t{9}));
  EXPECT_EQ(read.count, 7U);
  EXPECT_EQ(read.probability, 0.25);
  EXPECT_EQ(rule("{fault: split, time: 1.5 s}").time, std::chrono::milliseconds(1500));
  EXPECT_EQ(rule("{fault: close, addresses: 4}").addresses,
            std::pair(std::uint16_t{4}, std::uint16_t{4}));
}

TEST(ReadFaultRule, LeavesWhatIsNotGivenOpen) {
  const FaultRule read = rule("{fault: no_reply}");
  EXPECT_FALSE(read.unit || read.function || read.addresses || read.count);
  EXPECT_EQ(read.probability, 1.0);
}

TEST(ReadFaultRule, RefusesAnUnknownFault) {
  EXPECT_EQ(rule_error("{fault: explode}"),
            "--fault:1:9: fault: expected one of delay, no_reply, exception, wrong_transaction, "
            "split, truncated, stray, corrupt_crc, close, found 'explode'");
  EXPECT_EQ(rule_error("{count: 1}"),
            "--fault:1:1: fault: expected the key 'fault', found 'only count'");
  EXPECT_EQ(rule_error("delay"), "--fault:1:1: expected a map of keys and values, found 'delay'");
}

TEST(ReadFaultRule, RefusesKeysThatMeanNothingForTheFault) {
  EXPECT_EQ(rule_error("{fault: no_reply, time: 1 s}"),
            "--fault:1:19: time: expected one of the keys addresses, count, fault, function, "
            "probability, unit, found 'time'");
  EXPECT_EQ(rule_error("{fault: delay, time: 1 s, code: 4}"),
            "--fault:1:27: code: expected one of the keys addresses, count, fault, function, "
            "probability, time, unit, found 'code'");
  EXPECT_EQ(rule_error("{fault: exception, code: 4, time: 1 s}"),
            "--fault:1:29: time: expected one of the keys addresses, code, count, fault, function, "
            "probability, unit, found 'time'");
}

TEST(ReadFaultRule, RefusesAFaultWithoutWhatItNeeds) {
  EXPECT_EQ(rule_error("{fault: delay}"),
            "--fault:1:1: time: expected the key 'time', found 'only fault'");
  EXPECT_EQ(rule_error("{fault: split, count: 1}"),
            "--fault:1:1: time: expected the key 'time', found 'only fault, count'");
  EXPECT_EQ(rule_error("{fault: exception}"),
            "--fault:1:1: code: expected the key 'code', found 'only fault'");
}

struct BadValue {
  std::string key, value, expected;
};

TEST(ReadFaultRule, RefusesValuesOutsideTheirRange) {
  const std::string address = "an address or a range of them in [0, 65535], e.g. 0-9";
  const std::vector<BadValue> bad = {{"unit", "0", "a whole number in [1, 247]"},
                                     {"unit", "248", "a whole number in [1, 247]"},
                                     {"function", "0", "a whole number in [1, 127]"},
                                     {"function", "128", "a whole number in [1, 127]"},
                                     {"function", "3.5", "a whole number in [1, 127]"},
                                     {"count", "0", "a whole number in [1, 1000000000]"},
                                     {"probability", "0", "a number in (0, 1]"},
                                     {"probability", "1.01", "a number in (0, 1]"},
                                     {"probability", "nan", "a number in (0, 1]"},
                                     {"addresses", "65536", address},
                                     {"addresses", "9-0", address},
                                     {"addresses", "0-65536", address},
                                     {"addresses", "-1", address},
                                     {"addresses", "0--0", address},
                                     {"addresses", "1-", address},
                                     {"addresses", "0x10", address},
                                     {"addresses", "1-2-3", address}};
  for (const BadValue& value : bad) {
    const std::string line = "fault: no_reply\n" + value.key + ": ";
    EXPECT_EQ(rule_error(line + value.value), "--fault:2:" + std::to_string(value.key.size() + 3) +
                                                  ": " + value.key + ": expected " +
                                                  value.expected + ", found '" + value.value + "'");
  }
  for (const char* code : {"1", "3", "5", "12", "0x06", "busy"}) {
    EXPECT_EQ(
        rule_error(std::string("{fault: exception, code: ") + code + "}"),
        std::string("--fault:1:26: code: expected one of 4, 6, 10, 11, found '") + code + "'");
  }
  EXPECT_THAT(
      rule_error("{fault: delay, time: 0 s}"),
      testing::MatchesRegex("--fault:1:22: time: expected a.* in \\[0.001, 600\\], found '0 s'"));
}

TEST(ReadFaultRule, RefusesAddressesOfAFunctionThatHasNone) {
  EXPECT_EQ(rule_error("{fault: close, function: 43, addresses: 0-9}"),
            "--fault:1:41: addresses: expected addresses only with a function code that has some, "
            "found '0-9'");
}

TEST(ReadFaultRules, ReadsAListInItsOrderAndNamesABadItem) {
  const auto rules =
      read_fault_rules(YamlNode::parse("[{fault: close}, {fault: stray, count: 2}]", "a.yaml"));
  ASSERT_EQ(rules.size(), 2U);
  EXPECT_EQ(rules[0].fault, WireFault::close);
  EXPECT_EQ(rules[1].fault, WireFault::stray);
  EXPECT_TRUE(read_fault_rules(YamlNode::parse("[]", "a.yaml")).empty());
  EXPECT_THAT(message_of([] {
                (void)read_fault_rules(YamlNode::parse("[{fault: close}, {fault: x}]", "a.yaml"));
              }),
              testing::StartsWith("a.yaml:1:26: [1].fault: expected one of delay,"));
}

TEST(ReadAnyFault, TellsTheKindByTheName) {
  const auto read = [](const std::string& text) {
    return read_any_fault(YamlNode::parse(text, "--fault"));
  };
  EXPECT_EQ(std::get<FaultRule>(read("{fault: corrupt_crc, count: 3}")).count, 3U);
  const auto dirty =
      std::get<TimedFault>(read("{fault: tile_dirty, after: 1 min, magnitude: 0.02}"));
  EXPECT_EQ(dirty.fault, InstrumentFault::tile_dirty);
  EXPECT_EQ(dirty.after_s, 60.0);
  EXPECT_EQ(dirty.magnitude, 0.02);
  EXPECT_EQ(message_of([&] { (void)read("{fault: explode}"); }),
            "--fault:1:9: fault: expected one of delay, no_reply, exception, wrong_transaction, "
            "split, truncated, stray, corrupt_crc, close, lamp_failure, over_range, "
            "frozen_reading, drift_step, tile_dirty, found 'explode'");
  EXPECT_THAT(message_of([&] { (void)read("{fault: lamp_failure, after: 0 s, count: 1}"); }),
              testing::StartsWith("--fault:1:35: count: expected one of the keys"));
}

TEST(ReadWire, TakesUnitAndFaults) {
  const WireOptions wire =
      read_wire(YamlNode::parse("{unit: 7, faults: [{fault: close}]}", "a.yaml"));
  EXPECT_EQ(wire.unit, 7);
  ASSERT_EQ(wire.faults.size(), 1U);
  const WireOptions none = read_wire(YamlNode::parse("{}", "a.yaml"));
  EXPECT_EQ(none.unit, 1);
  EXPECT_TRUE(none.faults.empty());
}

TEST(ReadWire, RefusesUnitsThatNoServerHasAndUnknownKeys) {
  for (const std::string unit : {"0", "248"}) {
    EXPECT_EQ(message_of([&] { (void)read_wire(YamlNode::parse("unit: " + unit, "a.yaml")); }),
              "a.yaml:1:7: unit: expected a whole number in [1, 247], found '" + unit + "'");
  }
  EXPECT_EQ(message_of([] { (void)read_wire(YamlNode::parse("{fault: []}", "a.yaml")); }),
            "a.yaml:1:2: fault: expected one of the keys faults, unit, found 'fault'");
}

// Which requests.

TEST(FaultPlan, WithoutRulesLetsEverythingPass) {
  EXPECT_FALSE(FaultPlan().strike(1, read_3_from_10));
}

TEST(FaultPlan, ChoosesByUnitAndFunction) {
  EXPECT_TRUE(strikes("{fault: close}", read_3_from_10, 255));
  EXPECT_TRUE(strikes("{fault: close, unit: 2}", read_3_from_10, 2));
  EXPECT_FALSE(strikes("{fault: close, unit: 2}", read_3_from_10, 1));
  EXPECT_TRUE(strikes("{fault: close, function: 3}", read_3_from_10));
  EXPECT_FALSE(strikes("{fault: close, function: 4}", read_3_from_10));
}

TEST(FaultPlan, ChoosesRequestsThatTouchTheAddresses) {
  const auto touched = [](const std::string& addresses, const Bytes& request) {
    return strikes("{fault: close, addresses: " + addresses + "}", request);
  };
  for (const std::uint8_t function : Bytes{1, 2, 3, 4, 15, 16}) {
    const Bytes request{function, 0, 10, 0, 3, 2, 0};  // 10 to 12
    EXPECT_TRUE(touched("10", request)) << int(function);
    EXPECT_TRUE(touched("12-20", request)) << int(function);
    EXPECT_TRUE(touched("0-65535", request)) << int(function);
    EXPECT_FALSE(touched("0-9", request)) << int(function);
    EXPECT_FALSE(touched("13-20", request)) << int(function);
  }
  for (const std::uint8_t function : Bytes{5, 6, 22}) {
    const Bytes request{function, 1, 4, 0xFF, 0, 0, 0};  // 260
    EXPECT_TRUE(touched("260", request)) << int(function);
    EXPECT_FALSE(touched("261", request)) << int(function);
    EXPECT_FALSE(touched("0-259", request)) << int(function);
  }
}

TEST(FaultPlan, TakesEitherRangeOfFunctionCode23) {
  const Bytes request{23, 0, 10, 0, 2, 0, 20, 0, 1, 2, 0, 0};  // reads 10 and 11, writes 20
  for (const std::string addresses : {"11", "20", "0-10", "20-30"}) {
    EXPECT_TRUE(strikes("{fault: close, addresses: " + addresses + "}", request)) << addresses;
  }
  for (const std::string addresses : {"9", "12-19", "21"}) {
    EXPECT_FALSE(strikes("{fault: close, addresses: " + addresses + "}", request)) << addresses;
  }
}

TEST(FaultPlan, ReachesTheLastAddress) {
  const Bytes last{3, 0xFF, 0xFF, 0, 1};
  EXPECT_TRUE(strikes("{fault: close, addresses: 65535}", last));
  const Bytes beyond{3, 0xFF, 0xFF, 0, 2};  // is not right, but no reason to wrap to 0
  EXPECT_FALSE(strikes("{fault: close, addresses: 0}", beyond));
}

TEST(FaultPlan, DoesNotFindAddressesInAnEmptyOrShortRequest) {
  const std::string rule_with_addresses = "{fault: close, addresses: 0-65535}";
  for (const Bytes& request : std::vector<Bytes>{{3},
                                                 {3, 0},
                                                 {3, 0, 10},
                                                 {3, 0, 10, 0},
                                                 {6, 0},
                                                 {43, 14, 1, 0},
                                                 {17},
                                                 {8, 0, 0, 1, 2},
                                                 {3, 0, 10, 0, 0}}) {
    EXPECT_FALSE(strikes(rule_with_addresses, request)) << testing::PrintToString(request);
    EXPECT_TRUE(strikes("{fault: close}", request)) << testing::PrintToString(request);
  }
  EXPECT_FALSE(strikes("{fault: close}", {}));
}

// How often.

TEST(FaultPlan, StrikesAsOftenAsItsCountSays) {
  FaultPlan plan;
  plan.add(rule("{fault: close, count: 2}"));
  EXPECT_EQ(plan.strike(1, read_3_from_10)->count, 2U);
  EXPECT_EQ(plan.rules().front().count, 1U);
  EXPECT_TRUE(plan.strike(1, read_3_from_10));
  EXPECT_FALSE(plan.strike(1, read_3_from_10));
  EXPECT_TRUE(plan.rules().empty());
}

TEST(FaultPlan, CountsOnlyWhatItStrikes) {
  FaultPlan plan;
  plan.add(rule("{fault: close, function: 4, count: 1}"));
  EXPECT_FALSE(plan.strike(1, read_3_from_10));
  EXPECT_TRUE(plan.strike(1, Bytes{4, 0, 0, 0, 1}));
}

TEST(FaultPlan, LetsTheFirstRuleWinUntilItIsUsedUp) {
  FaultPlan plan;
  plan.add(rule("{fault: truncated, count: 1}"));
  plan.add(rule("{fault: stray}"));
  EXPECT_EQ(plan.strike(1, read_3_from_10)->fault, WireFault::truncated);
  EXPECT_EQ(plan.strike(1, read_3_from_10)->fault, WireFault::stray);
  plan.clear();
  EXPECT_FALSE(plan.strike(1, read_3_from_10));
}

/// Requests of 4000 that a rule of that probability strikes.
int struck(double probability, std::uint64_t seed) {
  FaultPlan plan(seed);
  FaultRule one = rule("{fault: close}");
  one.probability = probability;
  plan.add(one);
  int count = 0;
  for (int i = 0; i < 4000; ++i) {
    count += plan.strike(1, read_3_from_10) ? 1 : 0;
  }
  return count;
}

TEST(FaultPlan, StrikesWithItsProbability) {
  constexpr std::uint64_t seed = 7;
  constexpr double n = 4000.0, sigmas = 4.0;  // two-sided significance 6e-5
  for (const double p : {0.01, 0.25, 0.9}) {
    EXPECT_NEAR(struck(p, seed), n * p, sigmas * std::sqrt(n * p * (1.0 - p))) << p;
  }
}

TEST(FaultPlan, TriesTheNextRuleIfChanceSparesTheFirst) {
  FaultPlan plan(3);
  plan.add(rule("{fault: close, probability: 0.5}"));
  plan.add(rule("{fault: stray}"));
  int others = 0;
  for (int i = 0; i < 100; ++i) {
    others += plan.strike(1, read_3_from_10)->fault == WireFault::stray ? 1 : 0;
  }
  EXPECT_GT(others, 20);  // of 50 expected; 6 standard deviations
  EXPECT_LT(others, 80);
}

TEST(FaultPlan, RepeatsItselfWithTheSameSeedOnly) {
  EXPECT_EQ(struck(0.5, 11), struck(0.5, 11));
  FaultPlan first(11), same(11), other(12);
  int equal = 0;
  for (FaultPlan* plan : {&first, &same, &other}) {
    plan->add(rule("{fault: close, probability: 0.5}"));
  }
  for (int i = 0; i < 64; ++i) {
    const bool strike = first.strike(1, read_3_from_10).has_value();
    EXPECT_EQ(strike, same.strike(1, read_3_from_10).has_value());
    equal += strike == other.strike(1, read_3_from_10).has_value() ? 1 : 0;
  }
  EXPECT_LT(equal, 64);
}

}  // namespace
}  // namespace gonio
