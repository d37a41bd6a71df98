// What peers do to a server that cuts a stream into requests: stops half way, sends what is no
// Modbus, vanishes, does not read. Somebody else works on all the while.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/wire/victim.hpp"

namespace gonio::test {
namespace {

/// --stall-timeout of the server, and what it and the machine may add.
constexpr milliseconds stall_time{300}, slack{2000};

/// Repeats an attack for its time.
template <class Attack>
std::function<void()> again_and_again(Attack attack) {
  return [attack] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      attack();
    }
  };
}

/// Peers that send the beginning of a request and then nothing.
void expect_closed_after_stall(ServerProcess& server, const Bytes& beginning) {
  expect_isolation(server, [&] {
    std::vector<TcpSocket> peers;
    for (int i = 0; i < 20; ++i) {
      peers.emplace_back(server.port());
      peers.back().send(beginning);
    }
    const auto sent = Clock::now();
    for (TcpSocket& peer : peers) {
      EXPECT_TRUE(peer.is_closed(stall_time + slack));
    }
    EXPECT_GE(Clock::now() - sent, stall_time);
  });
}

TEST(Attack, NoneIsTheMeasure) {
  ServerProcess server;
  expect_isolation(server, [] { pause(attack_time); });
}

TEST(Attack, ThreeBytesThenSilenceAreClosed) {
  ServerProcess server;
  expect_closed_after_stall(server, bytes_of_hex("0001 00"));
}

TEST(Attack, HalfARequestThenSilenceIsClosed) {
  ServerProcess server;
  expect_closed_after_stall(server, bytes_of_hex("0001 0000 0006 01 03 01"));
}

TEST(Attack, LengthBeyondTheRequestIsClosedInTime) {
  ServerProcess server;
  expect_closed_after_stall(server, bytes_of_hex("0001 0000 0014 01 03 012C 0001"));
}

/// One byte whenever less than the stall time has passed, of a request that is never whole in time.
TEST(Attack, SlowLorisIsClosedAlthoughItNeverPausesForLong) {
  ServerProcess server;
  expect_isolation(server, [&] {
    constexpr milliseconds gap{100};
    std::vector<TcpSocket> peers;
    for (int i = 0; i < 20; ++i) {
      peers.emplace_back(server.port());
    }
    std::size_t closed = 0;
    for (const std::uint8_t byte : adu(1, read_known)) {
      closed = 0;
      for (TcpSocket& peer : peers) {
        closed += peer.send_some(Bytes{byte}) < 0 ? 1U : 0U;
      }
      pause(gap);
    }
    EXPECT_EQ(closed, peers.size());
  });
}

TEST(Attack, UnknownFunctionCodesAreAnsweredAtOnce) {
  ServerProcess server;
  TcpSocket peer(server.port());
  expect_isolation(server, again_and_again([&] {
                     ASSERT_TRUE(peer.send(adu(1, "2B 0D 01 00")));
                     ASSERT_EQ(peer.receive_adu(), adu(1, "AB 01"));
                     ASSERT_TRUE(peer.send(adu(2, "41")));
                     ASSERT_EQ(peer.receive_adu(), adu(2, "C1 01"));
                     ASSERT_TRUE(peer.send(adu(3, "03 012C 0000")));
                     ASSERT_EQ(peer.receive_adu(), adu(3, "83 03"));
                   }));
}

TEST(Attack, ResetsInTheMiddleOfARequestHarmNobody) {
  ServerProcess server;
  expect_isolation(server, again_and_again([&] {
                     TcpSocket peer(server.port());
                     peer.send(bytes_of_hex("0001 0000 00"));
                     peer.reset();
                   }));
}

TEST(Attack, ResetsBeforeTheReplyHarmNobody) {
  ServerProcess server;
  expect_isolation(server, again_and_again([&] {
                     TcpSocket peer(server.port());
                     peer.send(many_adus(20, "03 0000 0064"));
                     peer.reset();
                   }));
}

/// Asks for far more than a socket holds, and reads nothing. @return  bytes that the server took.
std::size_t ask_without_reading(std::vector<TcpSocket>& peers) {
  const Bytes requests = many_adus(300, "03 0000 0064");  // 62700 bytes of replies
  std::size_t taken = 0;
  std::vector<std::size_t> offsets(peers.size());
  for (const Deadline deadline(attack_time); !deadline.is_over();) {
    for (std::size_t i = 0; i < peers.size(); ++i) {
      const ssize_t count = peers[i].send_some(std::span(requests).subspan(offsets[i]));
      if (count > 0) {
        taken += std::size_t(count);
        offsets[i] = (offsets[i] + std::size_t(count)) % requests.size();
      }
    }
    pause(milliseconds(1));
  }
  return taken;
}

