#include "emulator/protocol/device_url.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/message_of.hpp"

namespace gonio {
namespace {

std::string error_of(const std::string& text) {
  return test::message_of([&] { (void)DeviceUrl::parse(text); });
}

TEST(DeviceUrl, HasPort502AndUnit1UnlessGiven) {
  const DeviceUrl url = DeviceUrl::parse("modbus://gloss.lab-3.example");
  EXPECT_FALSE(url.is_rtu);
  EXPECT_EQ(url.host, "gloss.lab-3.example");
  EXPECT_EQ(url.port, 502);
  EXPECT_EQ(url.unit, 1);
}

TEST(DeviceUrl, TakesPortAndUnit) {
  const DeviceUrl url = DeviceUrl::parse("modbus://10.0.0.7:15020/247");
  EXPECT_EQ(url.host, "10.0.0.7");
  EXPECT_EQ(url.port, 15020);
  EXPECT_EQ(url.unit, 247);
  EXPECT_EQ(DeviceUrl::parse("modbus://a/255").unit, 255);
  EXPECT_EQ(DeviceUrl::parse("modbus://a/0").unit, 0);
}

TEST(DeviceUrl, TakesIpv6InBrackets) {
  const DeviceUrl url = DeviceUrl::parse("modbus://[::1]:65535/2");
  EXPECT_EQ(url.host, "::1");
  EXPECT_EQ(url.port, 65535);
  EXPECT_EQ(url.unit, 2);
  EXPECT_EQ(DeviceUrl::parse("modbus://[fe80::1%eth0]").host, "fe80::1%eth0");
}

TEST(DeviceUrl, OfASerialLineHas19200BaudEvenParityAndUnit1UnlessGiven) {
  const DeviceUrl url = DeviceUrl::parse("modbus-rtu:/dev/ttyUSB0");
  EXPECT_TRUE(url.is_rtu);
  EXPECT_EQ(url.path, "/dev/ttyUSB0");
  EXPECT_EQ(url.baud, 19200);
  EXPECT_EQ(url.parity, 'E');
  EXPECT_EQ(url.unit, 1);
}

TEST(DeviceUrl, TakesTheSettingsOfASerialLine) {
  const DeviceUrl url = DeviceUrl::parse("modbus-rtu:line?unit=9&parity=none&baud=115200");
  EXPECT_EQ(url.path, "line");
  EXPECT_EQ(url.baud, 115200);
  EXPECT_EQ(url.parity, 'N');
  EXPECT_EQ(url.unit, 9);
  EXPECT_EQ(DeviceUrl::parse("modbus-rtu:line?parity=odd").parity, 'O');
}

TEST(DeviceUrl, IsWrittenInFull) {
  for (const std::string text : {"modbus://host:502/1", "modbus://[::1]:1502/0",
                                 "modbus-rtu:/dev/ttyS0?baud=9600&parity=odd&unit=247",
                                 "modbus-rtu:/dev/ttyS0?baud=19200&parity=even&unit=1"}) {
    EXPECT_EQ(DeviceUrl::parse(text).text(), text);
  }
}

TEST(DeviceUrl, SaysWhatItExpectsInPlaceOfAnotherScheme) {
  for (const std::string text : {"", "host", "http://host", "modbus:host", "MODBUS://host"}) {
    EXPECT_EQ(error_of(text),
              "expected a device as modbus://HOST[:PORT][/UNIT] or "
              "modbus-rtu:PATH[?baud=19200&parity=even&unit=1], found '" +
                  text + "'");
  }
}

struct BadUrl {
  std::string text, expected, found;
};

TEST(DeviceUrl, RefusesAPartThatIsWrong) {
  const std::string host = "a host name, an IPv4 address, or an IPv6 address in brackets";
  const std::string port = "a port in [1, 65535]", unit = "a unit in [0, 247], or 255";
  const std::string baud =
      "a baud rate of 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800";
  for (const BadUrl& bad :
       std::vector<BadUrl>{{"modbus://", host, ""},
                           {"modbus://:502", host, ":502"},
                           {"modbus:///1", host, ""},
                           {"modbus://a b", host, "a b"},
                           {"modbus://me@host", host, "me@host"},
                           {"modbus://[::1", host, "[::1"},
                           {"modbus://[]", host, "[]"},
                           {"modbus://[%eth0]", host, "[%eth0]"},
                           {"modbus://[host]", host, "[host]"},
                           {"modbus://host:", port, ""},
                           {"modbus://host:0", port, "0"},
                           {"modbus://host:65536", port, "65536"},
                           {"modbus://host:-1", port, "-1"},
                           {"modbus://host:5x", port, "5x"},
                           {"modbus://::1", host, "::1"},
                           {"modbus://[::1]502", port, "502"},
                           {"modbus://host/", unit, ""},
                           {"modbus://host/248", unit, "248"},
                           {"modbus://host/-1", unit, "-1"},
                           {"modbus://host/1/2", unit, "1/2"},
                           {"modbus-rtu:", "the path of a serial device", ""},
                           {"modbus-rtu:?unit=1", "the path of a serial device", ""},
                           {"modbus-rtu:a?unit=0", "a unit in [1, 247]", "0"},
                           {"modbus-rtu:a?unit=255", "a unit in [1, 247]", "255"},
                           {"modbus-rtu:a?unit", "a unit in [1, 247]", ""},
                           {"modbus-rtu:a?baud=19201", baud, "19201"},
                           {"modbus-rtu:a?parity=E", "a parity of none, even, odd", "E"},
                           {"modbus-rtu:a?stop=2", "baud=, parity= or unit=", "stop=2"},
                           {"modbus-rtu:a?unit=1&&baud=9600", "baud=, parity= or unit=", ""}}) {
    EXPECT_EQ(error_of(bad.text),
              bad.text + ": expected " + bad.expected + ", found '" + bad.found + "'");
  }
}

}  // namespace
}  // namespace gonio
