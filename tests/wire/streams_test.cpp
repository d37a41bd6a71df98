// Many requests at once, cut in all ways; units; writes that are refused; clients that write and
// read the same values.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "tests/wire/victim.hpp"

namespace gonio::test {
namespace {

/// @return  whether the reply is as expected.
bool is_answered(TcpSocket& peer, std::uint16_t transaction, std::string_view request,
                 std::string_view reply, std::uint8_t unit = 1) {
  return peer.send(adu(transaction, request, unit)) &&
         peer.receive_adu() == adu(transaction, reply, unit);
}

void expect_known_replies(TcpSocket& peer, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_EQ(peer.receive_adu(), known_reply(static_cast<std::uint16_t>(i))) << i;
  }
}

TEST(Stream, HundredRequestsAtOnceAreAnsweredInOrder) {
  ServerProcess server;
  const Bytes requests = many_adus(100, read_known);
  std::vector<TcpSocket> peers;
  for (int i = 0; i < 4; ++i) {
    peers.emplace_back(server.port());
  }
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      for (TcpSocket& peer : peers) {
        ASSERT_TRUE(peer.send(requests));
      }
      for (TcpSocket& peer : peers) {
        expect_known_replies(peer, 100);
      }
    }
  });
}

/// The dearest requests there are, as fast as they are answered, from several peers at once.
TEST(Stream, HugeRepliesToManyDoNotKeepOthersWaiting) {
  ServerProcess server;
  expect_isolation(server, [&] {
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        constexpr std::size_t depth = 100, reply_size = 9 + 200;
        const Bytes requests = many_adus(depth, "03 0000 0064");
        TcpSocket peer(server.port());
        for (const Deadline deadline(attack_time); !deadline.is_over();) {
          EXPECT_TRUE(peer.send(requests));
          EXPECT_EQ(peer.receive(depth * reply_size).size(), depth * reply_size);
        }
      });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
  });
}

TEST(Stream, TransactionIdsAreEchoedWhateverTheyAre) {
  ServerProcess server;
  constexpr std::array<std::uint16_t, 7> transactions = {5, 5, 5, 65534, 65535, 0, 1};
  TcpSocket peer(server.port());
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      for (const std::uint16_t transaction : transactions) {
        ASSERT_TRUE(peer.send(adu(transaction, read_known)));
      }
      for (const std::uint16_t transaction : transactions) {
        ASSERT_EQ(peer.receive_adu(), known_reply(transaction));
      }
    }
  });
}

TEST(Stream, SingleBytesMakeRequests) {
  ServerProcess server;
  TcpSocket peer(server.port());
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      for (const std::uint8_t byte : many_adus(2, read_known)) {
        ASSERT_TRUE(peer.send(Bytes{byte}));
      }
      expect_known_replies(peer, 2);
    }
  });
}

TEST(Stream, CutsAnywhereMakeNoDifference) {
  ServerProcess server;
  TcpSocket peer(server.port());
  const Bytes requests = many_adus(3, read_known);
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      for (std::size_t cut = 1; cut < requests.size(); ++cut) {
        ASSERT_TRUE(peer.send(std::span(requests).first(cut)));
        ASSERT_TRUE(peer.send(std::span(requests).subspan(cut)));
        expect_known_replies(peer, 3);
      }
    }
  });
}

TEST(Units, ZeroAnd255AreTheFirstAndForeignOnesAreNotThere) {
  ServerProcess server({"--unit", "3"});
  TcpSocket peer(server.port());
  for (const std::uint8_t unit : Bytes{0, 255, 3}) {
    ASSERT_TRUE(peer.send(adu(unit, read_known, unit)));
    EXPECT_EQ(peer.receive_adu(), known_reply(unit, 3, unit));
  }
  for (const std::uint8_t unit : Bytes{1, 2, 99, 247, 248}) {
    EXPECT_TRUE(is_answered(peer, unit, read_known, "83 0B", unit));
  }
}

TEST(Writes, OfWhatCannotBeWrittenChangeNothing) {
  struct Refused {
    const char *request, *reply;
  };
  constexpr std::array refused = {
      Refused{"06 0000 1234", "86 02"},                    // an input register
      Refused{"06 044E 0001", "86 02"},                    // sample_count, read only
      Refused{"06 03E9 0002", "86 03"},                    // settings_lock, no such value
      Refused{"06 03EC 4000", "86 02"},                    // the first half of a float
      Refused{"10 03ED 0001 02 4000", "90 02"},            // the second
      Refused{"10 03EB 0002 04 0005 4000", "90 02"},       // a value and half a float
      Refused{"10 03EC 0002 04 0000 0000", "90 03"},       // out of its range
      Refused{"10 03EA 0003 06 0000 0005 BF80", "90 02"},  // the last is half a float
      Refused{"10 0464 0002 04 0000 0000", "90 02"},       // a hole
      Refused{"16 03EC FF00 0055", "96 02"},               // mask, half a float
      Refused{"17 012C 0001 03EC 0001 02 4000", "97 02"},  // write and read, half a float
      Refused{"05 0BB8 FF00", "85 02"}};                   // a discrete input
  ServerProcess server;
  TcpSocket peer(server.port());
  const auto settings = [&] {
    EXPECT_TRUE(peer.send(adu(1, "03 03E8 0020")));
    return peer.receive_adu();
  };
  const Bytes before = settings();
  ASSERT_EQ(before.size(), 9U + 64U);
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      for (const Refused& one : refused) {
        ASSERT_TRUE(is_answered(peer, 1, one.request, one.reply)) << one.request;
      }
    }
  });
  EXPECT_EQ(settings(), before);
}

/// Two clients write all settings of a block, each its own; others read them.
TEST(Writes, OfSeveralFloatsAreReadWholeOrNotAtAll) {
  constexpr std::array values = {"0002 3F80 0000 0001 0001 42C8 0000",
                                 "0009 4000 0000 0001 0000 3DCC CCCD"};
  ServerProcess server;
  std::array<std::atomic<int>, 2> seen{};
  expect_isolation(server, [&] {
    std::vector<std::thread> threads;
    const Deadline deadline(attack_time);
    for (const char* value : values) {
      threads.emplace_back([&, value] {
        TcpSocket peer(server.port());
        while (!deadline.is_over()) {
          EXPECT_TRUE(
              is_answered(peer, 1, fmt::format("10 03EB 0007 0E {}", value), "10 03EB 0007"));
        }
      });
    }
    TcpSocket reader(server.port());
    ASSERT_TRUE(
        is_answered(reader, 1, fmt::format("10 03EB 0007 0E {}", values[0]), "10 03EB 0007"));
    while (!deadline.is_over()) {
      ASSERT_TRUE(reader.send(adu(2, "03 03EB 0007")));
      const Bytes reply = reader.receive_adu();
      const bool is_first = reply == adu(2, fmt::format("03 0E {}", values[0]));
      ++seen[is_first ? 0 : 1];
      if (!is_first) {
        EXPECT_EQ(hex(reply), hex(adu(2, fmt::format("03 0E {}", values[1]))));
      }
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
  });
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
}

}  // namespace
}  // namespace gonio::test
