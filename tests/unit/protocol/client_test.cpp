#include "emulator/protocol/client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <system_error>
#include <vector>

#include "tests/unit/message_of.hpp"
#include "tests/unit/protocol/scripted_peer.hpp"

namespace gonio {
namespace {

using modbus::Table;
using test::Answer;
using test::Bytes;
using test::message_of;
using test::RtuPeer;
using test::TcpPeer;
using testing::ElementsAre;
using namespace std::chrono_literals;

constexpr auto patient = 10s;     // of an answer that comes
constexpr auto impatient = 50ms;  // of one that does not

// Answers over TCP, to whatever transaction.

Bytes tcp_frame(const Bytes& request, const Bytes& pdu, int transaction_offset = 0) {
  const auto length = pdu.size() + 1;
  Bytes frame{request[0], static_cast<std::uint8_t>(request[1] + transaction_offset),
              0,          0,
              0,          static_cast<std::uint8_t>(length),
              request[6]};
  frame.insert(frame.end(), pdu.begin(), pdu.end());
  return frame;
}

auto reply(Bytes pdu) {
  return [pdu = std::move(pdu)](const Bytes& request) { return Answer{{tcp_frame(request, pdu)}}; };
}
Answer silence(const Bytes&) { return {}; }
Answer hang_up(const Bytes&) { return {{}, true}; }

/// The answer to a read of registers: their addresses as their values.
Answer addresses_as_values(const Bytes& request) {
  const int first = request[8] << 8 | request[9], count = request[11];
  Bytes pdu{request[7], static_cast<std::uint8_t>(2 * count)};
  for (int i = first; i < first + count; ++i) {
    pdu.push_back(static_cast<std::uint8_t>(i >> 8));
    pdu.push_back(static_cast<std::uint8_t>(i & 0xFF));
  }
  return {{tcp_frame(request, pdu)}};
}

const Bytes two_registers{3, 4, 0x12, 0x34, 0xAB, 0xCD};

template <class Peer>
std::vector<std::uint16_t> read_two(ModbusClient& client, const Peer&) {
  return client.read_registers(Table::holding_registers, 16, 2);
}

/// What happens to a read, over TCP, and that the next one goes well.
std::string error_and_recovery(const test::Script::value_type& step,
                               std::chrono::milliseconds timeout) {
  const TcpPeer peer({step, reply(two_registers)});
  ModbusClient client(DeviceUrl::parse(peer.url()), timeout);
  std::string message = message_of([&] { (void)read_two(client, peer); });
  EXPECT_TRUE(message.starts_with(peer.url() + "/1: read holding registers 16 to 17: ")) << message;
  EXPECT_THAT(read_two(client, peer), ElementsAre(0x1234, 0xABCD));
  return message.substr(message.find("17: ") + 4);
}

TEST(ModbusClient, ReadsRegisters) {
  const TcpPeer peer({reply(two_registers), reply({4, 2, 0xFF, 0xFE})});
  ModbusClient client(DeviceUrl::parse(peer.url() + "/7"), patient);
  EXPECT_THAT(client.read_registers(Table::holding_registers, 16, 2), ElementsAre(0x1234, 0xABCD));
  EXPECT_THAT(client.read_registers(Table::input_registers, 0x102, 1), ElementsAre(0xFFFE));
  EXPECT_THAT(peer.requests(), ElementsAre(Bytes{0, 1, 0, 0, 0, 6, 7, 3, 0, 16, 0, 2},
                                           Bytes{0, 2, 0, 0, 0, 6, 7, 4, 1, 2, 0, 1}));
}

TEST(ModbusClient, ReadsMoreThan125RegistersInSeveralRequests) {
  const TcpPeer peer({addresses_as_values, addresses_as_values, addresses_as_values});
  ModbusClient client(DeviceUrl::parse(peer.url()), patient);
  const auto values = client.read_registers(Table::input_registers, 1000, 251);
  ASSERT_EQ(values.size(), 251U);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values[i], 1000 + i);
  }
  const auto requests = peer.requests();
  ASSERT_EQ(requests.size(), 3U);
  EXPECT_EQ(requests[0][11], 125);
  EXPECT_EQ(requests[2][11], 1);
}

TEST(ModbusClient, ReadsBits) {
  const TcpPeer peer({reply({1, 2, 0b00000101, 0b10}), reply({2, 1, 1})});
  ModbusClient client(DeviceUrl::parse(peer.url()), patient);
  EXPECT_THAT(client.read_bits(Table::coils, 4, 10),
              ElementsAre(true, false, true, false, false, false, false, false, false, true));
  EXPECT_THAT(client.read_bits(Table::discrete_inputs, 0, 1), ElementsAre(true));
}

