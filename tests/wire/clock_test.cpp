// The server lives by the steady clock: what the wall clock does is nothing to it. The wall clock
// is set for the server alone, by a library that stands before the C library.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/wire/victim.hpp"

namespace gonio::test {
namespace {

/// Register uptime, seconds.
unsigned uptime(std::uint16_t port) {
  TcpSocket peer(port);
  peer.send(adu(1, "04 000C 0002"));
  const Bytes reply = peer.receive_adu();
  constexpr std::size_t first = 9;
  return reply.size() == first + 4 ? unsigned{reply[first + 2]} << 8U | reply[first + 3] : 9999U;
}

TEST(WallClock, JumpsOfADayAreNotFelt) {
  ServerProcess server({"--idle-timeout", "10 s", "--log-level", "debug"},
                       {.preload = JUMPING_CLOCK});
  TcpSocket idle(server.port());
  expect_isolation(server, [&] {
    for (const int jump : {SIGUSR1, SIGUSR2, SIGUSR1}) {
      kill(server.id(), jump);
      pause(attack_time / 3);
    }
  });
  EXPECT_FALSE(idle.is_closed(milliseconds(200))) << "a day is longer than the idle time-out";
  EXPECT_LT(uptime(server.port()), 60U);
  kill(server.id(), SIGUSR1);
  TcpSocket peer(server.port());
  ASSERT_EQ(server.end(), 0);
  const std::string log = server.log();
  EXPECT_NE(log.substr(0, 10), log.substr(log.rfind('\n', log.size() - 2) + 1, 10))
      << "the clock did not jump: " << log;
}

}  // namespace
}  // namespace gonio::test
