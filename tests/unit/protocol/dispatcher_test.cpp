#include "emulator/protocol/dispatcher.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/hex.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/protocol/fake_unit.hpp"

namespace gonio::test {
namespace {

using modbus::Line;

/// Two units, ids 5 and 7, whose register 0 holds 0x5555 and 0x7777.
struct DispatcherOfTwo : testing::Test {
  DispatcherOfTwo() {
    five.holding_registers.values = {0x5555};
    seven.holding_registers.values = {0x7777};
  }

  /// @return  the reply; empty if there is none.
  std::string ask(Line line, std::uint8_t unit, const char* request = "03 0000 0001") {
    last = dispatcher.handle(line, unit, bytes_of_hex(request));
    return last.pdu ? hex(last.pdu->bytes()) : "";
  }

  FakeUnit five{0, 1}, seven{0, 1};
  FaultPlan faults;
  Counters counters;
  std::vector<double> steps_s;
  Dispatcher dispatcher{{{5, &five}, {7, &seven}}, faults, counters, [this](double seconds) {
                          steps_s.push_back(seconds);
                        }};
  Response last;
};

TEST_F(DispatcherOfTwo, HandsRequestsToTheUnitOfThatId) {
  for (const Line line : {Line::tcp, Line::serial}) {
    EXPECT_EQ(ask(line, 5), "03 02 55 55");
    EXPECT_EQ(ask(line, 7), "03 02 77 77");
  }
}

TEST_F(DispatcherOfTwo, TakesZeroAnd255ForTheFirstUnitOnTcp) {
  EXPECT_EQ(ask(Line::tcp, 0), "03 02 55 55");
  EXPECT_EQ(ask(Line::tcp, 255), "03 02 55 55");
}

TEST_F(DispatcherOfTwo, SaysThatNobodyIsThereOnTcp) {
  EXPECT_EQ(ask(Line::tcp, 6), "83 0B");
  EXPECT_EQ(ask(Line::tcp, 248), "83 0B");
}

TEST_F(DispatcherOfTwo, IgnoresTheUnitsOfOthersOnASerialLine) {
  EXPECT_EQ(ask(Line::serial, 6), "");
  EXPECT_EQ(ask(Line::serial, 255), "");
  EXPECT_EQ(counters.requests, 0U);
}

TEST_F(DispatcherOfTwo, LetsAllUnitsObeyABroadcastWithoutAReply) {
  EXPECT_EQ(ask(Line::serial, 0, "06 0000 1234"), "");
  EXPECT_EQ(ask(Line::serial, 5), "03 02 12 34");
  EXPECT_EQ(ask(Line::serial, 7), "03 02 12 34");
  EXPECT_EQ(ask(Line::serial, 0, "06 0001 1234"), "") << "an exception";
}

TEST_F(DispatcherOfTwo, KnowsTheFunctionCodesOfTheLine) {
  EXPECT_EQ(ask(Line::serial, 5, "08 0000 1234"), "08 00 00 12 34");
  EXPECT_EQ(ask(Line::tcp, 5, "08 0000 1234"), "88 01");
}

TEST_F(DispatcherOfTwo, CountsRequestsExceptionsAndFunctionCodes) {
  (void)ask(Line::tcp, 5);
  (void)ask(Line::tcp, 6);                     // nobody
  (void)ask(Line::tcp, 5, "06 0009 0000");     // no such register
  (void)ask(Line::serial, 0, "06 0000 0000");  // broadcast
  (void)ask(Line::tcp, 5, "83");               // counts as 3
  EXPECT_EQ(counters.requests, 5U);
  EXPECT_EQ(counters.exceptions, 3U);
  EXPECT_EQ(counters.by_function[3], 3U);
  EXPECT_EQ(counters.by_function[6], 2U);
}

TEST_F(DispatcherOfTwo, AnswersWithTheExceptionOfAFaultAndDoesNothing) {
  faults.add({.fault = WireFault::exception,
              .code = modbus::Exception::server_device_busy,
              .function = 6,
              .count = 1});
  EXPECT_EQ(ask(Line::tcp, 5, "06 0000 1234"), "86 06");
  EXPECT_EQ(ask(Line::tcp, 5), "03 02 55 55");
  EXPECT_EQ(counters.injected_faults, 1U);
  EXPECT_EQ(ask(Line::tcp, 5, "06 0000 1234"), "06 00 00 12 34");
}

/// As when the reply is lost on its way.
TEST_F(DispatcherOfTwo, ObeysARequestWhoseReplyAFaultSpoils) {
  faults.add({.fault = WireFault::no_reply, .count = 1});
  (void)ask(Line::tcp, 5, "06 0000 1234");
  ASSERT_TRUE(last.fault);
  EXPECT_EQ(last.fault->fault, WireFault::no_reply);
  EXPECT_EQ(ask(Line::tcp, 5), "03 02 12 34");
  EXPECT_FALSE(last.fault);
}

TEST_F(DispatcherOfTwo, StrikesByTheUnitThatIsMeant) {
  faults.add(
      {.fault = WireFault::exception, .code = modbus::Exception::server_device_failure, .unit = 5});
  EXPECT_EQ(ask(Line::tcp, 0), "83 04");
  EXPECT_EQ(ask(Line::tcp, 255), "83 04");
  EXPECT_EQ(ask(Line::tcp, 5), "83 04");
  EXPECT_EQ(ask(Line::tcp, 7), "03 02 77 77");
}

TEST_F(DispatcherOfTwo, StrikesUnitsThatAreNotThereOnTcp) {
  faults.add({.fault = WireFault::close, .unit = 99});
  (void)ask(Line::tcp, 99);
  EXPECT_TRUE(last.fault);
}

TEST_F(DispatcherOfTwo, LeavesBroadcastsAlone) {
  faults.add({.fault = WireFault::exception, .code = modbus::Exception::server_device_failure});
  (void)ask(Line::serial, 0, "06 0000 1234");
  EXPECT_EQ(five.holding_registers.values[0], 0x1234);
}

TEST_F(DispatcherOfTwo, LetsAllTimePassInStepsThatAreNotTooFine) {
  constexpr double enough_s = 0.02, finest_s = 0.0005;
  double sum_s = 0.0;
  const auto began = Dispatcher::Clock::now();
  dispatcher.catch_up();
  steps_s.clear();
  const auto first = Dispatcher::Clock::now();
  while (sum_s < enough_s) {
    (void)ask(Line::tcp, 5);
    sum_s = 0.0;
    for (const double step_s : steps_s) {
      EXPECT_GE(step_s, finest_s);
      sum_s += step_s;
    }
  }
  const std::chrono::duration<double> longest = Dispatcher::Clock::now() - began;
  const std::chrono::duration<double> shortest = Dispatcher::Clock::now() - first;
  EXPECT_LE(sum_s, longest.count() + finest_s);
  EXPECT_GE(sum_s, shortest.count() - 2.0 * finest_s);
}

TEST(Dispatcher, LivesByASteadyClock) { EXPECT_TRUE(Dispatcher::Clock::is_steady); }

TEST(Dispatcher, RefusesIdsOutOfRangeOrTwice) {
  FakeUnit unit(0, 1);
  FaultPlan faults;
  Counters counters;
  const auto message = [&](std::vector<ServedUnit> units) {
    return message_of([&] { Dispatcher(std::move(units), faults, counters, [](double) {}); });
  };
  EXPECT_EQ(message({{0, &unit}}), "unit ids: expected different ones in [1, 247], found '0'");
  EXPECT_EQ(message({{248, &unit}}), "unit ids: expected different ones in [1, 247], found '248'");
  EXPECT_EQ(message({{3, &unit}, {3, &unit}}),
            "unit ids: expected different ones in [1, 247], found '3'");
  EXPECT_EQ(message({}), "unit ids: expected at least one unit");
  EXPECT_EQ(message({{1, &unit}, {247, &unit}}), "no error");
}

}  // namespace
}  // namespace gonio::test
