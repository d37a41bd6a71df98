// Many connections, silent ones, too many for the server or for the system, and its end with some
// open.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <vector>

#include "tests/wire/victim.hpp"

namespace gonio::test {
namespace {

/// UBSan needs a descriptor of its own to look at a pointer, and takes the lack of one for an
/// error.
#ifdef GONIO_SANITIZED
constexpr bool needs_descriptors = true;
#else
constexpr bool needs_descriptors = false;
#endif

/// So many connections that ask nothing.
std::vector<TcpSocket> crowd(const ServerProcess& server, int count) {
  std::vector<TcpSocket> peers;
  peers.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i) {
    peers.emplace_back(server.port());
  }
  return peers;
}

std::size_t count_closed(std::vector<TcpSocket>& peers) {
  return std::size_t(std::count_if(
      peers.begin(), peers.end(), [](TcpSocket& peer) { return peer.is_closed(milliseconds(0)); }));
}

bool is_answered(TcpSocket& peer) {
  return peer.send(adu(9, read_known)) && peer.receive_adu() == known_reply(9);
}

/// A peer that is gone without a word cannot be told from one that says nothing.
TEST(Connections, SilentOnesAreClosedAfterTheIdleTimeout) {
  constexpr milliseconds idle_time{300};
  ServerProcess server({"--idle-timeout", "300 ms"});
  expect_isolation(server, [&] {
    std::vector<TcpSocket> peers = crowd(server, 20);
    const auto connected = Clock::now();
    for (TcpSocket& peer : peers) {
      EXPECT_TRUE(peer.is_closed());
    }
    EXPECT_GE(Clock::now() - connected + milliseconds(5), idle_time);
  });
}

TEST(Connections, BeyondTheLimitTakeThePlaceOfTheOldestThatNeverAsked) {
  constexpr int limit = 10;
  ServerProcess server({"--max-connections", std::to_string(limit)});
  TcpSocket worker(server.port());
  ASSERT_TRUE(is_answered(worker));
  std::vector<TcpSocket> peers = crowd(server, limit);
  EXPECT_TRUE(peers.front().is_closed());
  for (auto peer = peers.begin() + 1; peer != peers.end(); ++peer) {
    EXPECT_TRUE(is_answered(*peer)) << peer - peers.begin();
  }
  EXPECT_TRUE(is_answered(worker));
}

TEST(Connections, BeyondTheLimitAreRefusedWhileAllOthersAreAtWork) {
  constexpr int limit = 10;
  ServerProcess server({"--max-connections", std::to_string(limit)});
  std::vector<TcpSocket> workers = crowd(server, limit);
  const auto all_work = [&] { return std::all_of(workers.begin(), workers.end(), is_answered); };
  ASSERT_TRUE(all_work());
  TcpSocket late(server.port());
  EXPECT_TRUE(late.is_closed());
  EXPECT_TRUE(all_work());
}

TEST(Connections, FloodDoesNotPushOutAClientAtWork) {
  ServerProcess server;
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      const std::vector<TcpSocket> peers = crowd(server, 200);
    }
  });
}

/// Lets a server have only a few more descriptors than it has, and wants more.
TEST(Connections, BeyondTheDescriptorsOfTheProcessWaitWithoutSpinning) {
  if (needs_descriptors) {
    GTEST_SKIP() << "the sanitizer needs descriptors";
  }
  ServerProcess server({"--idle-timeout", "500 ms"});
  TcpSocket worker(server.port());
  ASSERT_TRUE(is_answered(worker));
  const std::size_t files = server.open_files();
  server.limit_open_files(files + 8);
  const double before_s = server.processor_s();
  const auto began = Clock::now();
  std::vector<TcpSocket> peers = crowd(server, 40);
  for (const Deadline deadline(milliseconds(400)); !deadline.is_over();) {
    ASSERT_TRUE(is_answered(worker));
    pause(milliseconds(20));
  }
  const std::chrono::duration<double> elapsed = Clock::now() - began;
  EXPECT_LT(server.processor_s() - before_s, 0.25 * elapsed.count());
  EXPECT_TRUE(server.is_alive());
  EXPECT_LT(server.open_files(), files + peers.size());
  EXPECT_GT(count_closed(peers), 0U) << "some make room for others";
  peers.clear();
  TcpSocket later(server.port());
  EXPECT_TRUE(is_answered(later));
  later.close();
  EXPECT_TRUE(becomes_true([&] { return server.open_files() <= files; }));
}

