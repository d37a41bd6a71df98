// The probes of fixtures/wire, sent to framers and PDU function in process.
#include "tests/unit/protocol/wire_probes.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <string>

#include "emulator/protocol/pdu.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/protocol/fake_unit.hpp"

namespace gonio::test {
namespace {

const std::filesystem::path folder = std::filesystem::path(GONIO_SOURCE_DIR) / "fixtures/wire";

/// A unit with everything that fixtures/wire/unit.yaml names.
FakeUnit probed_unit() {
  FakeUnit unit(300, 2800);
  unit.identity.objects = {{0, "vendor"}, {1, "code"}, {2, "1.0"}, {0x80, "serial number"}};
  return unit;
}

class TcpInProcess final : public ProbedLine {
 public:
  void send(std::span<const std::uint8_t> bytes, std::chrono::milliseconds /*silence*/) override {
    while (!bytes.empty() && !framer_.is_corrupt()) {
      const std::span<std::uint8_t> space = framer_.space();
      const std::size_t count = std::min(space.size(), bytes.size());
      std::copy_n(bytes.begin(), count, space.begin());
      framer_.received(count);
      bytes = bytes.subspan(count);
      while (const auto frame = framer_.next()) {
        reply_to(*frame);
      }
    }
  }
  Bytes receive() override {
    if (replies_.empty()) {
      return {};
    }
    Bytes reply = replies_.front();
    replies_.pop_front();
    return reply;
  }
  bool is_closed() override { return framer_.is_corrupt(); }

 private:
  void reply_to(const modbus::TcpFrame& frame) {
    const bool is_there = frame.unit == 0 || frame.unit == 1 || frame.unit == 255;
    const modbus::Pdu pdu =
        is_there ? answer(frame.pdu, unit_, modbus::Line::tcp)
                 : exception_pdu(frame.pdu[0], modbus::Exception::gateway_target_failed);
    Bytes adu(modbus::max_tcp_adu);
    adu.resize(modbus::write_tcp_frame(frame.transaction, frame.unit, pdu.bytes(), adu));
    replies_.push_back(adu);
  }

  modbus::TcpFramer framer_;
  FakeUnit unit_ = probed_unit();
  std::deque<Bytes> replies_;
};

class SerialInProcess final : public ProbedLine {
 public:
  void send(std::span<const std::uint8_t> bytes, std::chrono::milliseconds silence) override {
    now_ += silence;
    take_frame();
    framer_.feed(bytes, now_);
  }
  Bytes receive() override {
    now_ += std::chrono::seconds(1);
    take_frame();
    return std::exchange(reply_, {});
  }
  bool is_closed() override { return false; }

 private:
  void take_frame() {
    const auto frame = framer_.end_of_frame(now_);
    if (!frame || frame->unit > 1) {
      return;
    }
    const modbus::Pdu pdu = answer(frame->pdu, unit_, modbus::Line::serial);
    if (frame->unit == 1) {
      reply_.resize(modbus::max_rtu_adu);
      reply_.resize(modbus::write_rtu_frame(1, pdu.bytes(), reply_));
    }
  }

  modbus::RtuFramer framer_{modbus::silence_between_frames(19200)};
  modbus::RtuFramer::Time now_{};
  FakeUnit unit_ = probed_unit();
  Bytes reply_;
};

class WireProbeInProcess : public testing::TestWithParam<WireProbe> {};

TEST_P(WireProbeInProcess, IsAnsweredAsExpected) {
  const WireProbe& probe = GetParam();
  RecordProperty("source", probe.source);
  TcpInProcess tcp;
  SerialInProcess serial;
  ProbedLine& line = probe.line == modbus::Line::tcp ? static_cast<ProbedLine&>(tcp) : serial;
  EXPECT_EQ(failure_of(probe, line), "");
}

const auto id_of = [](const auto& info) { return info.param.id; };
INSTANTIATE_TEST_SUITE_P(Tcp, WireProbeInProcess,
                         testing::ValuesIn(WireProbeReader(folder).read(modbus::Line::tcp)), id_of);
INSTANTIATE_TEST_SUITE_P(Rtu, WireProbeInProcess,
                         testing::ValuesIn(WireProbeReader(folder).read(modbus::Line::serial)),
                         id_of);

/// A line that gives what it is told to.
class ScriptedLine final : public ProbedLine {
 public:
  explicit ScriptedLine(std::deque<Bytes> replies, bool closed = false)
      : replies_(std::move(replies)), closed_(closed) {}
  void send(std::span<const std::uint8_t>, std::chrono::milliseconds) override {}
  Bytes receive() override {
    if (replies_.empty()) {
      return {};
    }
    Bytes reply = replies_.front();
    replies_.pop_front();
    return reply;
  }
  bool is_closed() override { return closed_; }