TEST(ModbusClient, WritesRegistersInOneRequestAndCoils) {
  const TcpPeer peer({reply({16, 0, 5, 0, 2}), reply({5, 0, 9, 0xFF, 0}), reply({5, 0, 9, 0, 0})});
  ModbusClient client(DeviceUrl::parse(peer.url()), patient);
  client.write_registers(5, {0x0102, 0xFFFF});
  client.write_coil(9, true);
  client.write_coil(9, false);
  EXPECT_THAT(peer.requests(),
              ElementsAre(Bytes{0, 1, 0, 0, 0, 11, 1, 16, 0, 5, 0, 2, 4, 1, 2, 0xFF, 0xFF},
                          Bytes{0, 2, 0, 0, 0, 6, 1, 5, 0, 9, 0xFF, 0},
                          Bytes{0, 3, 0, 0, 0, 6, 1, 5, 0, 9, 0, 0}));
}

TEST(ModbusClient, RefusesToWriteMoreThanOneRequestHolds) {
  const TcpPeer peer({});
  ModbusClient client(DeviceUrl::parse(peer.url()), patient);
  for (const std::size_t count : {0U, 124U}) {
    EXPECT_EQ(message_of([&] { client.write_registers(0, std::vector<std::uint16_t>(count)); }),
              "write_registers: expected 1 to 123 values, found " + std::to_string(count));
  }
}

TEST(ModbusClient, ReportsEveryExceptionInWordsAndKeepsTheConnection) {
  struct Named {
    std::uint8_t code;
    std::string words;
  };
  const std::vector<Named> exceptions = {{1, "illegal function"},
                                         {2, "illegal data address"},
                                         {3, "illegal data value"},
                                         {4, "device failure"},
                                         {5, "acknowledged, not done yet"},
                                         {6, "device busy"},
                                         {8, "memory parity error"},
                                         {10, "gateway path unavailable"},
                                         {11, "no answer behind the gateway"}};
  test::Script script;
  for (const Named& exception : exceptions) {
    script.emplace_back(reply({0x83, exception.code}));
  }
  const TcpPeer peer(script);
  ModbusClient client(DeviceUrl::parse(peer.url()), patient);
  for (const Named& exception : exceptions) {
    try {
      (void)client.read_registers(Table::holding_registers, 16, 1);
      ADD_FAILURE() << "no exception";
    } catch (const ModbusExceptionError& error) {
      EXPECT_EQ(error.code(), static_cast<modbus::Exception>(exception.code));
      EXPECT_THAT(error.what(), testing::EndsWith("/1: read holding register 16: the device "
                                                  "answered with exception 0" +
                                                  std::string(1, "0123456789AB"[exception.code]) +
                                                  ", " + exception.words));
    }
  }
}

TEST(ModbusClient, RecoversFromAWrongTransactionId) {
  EXPECT_EQ(error_and_recovery(
                [](const Bytes& request) { return Answer{{tcp_frame(request, two_registers, 1)}}; },
                patient),
            "Invalid data");
}

TEST(ModbusClient, RecoversFromAStrayReply) {
  EXPECT_EQ(error_and_recovery(
                [](const Bytes& request) {
                  return Answer{{tcp_frame(request, {3, 4, 0, 0, 0, 0}, 1),
                                 tcp_frame(request, two_registers)}};
                },
                patient),
            "Invalid data");
}

TEST(ModbusClient, RecoversFromAReplyOfTheWrongLength) {
  EXPECT_EQ(error_and_recovery(reply({3, 2, 0x12, 0x34}), patient), "Invalid data");
}

TEST(ModbusClient, RecoversFromATruncatedReply) {
  const auto half = [](const Bytes& request) {
    Bytes frame = tcp_frame(request, two_registers);
    frame.resize(frame.size() / 2);
    return Answer{{frame}};
  };
  EXPECT_EQ(error_and_recovery(half, impatient), "Connection timed out");
}

TEST(ModbusClient, RecoversFromSilence) {
  EXPECT_EQ(error_and_recovery(silence, impatient), "Connection timed out");
}

TEST(ModbusClient, RecoversFromAClosedConnection) {
  EXPECT_EQ(error_and_recovery(hang_up, patient), "Connection reset by peer");
}

