// What happens on a serial line, shown on the server's pseudo terminal: noise, the traffic of
// others, clients that come and go. A client on TCP works on all the while.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/wire/serial_port.hpp"
#include "tests/wire/victim.hpp"

namespace gonio::test {
namespace {

const Bytes request = rtu_adu(read_known);

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// A server with a serial line, and the client of that line.
struct SerialLine : testing::Test {
  ServerProcess server{with_pty};
  SerialPort port{server};

  /// Whether a good request is answered.
  [[nodiscard]] bool is_answering() {
    port.send(request);
    return port.receive(known_rtu_reply().size()) == known_rtu_reply();
  }

  /// Sends each text and hears nothing; after each a good request is answered.
  void expect_silence(const std::vector<Bytes>& texts) {
    expect_isolation(server, [&] {
      for (const Bytes& text : texts) {
        port.send_what_is_dropped(text);
        EXPECT_EQ(hex(port.receive_until_silence(milliseconds(50))), "") << hex(text);
        EXPECT_TRUE(is_answering()) << hex(text);
      }
    });
  }
};

TEST_F(SerialLine, AnswersGoodRequests) {
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      port.send(request);
      ASSERT_EQ(port.receive(known_rtu_reply().size()), known_rtu_reply());
    }
  });
}

TEST_F(SerialLine, IsSilentAfterAWrongCrc) {
  Bytes wrong = request;
  wrong.at(wrong.size() - 1) ^= 0xFFU;
  expect_silence({wrong});
}

TEST_F(SerialLine, IsSilentAfterPartsOfARequest) {
  std::vector<Bytes> parts;
  for (std::size_t size = 1; size < request.size(); ++size) {
    parts.emplace_back(request.begin(), request.begin() + std::ptrdiff_t(size));
  }
  expect_silence(parts);
}

TEST_F(SerialLine, IsSilentAfterTwoRequestsWithoutASilenceBetweenThem) {
  expect_silence({request + request});
}

TEST_F(SerialLine, IsSilentAfterNoiseBeforeARequest) {
  expect_silence({Bytes{0} + request, Bytes{0xFF, 0xFF} + request});
}

TEST_F(SerialLine, IsSilentAfterNoise) {
  constexpr std::uint64_t seed = 2813;
  std::mt19937_64 random(seed);
  std::vector<Bytes> texts;
  for (const std::size_t size : {1U, 3U, 4U, 255U, 256U, 257U, 3000U}) {
    Bytes noise(size);
    for (std::uint8_t& byte : noise) {
      byte = static_cast<std::uint8_t>(random());
    }
    texts.push_back(std::move(noise));
  }
  expect_silence(texts);
}

/// What a line of another speed, or with one parity bit more, looks like to who does not expect it.
TEST_F(SerialLine, IsSilentAfterARequestThatIsShiftedByBits) {
  Bytes shifted = request;
  for (std::uint8_t& byte : shifted) {
    byte = static_cast<std::uint8_t>(byte << 1U);
  }
  expect_silence({shifted});
}

TEST_F(SerialLine, IsSilentAfterTheTrafficOfOthers) {
  expect_isolation(server, [&] {
    for (const Bytes& text : {rtu_adu(read_known, 7), rtu_adu("03 02 1234", 7), rtu_adu("83 02", 9),
                              rtu_adu("06 03EB 0009", 247), rtu_adu(read_known, 248)}) {
      port.send(text);
      EXPECT_EQ(hex(port.receive_until_silence(milliseconds(50))), "") << hex(text);
      EXPECT_TRUE(is_answering()) << hex(text);
    }
  });
}

/// The reply of another unit looks like a request, and is one with a good CRC.
TEST_F(SerialLine, AnswersAfterAForeignExchange) {
  for (int i = 0; i < 3; ++i) {
    port.send(rtu_adu("03 012C 0001", 7));
    port.send(rtu_adu("03 02 1234", 7));
    EXPECT_TRUE(is_answering());
  }
}

TEST_F(SerialLine, ObeysBroadcastsWithoutAWord) {
  expect_isolation(server, [&] {
    port.send(rtu_adu("06 03EB 0005", 0));
    EXPECT_EQ(hex(port.receive_until_silence(milliseconds(50))), "");
    port.send(rtu_adu("03 03EB 0001"));
    EXPECT_EQ(hex(port.receive_until_silence()), hex(rtu_adu("03 02 0005")));
    port.send(rtu_adu("06 0000 0005", 0));  // refused, without a word, too
    EXPECT_EQ(hex(port.receive_until_silence(milliseconds(50))), "");
    port.send(rtu_adu("06 03EB 0000"));
    EXPECT_EQ(hex(port.receive_until_silence()), hex(rtu_adu("86 03")));
  });
}

TEST_F(SerialLine, TakesTheSilenceWithinARequestForItsEnd) {
  expect_isolation(server, [&] {
    port.send_what_is_dropped(std::span(request).first(4));
    port.send_what_is_dropped(std::span(request).subspan(4));
    EXPECT_EQ(hex(port.receive_until_silence(milliseconds(50))), "");
    EXPECT_TRUE(is_answering());
  });
}

TEST_F(SerialLine, AnswersWhateverFormatTheClientSets) {
  for (const tcflag_t format : {tcflag_t(PARENB), tcflag_t(PARENB | PARODD), tcflag_t(CSTOPB)}) {
    SerialPort other(server, format);
    other.send(request);
    EXPECT_EQ(other.receive(known_rtu_reply().size()), known_rtu_reply());
  }
}

/// What a client does that is killed, again and again.
struct ReopenedSerialLine : testing::Test {
  ServerProcess server{with_pty};

  [[nodiscard]] bool is_answering() const {
    SerialPort port(server);
    port.send(request);
    return port.receive(known_rtu_reply().size()) == known_rtu_reply();
  }
};

TEST_F(ReopenedSerialLine, AnswersEveryClient) {
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      ASSERT_TRUE(is_answering());
    }
  });
}

TEST_F(ReopenedSerialLine, ForgetsTheBeginningThatAClientLeft) {
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      SerialPort(server).send_what_is_dropped(std::span(request).first(5));
      ASSERT_TRUE(is_answering());
    }
  });
}

/// What a client left unread is not the answer to the request of the next one.
TEST_F(ReopenedSerialLine, ForgetsTheRepliesThatAClientLeft) {
  expect_isolation(server, [&] {
    {
      SerialPort port(server);
      for (int i = 0; i < 25; ++i) {  // more than the terminal holds
        port.send(rtu_adu("03 0000 0064"));
      }
      pause(milliseconds(100));  // the last reply comes
    }
    SerialPort port(server);
    port.send(request);
    const Bytes reply = port.receive_until_silence();
    EXPECT_EQ(reply.size(), known_rtu_reply().size());
    EXPECT_EQ(reply, known_rtu_reply());
  });
}

}  // namespace
}  // namespace gonio::test