TEST(Attack, PeersThatNeverReadAreClosedAndHoldNoMemory) {
  ServerProcess server;
  constexpr int small_buffer = 4096;
  expect_isolation(server, [&] {
    std::vector<TcpSocket> peers;
    for (int i = 0; i < 4; ++i) {
      peers.emplace_back(server.port(), small_buffer);
    }
    EXPECT_GT(ask_without_reading(peers), 100'000U);
    EXPECT_LT(server.resident_mib(), largest_mib);
    for (TcpSocket& peer : peers) {
      EXPECT_TRUE(becomes_true([&] { return peer.send_some(Bytes{0}) < 0; }));
    }
  });
}

/// Each on a new connection, which must be closed.
std::function<void()> refused(const ServerProcess& server, std::vector<Bytes> texts) {
  return again_and_again([&server, texts = std::move(texts)] {
    for (const Bytes& text : texts) {
      TcpSocket peer(server.port());
      peer.send(text);
      ASSERT_TRUE(peer.is_closed()) << hex(text);
    }
  });
}

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

TEST(Attack, GarbageIsClosed) {
  constexpr std::uint64_t seed = 4713;
  std::mt19937_64 random(seed);
  std::vector<Bytes> texts = {bytes_of("GET / HTTP/1.0\r\n\r\n"),
                              bytes_of("SSH-2.0-OpenSSH_9.2\r\n"),
                              bytes_of_hex("16 0301 0200 0100 01FC 0303"), Bytes(300, 0xFF)};
  for (int i = 0; i < 20; ++i) {
    Bytes noise(1024);
    for (std::uint8_t& byte : noise) {
      byte = static_cast<std::uint8_t>(random());
    }
    noise[2] |= 1U;  // a protocol id of 0 could begin a request
    texts.push_back(std::move(noise));
  }
  ServerProcess server;
  expect_isolation(server, refused(server, std::move(texts)));
}

TEST(Attack, ImpossibleLengthsAreClosed) {
  ServerProcess server;
  expect_isolation(server, refused(server, {bytes_of_hex("0001 0000 0000 01 03 012C 0001"),
                                            bytes_of_hex("0001 0000 0001 01 03 012C 0001"),
                                            bytes_of_hex("0001 0000 00FF 01 03 012C 0001"),
                                            bytes_of_hex("0001 0000 FFFF 01 03 012C 0001")}));
}

TEST(Attack, OtherProtocolIdsAreClosed) {
  ServerProcess server;
  expect_isolation(server, refused(server, {bytes_of_hex("0001 0001 0006 01 03 012C 0001"),
                                            bytes_of_hex("0001 0100 0006 01 03 012C 0001"),
                                            bytes_of_hex("0001 FFFF 0006 01 03 012C 0001")}));
}

TEST(Attack, BytesBeyondARequestAreAnErrorOfThatRequestAlone) {
  ServerProcess server;
  TcpSocket peer(server.port());
  expect_isolation(server, again_and_again([&] {
                     ASSERT_TRUE(peer.send(adu(7, "03 012C 0001 DEAD BEEF")));
                     ASSERT_EQ(peer.receive_adu(), adu(7, "83 03"));
                     ASSERT_TRUE(peer.send(adu(8, read_known)));
                     ASSERT_EQ(peer.receive_adu(), known_reply(8));
                   }));
}

TEST(Attack, RequestsBeforeAHalfCloseAreAnswered) {
  ServerProcess server;
  expect_isolation(server, again_and_again([&] {
                     TcpSocket peer(server.port());
                     ASSERT_TRUE(peer.send(adu(1, read_known)));
                     ASSERT_TRUE(peer.send(adu(2, read_known)));
                     peer.half_close();
                     ASSERT_EQ(peer.receive_adu(), known_reply(1));
                     ASSERT_EQ(peer.receive_adu(), known_reply(2));
                     ASSERT_TRUE(peer.is_closed());
                   }));
}

}  // namespace
}  // namespace gonio::test