TEST(Connections, BeyondTheDescriptorsOfTheProcessLeaveClientsAtWorkAlone) {
  if (needs_descriptors) {
    GTEST_SKIP() << "the sanitizer needs descriptors";
  }
  ServerProcess server;
  const std::size_t files = server.open_files();
  server.limit_open_files(files + 8);
  expect_isolation(server, [&] {
    for (const Deadline deadline(attack_time); !deadline.is_over();) {
      const std::vector<TcpSocket> peers = crowd(server, 40);
      pause(milliseconds(50));
    }
  });
}

/// A limit of descriptors that is lower than the limit of connections is raised by the server.
TEST(Connections, FiveThousandAreServed) {
  constexpr int count = 5000;
  constexpr rlim_t needed = count + 100, usual = 1024;
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  ASSERT_GE(limit.rlim_max, needed) << "raise the hard limit of descriptors";
  limit.rlim_cur = usual;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  ServerProcess server({"--max-connections", "6000"});
  limit.rlim_cur = needed;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  expect_isolation(server, [&] {
    std::vector<TcpSocket> peers = crowd(server, count);
    for (TcpSocket& peer : peers) {
      ASSERT_TRUE(is_answered(peer));
    }
    EXPECT_GE(server.open_files(), std::size_t(count));
    EXPECT_EQ(count_closed(peers), 0U);
  });
}

TEST(Connections, FiveThousandComeAndGoWithTheUsualLimit) {
  ServerProcess server;
  expect_isolation(server, [&] {
    constexpr int rounds = 25, at_once = 200;
    for (int i = 0; i < rounds; ++i) {
      std::vector<TcpSocket> peers = crowd(server, at_once);
      EXPECT_TRUE(is_answered(peers.back()));
    }
  });
}

/// Peers in every state that a connection can be in.
TEST(Connections, DoNotKeepTheServerFromEnding) {
  for (const int signal : {SIGTERM, SIGINT}) {
    ServerProcess server({"--fault", "{fault: delay, time: 60 s, function: 4}",  //
                          "--stall-timeout", "60 s"});
    std::vector<TcpSocket> peers = crowd(server, 3);
    ASSERT_TRUE(is_answered(peers[0]));
    ASSERT_TRUE(peers[1].send(adu(1, read_known_inputs)));  // delayed
    ASSERT_TRUE(peers[2].send(Bytes(1, 0)));                // begun
    TcpSocket deaf(server.port(), 4096);
    const Bytes requests = many_adus(300, "03 0000 0064");
    while (deaf.send(requests, milliseconds(50))) {
    }
    const auto signalled = Clock::now();
    EXPECT_EQ(server.end(signal), 0);
    EXPECT_LT(Clock::now() - signalled, milliseconds(2000));
    for (TcpSocket& peer : peers) {
      EXPECT_TRUE(peer.is_closed());
    }
    EXPECT_NE(server.log().find("served "), std::string::npos);
  }
}

TEST(Connections, AreServedAlthoughNobodyReadsTheLogAnyMore) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path() / "log";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ServerProcess server({"--log-file", pipe, "--log-level", "trace"});
  close(reader);
  TcpSocket peer(server.port());
  for (int i = 0; i < 100; ++i) {  // more than the C library keeps
    ASSERT_TRUE(is_answered(peer));
  }
}

TEST(Connections, OfAServerBeforeDoNotKeepItsPort) {
  ServerProcess first;
  TcpSocket peer(first.port());
  ASSERT_TRUE(is_answered(peer));
  const std::string place = fmt::format("127.0.0.1:{}", first.port());
  ASSERT_EQ(first.end(), 0);  // it closes first: the connection lingers in TIME_WAIT
  ServerProcess second({}, {.tcp = place});
  TcpSocket again(second.port());
  EXPECT_TRUE(is_answered(again));
}

}  // namespace
}  // namespace gonio::test
