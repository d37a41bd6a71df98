// Faults on demand as a client sees them: what comes, byte for byte, and when. Asked for on the
// command line, in an instrument's file, and in registers.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/wire/serial_port.hpp"
#include "tests/wire/server_process.hpp"
#include "tests/wire/tcp_socket.hpp"

namespace gonio::test {
namespace {

constexpr milliseconds fault_time{150};
/// In which what is not delayed comes, and what never comes has not come.
constexpr milliseconds soon{60};

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Bytes half(const Bytes& bytes, bool is_first) {
  const auto middle = bytes.begin() + std::ptrdiff_t(bytes.size() / 2);
  return is_first ? Bytes(bytes.begin(), middle) : Bytes(middle, bytes.end());
}

constexpr std::string_view request = "03 012C 0002", reply = "03 04 C2F6 E666";

/// A fault, and what comes instead of a good reply: at once, and after fault_time.
struct Case {
  const char* name;
  const char* rule;                   ///< less what it strikes
  std::array<std::uint16_t, 3> form;  ///< registers wire_fault, wire_fault_time, wire_fault_code
  Bytes tcp_at_once, tcp_later;
  Bytes rtu_at_once, rtu_later;
  bool closes = false;  ///< TCP
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.rule; }

std::vector<Case> all_cases() {
  const Bytes tcp = adu(7, reply), rtu = rtu_adu(reply);
  Bytes wrong_protocol = tcp, wrong_crc = rtu;
  wrong_protocol.at(3) = 1;
  wrong_crc.at(wrong_crc.size() - 1) ^= 0xFFU;
  const Bytes other_tcp = adu(8, reply), other_rtu = rtu_adu(reply, 2);
  const auto exception = [](const char* name, const char* rule, std::uint16_t code) {
    const std::string pdu = fmt::format("83 {:02X}", code);
    return Case{name, rule, {2, 0, code}, adu(7, pdu), {}, rtu_adu(pdu), {}};
  };
  return {
      {"delay", "fault: delay, time: 150 ms", {0, 150, 4}, {}, tcp, {}, rtu},
      {"no_reply", "fault: no_reply", {1, 0, 4}, {}, {}, {}, {}},
      exception("exception_4", "fault: exception, code: 4", 4),
      exception("exception_6", "fault: exception, code: 6", 6),
      exception("exception_10", "fault: exception, code: 10", 10),
      exception("exception_11", "fault: exception, code: 11", 11),
      {"wrong_transaction", "fault: wrong_transaction", {3, 0, 4}, other_tcp, {}, other_rtu, {}},
      {"split",
       "fault: split, time: 150 ms",
       {4, 150, 4},
       half(tcp, true),
       half(tcp, false),
       half(rtu, true),
       half(rtu, false)},
      {"truncated", "fault: truncated", {5, 0, 4}, half(tcp, true), {}, half(rtu, true), {}},
      {"stray", "fault: stray", {6, 0, 4}, other_tcp + tcp, {}, other_rtu + rtu, {}},
      {"corrupt_crc", "fault: corrupt_crc", {7, 0, 4}, wrong_protocol, {}, wrong_crc, {}},
      {"close", "fault: close", {8, 0, 4}, {}, {}, {}, {}, true}};
}

class WireFaults : public testing::TestWithParam<Case> {
 protected:
  /// Asks once, and compares what comes and when.
  template <class Line>
  void expect_fault(Line& line, const Bytes& asked, const Bytes& at_once, const Bytes& later) {
    const auto began = Clock::now();
    line.send(asked);
    EXPECT_EQ(hex(line.receive(at_once.size())), hex(at_once));
    if (!later.empty()) {
      EXPECT_EQ(hex(line.receive(later.size())), hex(later));
      EXPECT_GE(Clock::now() - began, fault_time);
    } else if (!GetParam().closes) {
      EXPECT_EQ(hex(line.receive(1, soon)), "") << "more than the fault makes";
    }
  }

  /// The fault once over TCP and once over RTU; other requests, and later ones, are answered.
  void expect_both(const ServerProcess& server) {
    TcpSocket other(server.port()), struck(server.port());
    ask_well(other, 1);
    expect_fault(struck, adu(7, request), GetParam().tcp_at_once, GetParam().tcp_later);
    if (GetParam().closes) {
      EXPECT_TRUE(struck.is_closed());
    } else {
      ask_well(struck, 9);
    }
    ask_well(other, 2);
    SerialPort serial(server);
    expect_fault(serial, rtu_adu(request), GetParam().rtu_at_once, GetParam().rtu_later);
    serial.send(rtu_adu(request));
    EXPECT_EQ(hex(serial.receive_until_silence()), hex(rtu_adu(reply)));
  }

