#include "emulator/protocol/device_identification.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/hex.hpp"
#include "tests/unit/protocol/fake_unit.hpp"

namespace gonio::modbus {
namespace {

using test::hex;

class DeviceIdentification : public testing::Test {
 protected:
  test::FakeUnit unit{0, 1};

  void SetUp() override {
    unit.identity.objects = {{0, "V"}, {1, "C"}, {2, "1"}, {4, "P"}, {0x80, "S"}, {0x81, "D"}};
  }
  Pdu ask(std::uint8_t read_code, std::uint8_t object) {
    const test::Bytes request = {0x2B, 0x0E, read_code, object};
    return answer(request, unit, Line::tcp);
  }
  std::string reply(std::uint8_t read_code, std::uint8_t object) {
    return hex(ask(read_code, object).bytes());
  }
};

const std::string basic_objects = "00 01 56 01 01 43 02 01 31";

TEST_F(DeviceIdentification, StreamsEachCategoryWithThoseBeforeIt) {
  EXPECT_EQ(reply(1, 0), "2B 0E 01 83 00 00 03 " + basic_objects);
  EXPECT_EQ(reply(2, 0), "2B 0E 02 83 00 00 04 " + basic_objects + " 04 01 50");
  EXPECT_EQ(reply(3, 0), "2B 0E 03 83 00 00 06 " + basic_objects + " 04 01 50 80 01 53 81 01 44");
}

TEST_F(DeviceIdentification, StreamsFromTheObjectAskedFor) {
  EXPECT_EQ(reply(1, 2), "2B 0E 01 83 00 00 01 02 01 31");
  EXPECT_EQ(reply(3, 0x80), "2B 0E 03 83 00 00 02 80 01 53 81 01 44");
}

TEST_F(DeviceIdentification, StreamBeginsAgainForAnObjectThatIsNotThere) {
  EXPECT_EQ(reply(1, 0x42), reply(1, 0));
  EXPECT_EQ(reply(3, 3), reply(3, 0));
  EXPECT_EQ(reply(1, 4), reply(1, 0)) << "4 is there, but not basic";
}

TEST_F(DeviceIdentification, GivesOneObject) {
  EXPECT_EQ(reply(4, 0), "2B 0E 04 83 00 00 01 00 01 56");
  EXPECT_EQ(reply(4, 0x81), "2B 0E 04 83 00 00 01 81 01 44");
  EXPECT_EQ(reply(4, 3), "AB 02");
}

TEST_F(DeviceIdentification, StreamOfAUnitWithoutObjectsIsEmpty) {
  unit.identity.objects.clear();
  EXPECT_EQ(reply(3, 0), "2B 0E 03 83 00 00 00");
  EXPECT_EQ(reply(4, 0), "AB 02");
}

TEST_F(DeviceIdentification, SplitsAStreamThatDoesNotFit) {
  unit.identity.objects = {{0, std::string(120, 'a')}, {1, std::string(122, 'b')}, {2, "c"}};
  const Pdu first = ask(1, 0);
  EXPECT_EQ(hex(first.bytes().first(7)), "2B 0E 01 83 FF 02 02") << "more follows, from object 2";
  EXPECT_EQ(first.size(), 7U + 2 + 120 + 2 + 122) << "253: filled to the last byte";
  EXPECT_EQ(reply(1, 2), "2B 0E 01 83 00 00 01 02 01 63");
}

TEST_F(DeviceIdentification, ObjectsOfFullLengthComeOneByOne) {
  for (const std::uint8_t number : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{0x80}}) {
    unit.identity.objects[number] = std::string(244, 'x');
  }
  unit.identity.objects[0x81] = std::string(300, 'y');
  std::string visited;
  std::uint8_t object = 0;
  bool has_more = true;
  for (int replies = 0; has_more && replies < 10; ++replies) {
    const Pdu pdu = ask(3, object);
    ASSERT_LE(pdu.size(), max_pdu);
    visited += hex(pdu.bytes().subspan(6, 2)) + "; ";
    has_more = pdu.bytes()[4] == 0xFF;
    object = pdu.bytes()[5];
  }
  EXPECT_FALSE(has_more);
  EXPECT_EQ(visited, "01 00; 01 01; 02 02; 01 80; 01 81; ") << "count and first object of each";
  EXPECT_EQ(ask(4, 0x81).size(), max_pdu) << "a text beyond 244 bytes is cut";
}

TEST_F(DeviceIdentification, ServerIdOfLongTextsIsCutToOneReply) {
  unit.identity.objects = {{0, std::string(244, 'x')}, {1, std::string(244, 'y')}};
  const test::Bytes request = {0x11};
  const Pdu pdu = answer(request, unit, Line::serial);
  EXPECT_EQ(pdu.size(), max_pdu);
  EXPECT_EQ(pdu.bytes()[1], max_pdu - 2);
}

}  // namespace
}  // namespace gonio::modbus
