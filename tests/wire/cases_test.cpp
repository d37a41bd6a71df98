// The wire cases of standards/modbus, sent to a running server.
#include <gtest/gtest.h>

#include <memory>

#include "emulator/protocol/rtu_framer.hpp"
#include "tests/conformance/wire_cases.hpp"
#include "tests/wire/serial_port.hpp"
#include "tests/wire/server_process.hpp"

namespace gonio::test {
namespace {

using conformance::ProbedLine;
using conformance::WireCase;
using modbus::Line;

/// Several times what a reply takes, and less than the server waits for the rest of a request.
constexpr milliseconds wait_for_more{40};

class TcpLine final : public ProbedLine {
 public:
  explicit TcpLine(std::uint16_t port) : port_(port), socket_(port) {}
  [[nodiscard]] Line kind() const override { return Line::tcp; }
  void renew() override { socket_ = TcpSocket(port_); }
  void send(std::span<const std::uint8_t> bytes, milliseconds /*silence*/) override {
    socket_.send(bytes);
  }
  Bytes receive() override { return socket_.receive_adu(); }
  Bytes receive_more() override { return socket_.receive_adu(wait_for_more); }
  bool is_closed() override { return socket_.is_closed(); }

 private:
  std::uint16_t port_;
  TcpSocket socket_;
};

class RtuLine final : public ProbedLine {
 public:
  explicit RtuLine(const ServerProcess& server) : port_(server) {}
  [[nodiscard]] Line kind() const override { return Line::serial; }
  void renew() override {}
  void send(std::span<const std::uint8_t> bytes, milliseconds silence) override {
    pause(silence);
    port_.send(bytes);
    has_replied_ = false;
  }
  Bytes receive() override {
    has_replied_ = true;
    return receive(patience);
  }
  /// After a reply the silence behind it has been waited for.
  Bytes receive_more() override { return has_replied_ ? Bytes() : receive(wait_for_more); }
  bool is_closed() override { return false; }

 private:
  /// A reply with a wrong CRC is shown without its two last bytes, so that none matches it.
  [[nodiscard]] Bytes receive(milliseconds within) const {
    Bytes bytes = port_.receive_until_silence(within);
    constexpr std::size_t crc_size = 2;
    if (bytes.size() > crc_size && modbus::crc16(bytes) != 0) {
      bytes.resize(bytes.size() - crc_size);
    }
    return bytes;
  }

  SerialPort port_;
  bool has_replied_ = false;
};

class ServerOverTcp : public testing::TestWithParam<WireCase> {
 protected:
  static void SetUpTestSuite() { server = std::make_unique<ServerProcess>(with_pty); }
  static void TearDownTestSuite() { server.reset(); }

  static inline std::unique_ptr<ServerProcess> server;
};
class ServerOnASerialLine : public ServerOverTcp {};

TEST_P(ServerOverTcp, AnswersAsExpected) {
  TcpLine line(server->port());
  EXPECT_EQ(failure_of(GetParam().exchange, line), "");
  EXPECT_TRUE(server->is_alive());
}

TEST_P(ServerOnASerialLine, AnswersAsExpected) {
  RtuLine line(*server);
  EXPECT_EQ(failure_of(GetParam().exchange, line), "");
  EXPECT_TRUE(server->is_alive());
}

std::vector<WireCase> cases(Line line) {
  return conformance::wire_cases(source_tree, line,
                                 conformance::shipped_profile(source_tree, "gonio"));
}

const auto id_of = [](const auto& info) { return info.param.id; };
INSTANTIATE_TEST_SUITE_P(Wire, ServerOverTcp, testing::ValuesIn(cases(Line::tcp)), id_of);
INSTANTIATE_TEST_SUITE_P(Wire, ServerOnASerialLine, testing::ValuesIn(cases(Line::serial)), id_of);

}  // namespace
}  // namespace gonio::test
