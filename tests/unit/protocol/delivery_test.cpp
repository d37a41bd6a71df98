#include "emulator/protocol/delivery.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/hex.hpp"

namespace gonio::test {
namespace {

using std::chrono::milliseconds;

modbus::Pdu reply() {
  modbus::Pdu pdu;
  pdu.append(bytes_of_hex("03 02 1234"));
  return pdu;
}

/// A delivery in one line, e.g. "01 02 | 50 ms | 03 04 | close".
std::string text_of(const Delivery& delivery) {
  std::string text = hex(delivery.first);
  if (!delivery.then.empty()) {
    text += fmt::format(" | {} ms | {}", delivery.pause.count(), hex(delivery.then));
  }
  return text + (delivery.close ? " | close" : "");
}

std::string over_tcp(WireFault fault) {
  const FaultRule rule{.fault = fault, .time = milliseconds(50)};
  return text_of(faulty_tcp_reply(rule, 0xFFFF, 9, reply()));
}

std::string over_rtu(WireFault fault, std::uint8_t unit = 9) {
  const FaultRule rule{.fault = fault, .time = milliseconds(50)};
  return text_of(faulty_rtu_reply(rule, unit, reply()));
}

TEST(TcpDelivery, IsLateWithDelay) {
  EXPECT_EQ(over_tcp(WireFault::delay), " | 50 ms | FF FF 00 00 00 05 09 03 02 12 34");
}

TEST(TcpDelivery, IsNothingWithNoReply) { EXPECT_EQ(over_tcp(WireFault::no_reply), ""); }

TEST(TcpDelivery, IsTheExceptionThatItWasGiven) {
  EXPECT_EQ(over_tcp(WireFault::exception), "FF FF 00 00 00 05 09 03 02 12 34");
}

TEST(TcpDelivery, HasTheNextTransactionIdWithWrongTransaction) {
  EXPECT_EQ(over_tcp(WireFault::wrong_transaction), "00 00 00 00 00 05 09 03 02 12 34");
}

TEST(TcpDelivery, IsCutInTheMiddleWithSplit) {
  EXPECT_EQ(over_tcp(WireFault::split), "FF FF 00 00 00 | 50 ms | 05 09 03 02 12 34");
}

TEST(TcpDelivery, EndsInTheMiddleWithTruncated) {
  EXPECT_EQ(over_tcp(WireFault::truncated), "FF FF 00 00 00");
}

TEST(TcpDelivery, ComesAfterAnotherWithStray) {
  EXPECT_EQ(over_tcp(WireFault::stray),
            "00 00 00 00 00 05 09 03 02 12 34 FF FF 00 00 00 05 09 03 02 12 34");
}

TEST(TcpDelivery, HasAnotherProtocolIdWithCorruptCrc) {
  EXPECT_EQ(over_tcp(WireFault::corrupt_crc), "FF FF 00 01 00 05 09 03 02 12 34");
}

TEST(TcpDelivery, IsTheEndOfTheConnectionWithClose) {
  EXPECT_EQ(over_tcp(WireFault::close), " | close");
}

TEST(RtuDelivery, IsLateWithDelay) {
  EXPECT_EQ(over_rtu(WireFault::delay), " | 50 ms | 09 03 02 12 34 54 F2");
}

TEST(RtuDelivery, IsNothingWithNoReply) { EXPECT_EQ(over_rtu(WireFault::no_reply), ""); }

TEST(RtuDelivery, IsTheExceptionThatItWasGiven) {
  EXPECT_EQ(over_rtu(WireFault::exception), "09 03 02 12 34 54 F2");
}

TEST(RtuDelivery, IsOfTheNextUnitWithWrongTransaction) {
  EXPECT_EQ(over_rtu(WireFault::wrong_transaction), "0A 03 02 12 34 10 F2");
  EXPECT_EQ(over_rtu(WireFault::wrong_transaction, 247).substr(0, 2), "F8");
}

TEST(RtuDelivery, IsCutInTheMiddleWithSplit) {
  EXPECT_EQ(over_rtu(WireFault::split), "09 03 02 | 50 ms | 12 34 54 F2");
}

TEST(RtuDelivery, EndsInTheMiddleWithTruncated) {
  EXPECT_EQ(over_rtu(WireFault::truncated), "09 03 02");
}

TEST(RtuDelivery, ComesAfterAnotherWithStray) {
  EXPECT_EQ(over_rtu(WireFault::stray), "0A 03 02 12 34 10 F2 09 03 02 12 34 54 F2");
}

TEST(RtuDelivery, HasAWrongCrcWithCorruptCrc) {
  EXPECT_EQ(over_rtu(WireFault::corrupt_crc), "09 03 02 12 34 54 0D");
}

}  // namespace
}  // namespace gonio::test
