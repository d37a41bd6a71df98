#include "emulator/protocol/tcp_connection.hpp"

#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <string_view>
#include <system_error>

#include "tests/unit/protocol/fake_unit.hpp"

namespace gonio::test {
namespace {

constexpr std::string_view not_modbus = "GET / HTTP/1.1\r\n\r\n";

/// A connection, its peer, and a second descriptor of its socket: the kernel keeps a socket until
/// its last descriptor is gone, and somebody who looks at the descriptors of the process may hold
/// one for a moment.
struct ConnectionHeldElsewhere : testing::Test {
  ConnectionHeldElsewhere() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) {
      throw std::system_error(errno, std::generic_category());
    }
    peer = ends[0];
    held = dup(ends[1]);
    connection = std::make_shared<TcpConnection>(ends[1], surroundings, "peer");
    connection->start();
  }
  ~ConnectionHeldElsewhere() override {
    ::close(peer);
    ::close(held);
  }
  void say(std::string_view text) const {
    ASSERT_EQ(send(peer, text.data(), text.size(), MSG_NOSIGNAL), ssize_t(text.size()));
  }

  FakeUnit unit{0, 1};
  FaultPlan faults;
  Counters counters;
  Dispatcher dispatcher{{{1, &unit}}, faults, counters, [](double) {}};
  asio::io_context io;
  ReadySet ready;
  TcpOptions options;
  spdlog::logger log{"silent"};
  int closed = 0;
  TcpConnection::Surroundings surroundings{io,      ready, dispatcher,
                                           options, log,   [this](const auto&) { ++closed; }};
  int peer = -1, held = -1;
  std::shared_ptr<TcpConnection> connection;
};

TEST_F(ConnectionHeldElsewhere, IsHeardOfNoMoreOnceItIsClosed) {
  say(not_modbus);
  EXPECT_EQ(ready.poll(), 1);
  EXPECT_EQ(closed, 1);
  connection.reset();
  say(not_modbus);
  EXPECT_EQ(ready.poll(), 0);
}

TEST_F(ConnectionHeldElsewhere, IsHeardOfNoMoreOnceItIsGone) {
  connection.reset();
  say(not_modbus);
  EXPECT_EQ(ready.poll(), 0);
}

}  // namespace
}  // namespace gonio::test