  static void ask_well(TcpSocket& socket, std::uint16_t transaction) {
    socket.send(adu(transaction, read_known_inputs));
    EXPECT_EQ(hex(socket.receive_adu()), hex(known_reply(transaction, 4)));
  }
};

TEST_P(WireFaults, OfTheCommandLineStrike) {
  const ServerProcess server(
      {"--rtu", "pty", "--fault", fmt::format("{{{}, function: 3, count: 2}}", GetParam().rule)});
  expect_both(server);
}

TEST_P(WireFaults, OfAnInstrumentFileStrike) {
  const TemporaryFolder folder;
  std::string text = contents(source_tree / "fixtures/instruments/pocket_gloss_60.yaml");
  text +=
      fmt::format("wire: {{unit: 1, faults: [{{{}, function: 3, count: 2}}]}}\n", GetParam().rule);
  const ServerProcess server({"--rtu", "pty"}, {.instrument = folder.file("mine.yaml", text)});
  expect_both(server);
}

TEST_P(WireFaults, OfRegistersStrike) {
  const ServerProcess server({"--rtu", "pty"});
  TcpSocket master(server.port());
  const auto [fault, time_ms, code] = GetParam().form;
  // any unit, function code 3, addresses 300 to 313, twice, always; add
  master.send(adu(1, fmt::format("10 04B0 000B 16 {:04X} FFFF 0003 012C 0139 0002 000F 4240 {:04X} "
                                 "{:04X} 0001",
                                 fault, time_ms, code)));
  ASSERT_EQ(hex(master.receive_adu()), hex(adu(1, "10 04B0 000B")));
  expect_both(server);
}

INSTANTIATE_TEST_SUITE_P(All, WireFaults, testing::ValuesIn(all_cases()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(WireFaultTiming, DelayHoldsBackLaterRepliesOfItsConnectionAndNoOther) {
  const ServerProcess server({"--fault", "{fault: delay, time: 400 ms, function: 3, count: 1}"});
  TcpSocket slow(server.port()), other(server.port());
  const auto began = Clock::now();
  slow.send(adu(1, read_known) + adu(2, read_known_inputs) + adu(3, read_known));
  other.send(adu(4, read_known_inputs));
  EXPECT_EQ(other.receive_adu(), known_reply(4, 4));
  EXPECT_EQ(hex(slow.receive(1, soon)), "");
  EXPECT_EQ(slow.receive_adu(), known_reply(1));
  EXPECT_GE(Clock::now() - began, milliseconds(400));
  EXPECT_EQ(slow.receive_adu(), known_reply(2, 4));
  EXPECT_EQ(slow.receive_adu(), known_reply(3));
}

/// The time-outs of a connection do not run while it waits on demand.
TEST(WireFaultTiming, DelayLongerThanTheTimeOutsDoesNotCloseTheConnection) {
  const ServerProcess server({"--stall-timeout", "100 ms", "--idle-timeout", "100 ms", "--fault",
                              "{fault: delay, time: 400 ms, function: 3, count: 1}"});
  TcpSocket peer(server.port());
  peer.send(adu(1, read_known) + adu(2, read_known_inputs) + Bytes{0, 3, 0});
  EXPECT_EQ(peer.receive_adu(), known_reply(1));
  EXPECT_EQ(peer.receive_adu(), known_reply(2, 4));
  const Bytes rest = adu(3, read_known_inputs);
  peer.send(std::span(rest).subspan(3));
  EXPECT_EQ(peer.receive_adu(), known_reply(3, 4));
}

TEST(WireFaultTiming, ProbabilityIsSeeded) {
  const auto outcomes = [] {
    const ServerProcess server(
        {"--seed", "5", "--fault", "{fault: exception, code: 6, probability: 0.5}"});
    TcpSocket peer(server.port());
    std::string all;
    constexpr int requests = 64;
    for (int i = 0; i < requests; ++i) {
      peer.send(adu(1, request));
      all += peer.receive_adu() == adu(1, reply) ? '.' : 'x';
    }
    return all;
  };
  const std::string first = outcomes();
  EXPECT_NE(first.find('.'), std::string::npos);
  EXPECT_NE(first.find('x'), std::string::npos);
  EXPECT_EQ(first, outcomes());
}

TEST(WireFaultRegisters, ClearDropsAllRules) {
  const ServerProcess server({"--fault", "{fault: exception, code: 6, function: 3}"});
  TcpSocket peer(server.port());
  const auto ask = [&](std::string_view pdu) {
    peer.send(adu(1, pdu));
    return hex(peer.receive_adu());
  };
  EXPECT_EQ(ask(request), hex(adu(1, "83 06")));
  EXPECT_EQ(ask("06 04BA 0002"), hex(adu(1, "06 04BA 0002")));
  EXPECT_EQ(ask(request), hex(adu(1, reply)));
}

/// Else a client could make every request of everybody slower and slower.
TEST(WireFaultRegisters, AreRefusedBeyondAThousandRules) {
  const ServerProcess server;
  TcpSocket peer(server.port());
  constexpr int most = 1000;
  for (int i = 0; i <= most; ++i) {
    peer.send(adu(1, "06 04BA 0001"));
    ASSERT_EQ(hex(peer.receive_adu()), hex(adu(1, i < most ? "06 04BA 0001" : "86 04"))) << i;
  }
}

TEST(WireFaultRegisters, AreNotThereWithoutSimulation) {
  const ServerProcess server({"--no-simulation"});
  TcpSocket peer(server.port());
  for (const char* pdu : {"06 04BA 0001", "06 044C 0001", "06 045F 0001"}) {
    peer.send(adu(1, pdu));
    EXPECT_EQ(hex(peer.receive_adu()), hex(adu(1, "86 02")));
  }
}

}  // namespace
}  // namespace gonio::test