TEST(ModbusClient, ReadsAReplyThatComesByteByByte) {
  const TcpPeer peer({[](const Bytes& request) {
    Answer answer;
    for (const std::uint8_t byte : tcp_frame(request, two_registers)) {
      answer.pieces.push_back({byte});
    }
    return answer;
  }});
  ModbusClient client(DeviceUrl::parse(peer.url()), patient);
  EXPECT_THAT(read_two(client, peer), ElementsAre(0x1234, 0xABCD));
}

TEST(ModbusClient, SaysWhereNobodyListens) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&address), size), 0);  // but does not listen
  ASSERT_EQ(getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const std::string url = "modbus://127.0.0.1:" + std::to_string(ntohs(address.sin_port)) + "/1";
  EXPECT_EQ(message_of([&] { ModbusClient(DeviceUrl::parse(url), patient); }),
            url + ": cannot connect: Connection refused");
  close(socket);
}

TEST(ModbusClient, SaysWhichHostIsUnknown) {
  EXPECT_THAT(message_of([] { ModbusClient(DeviceUrl::parse("modbus://[12345::1]"), patient); }),
              testing::StartsWith("modbus://[12345::1]:502/1: "));
}

TEST(ModbusClient, SaysWhichLineIsNotThere) {
  EXPECT_EQ(message_of([] { ModbusClient(DeviceUrl::parse("modbus-rtu:/nowhere/tty"), patient); }),
            "modbus-rtu:/nowhere/tty?baud=19200&parity=even&unit=1: cannot connect: No such file "
            "or directory");
}

// The same over a serial line.

Bytes rtu_frame(std::uint8_t unit, const Bytes& pdu) {
  Bytes frame(pdu.size() + 3);
  frame[0] = unit;
  std::copy(pdu.begin(), pdu.end(), frame.begin() + 1);
  const auto crc = [&] {
    std::uint16_t value = 0xFFFF;
    for (std::size_t i = 0; i + 2 < frame.size(); ++i) {
      value ^= frame[i];
      for (int bit = 0; bit < 8; ++bit) {
        value =
            static_cast<std::uint16_t>((value & 1U) != 0 ? (value >> 1U) ^ 0xA001U : value >> 1U);
      }
    }
    return value;
  }();
  frame[frame.size() - 2] = static_cast<std::uint8_t>(crc & 0xFFU);
  frame[frame.size() - 1] = static_cast<std::uint8_t>(crc >> 8U);
  return frame;
}

std::string rtu_error_and_recovery(const Answer& answer, std::chrono::milliseconds timeout) {
  const RtuPeer peer({[&](const Bytes&) { return answer; },
                      [](const Bytes&) { return Answer{{rtu_frame(1, two_registers)}}; }});
  ModbusClient client(DeviceUrl::parse(peer.url()), timeout);
  const std::string message = message_of([&] { (void)read_two(client, peer); });
  EXPECT_THAT(read_two(client, peer), ElementsAre(0x1234, 0xABCD));
  return message.substr(message.find("17: ") + 4);
}

TEST(ModbusClientOnASerialLine, ReadsRegisters) {
  const RtuPeer peer({[](const Bytes&) { return Answer{{rtu_frame(3, two_registers)}}; }});
  ModbusClient client(DeviceUrl::parse(peer.url() + "?unit=3&baud=9600&parity=none"), patient);
  EXPECT_THAT(read_two(client, peer), ElementsAre(0x1234, 0xABCD));
  EXPECT_THAT(peer.requests(), ElementsAre(rtu_frame(3, {3, 0, 16, 0, 2})));
}

TEST(ModbusClientOnASerialLine, ReportsAnException) {
  EXPECT_EQ(rtu_error_and_recovery({{rtu_frame(1, {0x83, 6})}}, patient),
            "the device answered with exception 06, device busy");
}

TEST(ModbusClientOnASerialLine, RecoversFromAWrongCrc) {
  Bytes frame = rtu_frame(1, two_registers);
  frame.back() ^= 1U;
  EXPECT_EQ(rtu_error_and_recovery({{frame}}, patient), "Invalid CRC");
}

TEST(ModbusClientOnASerialLine, RecoversFromAnAnswerOfAnotherUnit) {
  EXPECT_NE(rtu_error_and_recovery({{rtu_frame(2, two_registers)}}, impatient), "no error");
}

TEST(ModbusClientOnASerialLine, RecoversFromSilenceAndFromHalfAnAnswer) {
  Bytes frame = rtu_frame(1, two_registers);
  frame.resize(4);
  EXPECT_EQ(rtu_error_and_recovery({}, impatient), "Connection timed out");
  EXPECT_EQ(rtu_error_and_recovery({{frame}}, impatient), "Connection timed out");
}

}  // namespace
}  // namespace gonio