 private:
  std::deque<Bytes> replies_;
  bool closed_;
};

TEST(WireProbe, FailsForAWrongReplyOrNoneOrMore) {
  WireProbe probe;
  probe.good = {.sent = {2}, .replies = {{.bytes = {0x22}}}};
  probe.steps = {{.sent = {1}, .replies = {{.bytes = {0x11}}}}};
  const auto failure = [&](std::deque<Bytes> replies) {
    ScriptedLine line(std::move(replies));
    return failure_of(probe, line);
  };
  EXPECT_EQ(failure({{0x11}, {}, {0x22}}), "");
  EXPECT_EQ(failure({{0x12}}), "sent 01: expected 11 , found 12");
  EXPECT_EQ(failure({}), "sent 01: expected 11 , found no reply");
  EXPECT_EQ(failure({{0x11}, {0x33}}), "sent 01: expected no more, found 33");
  EXPECT_EQ(failure({{0x11}, {}, {}}),
            "good request afterwards: sent 02: expected 22 , found no reply");
  probe.survives = false;
  EXPECT_EQ(failure({{0x11}}), "");
  EXPECT_EQ(failure({{0x11}, {}, {0x22}}),
            "good request afterwards: sent 02: expected no more, found 22");
}

TEST(WireProbe, FailsForALineThatStaysOpen) {
  WireProbe probe;
  probe.steps = {{.sent = {1}, .closes = true}};
  ScriptedLine open({}), closed({}, true);
  EXPECT_EQ(failure_of(probe, open), "expected that the line is closed, found it open");
  EXPECT_EQ(failure_of(probe, closed), "");
}

TEST(WireText, ReadsHexNamesRepetitionsAndCrcs) {
  const WireText::Addresses addresses = {{"known", 0x012C}};
  WireText text(addresses, 17);
  EXPECT_EQ(hex(text.bytes("0A0b {known} {unit} FF*3")), "0A 0B 01 2C 11 FF FF FF");
  EXPECT_EQ(hex(text.bytes("01 03 0000 0002 {crc}")), "01 03 00 00 00 02 C4 0B");
  EXPECT_EQ(hex(text.bytes("01 03 0000 0002 {bad_crc}")), "01 03 00 00 00 02 3B F4");
  EXPECT_EQ(hex(text.bytes("55 {start} 01 03 0000 0002 {crc}")), "55 01 03 00 00 00 02 C4 0B");
}

TEST(WireText, RefusesWhatItDoesNotKnow) {
  const WireText::Addresses addresses;
  WireText text(addresses, 1);
  const auto message = [&](const std::string& words) {
    return message_of([&] { (void)text.bytes(words); });
  };
  EXPECT_EQ(message("01 {known}"), "expected the name of an address, found 'known'");
  EXPECT_EQ(message("012"), "expected pairs of hex digits, found '012'");
  EXPECT_EQ(message("0x"), "expected pairs of hex digits, found '0x'");
  EXPECT_EQ(message("01 .."), "expected a byte that is known, found '..'");
  EXPECT_EQ(message("01 ..."), "expected a byte to send, found '...'");
  EXPECT_EQ(message("... 01"), "expected nothing after '...', found '01'");
}

TEST(BytePattern, MatchesAnyByteWhereItIsOpen) {
  const WireText::Addresses addresses;
  const BytePattern closed = WireText(addresses, 1).pattern("01 .. 03");
  EXPECT_TRUE(closed.matches(Bytes{1, 99, 3}));
  EXPECT_FALSE(closed.matches(Bytes{1, 99, 4}));
  EXPECT_FALSE(closed.matches(Bytes{1, 99, 3, 4}));
  EXPECT_FALSE(closed.matches(Bytes{1, 99}));
  const BytePattern open = WireText(addresses, 1).pattern("01 ...");
  EXPECT_TRUE(open.matches(Bytes{1}));
  EXPECT_TRUE(open.matches(Bytes{1, 2, 3}));
  EXPECT_FALSE(open.matches(Bytes{2, 2, 3}));
}

}  // namespace
}  // namespace gonio::test
