#include "emulator/protocol/pdu.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/unit/hex.hpp"
#include "tests/unit/protocol/fake_unit.hpp"

namespace gonio::modbus {
namespace {

using test::bytes_of_hex;
using test::hex;

/// Tables of 2100 places from 0x0010 on, up to 0x0843.
class PduAnswer : public testing::Test {
 protected:
  test::FakeUnit unit{0x0010, 2100};

  std::string reply(const std::string& request, Line line = Line::tcp) {
    return hex(answer(bytes_of_hex(request), unit, line).bytes());
  }
  /// `request` followed by `count` bytes of 0x55.
  std::string reply_with_data(const std::string& request, std::size_t count) {
    test::Bytes bytes = bytes_of_hex(request);
    bytes.insert(bytes.end(), count, 0x55);
    return hex(answer(bytes, unit, Line::tcp).bytes());
  }
};

/// A fact about a request and its reply, by name.
struct Fact {
  const char* name;
  const char* request;
  const char* reply;
};
void PrintTo(const Fact& fact, std::ostream* out) { *out << fact.request; }

class PduException : public PduAnswer, public testing::WithParamInterface<Fact> {};

TEST_P(PduException, IsGivenAndNothingChanges) {
  const test::FakeUnit before = unit;
  for (const Line line : {Line::tcp, Line::serial}) {
    EXPECT_EQ(reply(GetParam().request, line), GetParam().reply);
  }
  EXPECT_TRUE(unit.has_same_values(before));
}

const auto name_of = [](const auto& info) { return std::string(info.param.name); };

INSTANTIATE_TEST_SUITE_P(FunctionCode, PduException,
                         testing::Values(Fact{"Zero", "00", "80 01"},         //
                                         Fact{"Seven", "07", "87 01"},        //
                                         Fact{"Nine", "09 0010", "89 01"},    //
                                         Fact{"Fourteen", "14 00", "94 01"},  //
                                         Fact{"FortyOne", "29 00", "A9 01"},  //
                                         Fact{"X41", "41", "C1 01"},          //
                                         Fact{"X7F", "7F", "FF 01"},          //
                                         Fact{"X83", "83 0010 0001", "83 01"},
                                         Fact{"XFF", "FF", "FF 01"}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(
    Reads, PduException,
    testing::Values(
        Fact{"CoilsNone", "01 0010 0000", "81 03"}, Fact{"CoilsTooMany", "01 0010 07D1", "81 03"},
        Fact{"CoilsTooManyElsewhere", "01 F000 07D1", "81 03"},
        Fact{"CoilsPastEnd", "01 0843 0002", "81 02"},
        Fact{"CoilsPastAddresses", "01 FFFF 0002", "81 02"},
        Fact{"CoilsShort", "01 0010 00", "81 03"}, Fact{"CoilsLong", "01 0010 0001 00", "81 03"},
        Fact{"InputsNone", "02 0010 0000", "82 03"}, Fact{"InputsTooMany", "02 0010 07D1", "82 03"},
        Fact{"InputsBefore", "02 000F 0001", "82 02"},
        Fact{"InputsPastAddresses", "02 FFFF 07D0", "82 02"},
        Fact{"InputsLong", "02 0010 0001 00", "82 03"},
        Fact{"HoldingNone", "03 0010 0000", "83 03"},
        Fact{"HoldingTooMany", "03 0010 007E", "83 03"},
        Fact{"HoldingLowByteOfCountGood", "03 0010 0101", "83 03"},
        Fact{"HoldingPastEnd", "03 0843 0002", "83 02"},
        Fact{"HoldingPastAddresses", "03 FFFF 0002", "83 02"},
        Fact{"HoldingNoneElsewhere", "03 F000 0000", "83 03"}, Fact{"HoldingBare", "03", "83 03"},
        Fact{"HoldingShort", "03 0010 00", "83 03"},
        Fact{"HoldingLong", "03 0010 0001 DEAD BEEF", "83 03"},
        Fact{"InputRegistersNone", "04 0010 0000", "84 03"},
        Fact{"InputRegistersTooMany", "04 0010 007E", "84 03"},
        Fact{"InputRegistersPastEnd", "04 0844 0001", "84 02"},
        Fact{"InputRegistersPastAddresses", "04 FF90 007D", "84 02"},
        Fact{"InputRegistersShort", "04 0010", "84 03"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Writes, PduException,
    testing::Values(Fact{"CoilOddValue", "05 0010 1234", "85 03"},
                    Fact{"CoilAlmostOn", "05 0010 FF01", "85 03"},
                    Fact{"CoilOddValueElsewhere", "05 F000 1234", "85 03"},
                    Fact{"CoilElsewhere", "05 F000 FF00", "85 02"},
                    Fact{"CoilLastAddress", "05 FFFF FF00", "85 02"},
                    Fact{"CoilShort", "05 0010 FF", "85 03"},
                    Fact{"CoilLong", "05 0010 FF00 00", "85 03"},
                    Fact{"RegisterElsewhere", "06 F000 1234", "86 02"},
                    Fact{"RegisterShort", "06 0010", "86 03"},
                    Fact{"RegisterLong", "06 0010 1234 56", "86 03"},
                    Fact{"CoilsNone", "0F 0010 0000 00", "8F 03"},
                    Fact{"CoilsTooFewBytes", "0F 0010 0009 01 FF", "8F 03"},
                    Fact{"CoilsTooManyBytes", "0F 0010 0008 02 FF FF", "8F 03"},
                    Fact{"CoilsByteCountTooHigh", "0F 0010 0008 02 FF", "8F 03"},
                    Fact{"CoilsByteCountTooLow", "0F 0010 0009 01 FF 01", "8F 03"},
                    Fact{"CoilsDataMissing", "0F 0010 0009 02 FF", "8F 03"},
                    Fact{"CoilsDataLeft", "0F 0010 0008 01 FF FF", "8F 03"},
                    Fact{"CoilsPastEnd", "0F 0843 0002 01 03", "8F 02"},
                    Fact{"CoilsPastAddresses", "0F FFFF 0002 01 03", "8F 02"},
                    Fact{"CoilsBare", "0F 0010 0001", "8F 03"},
                    Fact{"RegistersNone", "10 0010 0000 00", "90 03"},
                    Fact{"RegistersTooFewBytes", "10 0010 0002 02 1234", "90 03"},
                    Fact{"RegistersTooManyBytes", "10 0010 0001 04 1234 5678", "90 03"},
                    Fact{"RegistersOddBytes", "10 0010 0001 03 1234 56", "90 03"},
                    Fact{"RegistersByteCountTooHigh", "10 0010 0001 04 1234", "90 03"},
                    Fact{"RegistersByteCountTooLow", "10 0010 0002 02 1234 5678", "90 03"},
                    Fact{"RegistersDataMissing", "10 0010 0002 04 1234", "90 03"},
                    Fact{"RegistersDataLeft", "10 0010 0001 02 1234 56", "90 03"},
                    Fact{"RegistersPastEnd", "10 0843 0002 04 1234 5678", "90 02"},
                    Fact{"RegistersPastAddresses", "10 FFFF 0002 04 1234 5678", "90 02"},
                    Fact{"RegistersBare", "10 0010 0001", "90 03"},
                    Fact{"MaskElsewhere", "16 F000 FFFF 0000", "96 02"},
                    Fact{"MaskShort", "16 0010 FFFF", "96 03"},
                    Fact{"MaskLong", "16 0010 FFFF 0000 00", "96 03"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    ReadsAndWrites, PduException,
    testing::Values(Fact{"ReadNone", "17 0010 0000 0010 0001 02 1234", "97 03"},
                    Fact{"ReadTooMany", "17 0010 007E 0010 0001 02 1234", "97 03"},
                    Fact{"WriteNone", "17 0010 0001 0010 0000 00", "97 03"},
                    Fact{"ByteCountOfOther", "17 0010 0001 0010 0002 02 1234", "97 03"},
                    Fact{"ByteCountTooHigh", "17 0010 0001 0010 0001 04 1234", "97 03"},
                    Fact{"ByteCountTooLow", "17 0010 0001 0010 0002 02 1234 5678", "97 03"},
                    Fact{"DataMissing", "17 0010 0001 0010 0002 04 1234", "97 03"},
                    Fact{"DataLeft", "17 0010 0001 0010 0001 02 1234 56", "97 03"},
                    Fact{"Bare", "17 0010 0001 0010 0001", "97 03"},
                    Fact{"ReadElsewhere", "17 F000 0001 0010 0001 02 1234", "97 02"},
                    Fact{"ReadPastAddresses", "17 FFFF 0002 0010 0001 02 1234", "97 02"},
                    Fact{"WriteElsewhere", "17 0010 0001 F000 0001 02 1234", "97 02"},
                    Fact{"WritePastAddresses", "17 0010 0001 FFFF 0002 04 1234 5678", "97 02"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(EncapsulatedInterface, PduException,
                         testing::Values(Fact{"OtherMeiType", "2B 0D 01 00", "AB 01"},
                                         Fact{"OtherMeiTypeBare", "2B 0D", "AB 01"},
                                         Fact{"Bare", "2B", "AB 03"},
                                         Fact{"ReadCodeZero", "2B 0E 00 00", "AB 03"},
                                         Fact{"ReadCodeFive", "2B 0E 05 00", "AB 03"},
                                         Fact{"Short", "2B 0E 01", "AB 03"},
                                         Fact{"Long", "2B 0E 01 00 00", "AB 03"},
                                         Fact{"UnknownObject", "2B 0E 04 42", "AB 02"}),
                         name_of);

TEST_F(PduAnswer, ReadsBitsLowestFirstAndPadsWithZeros) {
  unit.coils.values[0] = unit.coils.values[2] = unit.coils.values[8] = 1;
  unit.discrete_inputs.values[1] = 1;
  EXPECT_EQ(reply("01 0010 0001"), "01 01 01");
  EXPECT_EQ(reply("01 0010 0009"), "01 02 05 01");
  EXPECT_EQ(reply("01 0010 0008"), "01 01 05");
  EXPECT_EQ(reply("02 0010 0003"), "02 01 02");
}

TEST_F(PduAnswer, ReadsRegistersHighByteFirstFromTheirOwnTable) {
  unit.holding_registers.values = {0x1234, 0x5678};
  unit.input_registers.values = {0x9ABC};
  EXPECT_EQ(reply("03 0010 0002"), "03 04 12 34 56 78");
  EXPECT_EQ(reply("04 0010 0001"), "04 02 9A BC");
}

TEST_F(PduAnswer, ReadsAsManyAsTheProtocolAllows) {
  for (const auto& [request, size] : {std::pair{"01 0010 07D0", 2U + 250U},
                                      {"02 0010 07D0", 2U + 250U},
                                      {"03 0010 007D", 2U + 250U},
                                      {"04 0010 007D", 2U + 250U}}) {
    const Pdu pdu = answer(bytes_of_hex(request), unit, Line::tcp);
    EXPECT_EQ(pdu.size(), size) << request;
    EXPECT_FALSE(pdu.is_exception());
  }
}

TEST_F(PduAnswer, ReadsTheLastAddress) {
  unit.holding_registers.first = 0xFFFF;
  unit.holding_registers.values = {0x1234};
  EXPECT_EQ(reply("03 FFFF 0001"), "03 02 12 34");
  EXPECT_EQ(reply("06 FFFF 5678"), "06 FF FF 56 78");
  EXPECT_EQ(reply("10 FFFF 0001 02 9ABC"), "10 FF FF 00 01");
  EXPECT_EQ(unit.holding_registers.values[0], 0x9ABC);
}

TEST_F(PduAnswer, EchoesSingleWrites) {
  EXPECT_EQ(reply("05 0011 FF00"), "05 00 11 FF 00");
  EXPECT_EQ(unit.coils.values[1], 1);
  EXPECT_EQ(reply("05 0011 0000"), "05 00 11 00 00");
  EXPECT_EQ(unit.coils.values[1], 0);
  EXPECT_EQ(reply("06 0011 1234"), "06 00 11 12 34");
  EXPECT_EQ(unit.holding_registers.values[1], 0x1234);
}

TEST_F(PduAnswer, WritesManyCoils) {
  EXPECT_EQ(reply("0F 0010 000A 02 CD 01"), "0F 00 10 00 0A");
  const std::vector<std::uint8_t> expected = {1, 0, 1, 1, 0, 0, 1, 1, 1, 0, 0};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), unit.coils.values.begin()));
}

TEST_F(PduAnswer, WritesManyRegisters) {
  EXPECT_EQ(reply("10 0011 0002 04 1234 5678"), "10 00 11 00 02");
  EXPECT_EQ(unit.holding_registers.values[1], 0x1234);
  EXPECT_EQ(unit.holding_registers.values[2], 0x5678);
}

TEST_F(PduAnswer, WritesAsManyAsTheProtocolAllowsAndNoMore) {
  EXPECT_EQ(reply_with_data("0F 0010 07B0 F6", 246), "0F 00 10 07 B0");
  EXPECT_EQ(reply_with_data("0F 0010 07B1 F7", 247), "8F 03");
  EXPECT_EQ(reply_with_data("10 0010 007B F6", 246), "10 00 10 00 7B");
  EXPECT_EQ(reply_with_data("10 0010 007C F8", 247), "90 03");
  EXPECT_EQ(reply_with_data("17 0010 0001 0010 0079 F2", 242), "17 02 55 55");
  EXPECT_EQ(reply_with_data("17 0010 0001 0010 007A F4", 243), "97 03");
}

TEST_F(PduAnswer, MasksARegister) {
  unit.holding_registers.values[4] = 0x0012;  // the example of the specification
  EXPECT_EQ(reply("16 0014 00F2 0025"), "16 00 14 00 F2 00 25");
  EXPECT_EQ(unit.holding_registers.values[4], 0x0017);
  EXPECT_EQ(reply("16 0014 0000 FFFF"), "16 00 14 00 00 FF FF");
  EXPECT_EQ(unit.holding_registers.values[4], 0xFFFF);
}

TEST_F(PduAnswer, ReadsWhatTheSameRequestWrote) {
  unit.holding_registers.values = {1, 2, 3, 4};
  EXPECT_EQ(reply("17 0010 0003 0011 0001 02 ABCD"), "17 06 00 01 AB CD 00 03");
}

TEST_F(PduAnswer, LeavesHolesAndReadOnlyPlacesAlone) {
  unit.holding_registers.holes = {0x0012};
  unit.holding_registers.read_only = {0x0020};
  unit.coils.read_only = {0x0020};
  const test::FakeUnit before = unit;
  EXPECT_EQ(reply("03 0010 0003"), "83 02");
  EXPECT_EQ(reply("03 0010 0002"), "03 04 00 00 00 00");
  EXPECT_EQ(reply("10 0011 0002 04 1234 5678"), "90 02");
  EXPECT_EQ(reply("10 001F 0002 04 1234 5678"), "90 02");
  EXPECT_EQ(reply("06 0020 1234"), "86 02");
  EXPECT_EQ(reply("16 0012 FFFF 0000"), "96 02");
  EXPECT_EQ(reply("16 0020 FFFF 0000"), "96 02");
  EXPECT_EQ(reply("17 0010 0002 0020 0001 02 1234"), "97 02");
  EXPECT_EQ(reply("17 0011 0002 0030 0001 02 1234"), "97 02");
  EXPECT_EQ(reply("05 0020 FF00"), "85 02");
  EXPECT_EQ(reply("0F 001F 0002 01 03"), "8F 02");
  EXPECT_TRUE(unit.has_same_values(before));
}

TEST_F(PduAnswer, PassesOnWhatTheUnitSaysToAWrite) {
  const test::FakeUnit before = unit;
  for (const auto& [failure, code] : {std::pair{Exception::server_device_failure, " 04"},
                                      {Exception::server_device_busy, " 06"},
                                      {Exception::illegal_data_value, " 03"}}) {
    unit.failure = failure;
    EXPECT_EQ(reply("05 0010 FF00"), std::string("85") + code);
    EXPECT_EQ(reply("06 0010 1234"), std::string("86") + code);
    EXPECT_EQ(reply("0F 0010 0001 01 01"), std::string("8F") + code);
    EXPECT_EQ(reply("10 0010 0001 02 1234"), std::string("90") + code);
    EXPECT_EQ(reply("16 0010 0000 FFFF"), std::string("96") + code);
    EXPECT_EQ(reply("17 0010 0001 0010 0001 02 1234"), std::string("97") + code);
  }
  EXPECT_TRUE(unit.has_same_values(before));
}

TEST_F(PduAnswer, ReturnsQueryDataOnTheSerialLineOnly) {
  EXPECT_EQ(reply("08 0000 A537", Line::serial), "08 00 00 A5 37");
  EXPECT_EQ(reply("08 0000 A537 1234", Line::serial), "08 00 00 A5 37 12 34");
  EXPECT_EQ(reply("08 0001 0000", Line::serial), "88 01");
  EXPECT_EQ(reply("08 0000", Line::serial), "88 03");
  EXPECT_EQ(reply("08 0000 A5", Line::serial), "88 03");
  EXPECT_EQ(reply("08 0000 A537 12", Line::serial), "88 03");
  EXPECT_EQ(reply("08 00", Line::serial), "88 03");
  EXPECT_EQ(reply("08 0000 A537", Line::tcp), "88 01");
}

TEST_F(PduAnswer, ReportsTheServerIdOnTheSerialLineOnly) {
  unit.identity.objects = {{0, "ab"}, {1, "c"}, {2, "1.0"}, {4, "not this"}};
  EXPECT_EQ(reply("11", Line::serial), "11 0A 47 FF 61 62 20 63 20 31 2E 30");
  EXPECT_EQ(reply("11 00", Line::serial), "91 03");
  EXPECT_EQ(reply("11", Line::tcp), "91 01");
}

TEST_F(PduAnswer, RefusesARequestWithoutFunctionCodeOrTooLong) {
  EXPECT_THROW((void)answer({}, unit, Line::tcp), std::invalid_argument);
  EXPECT_THROW((void)answer(test::Bytes(254), unit, Line::tcp), std::invalid_argument);
  EXPECT_EQ(answer(test::Bytes(253), unit, Line::tcp).size(), 2U);
}

TEST(Pdu, HoldsAtMost253Bytes) {
  Pdu pdu;
  (void)pdu.extend(252);
  EXPECT_THROW(pdu.append_u16(1), std::length_error);
  pdu.append(std::uint8_t{1});
  EXPECT_EQ(pdu.size(), 253U);
  EXPECT_THROW(pdu.append(std::uint8_t{1}), std::length_error);
}

TEST(Pdu, ExceptionIsTheFunctionCodeWithTheHighBitAndTheException) {
  const Pdu pdu = exception_pdu(0x03, Exception::gateway_target_failed);
  EXPECT_EQ(hex(pdu.bytes()), "83 0B");
  EXPECT_TRUE(pdu.is_exception());
}

}  // namespace
}  // namespace gonio::modbus
