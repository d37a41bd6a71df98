// The wire cases of standards/modbus, sent to framers and PDU function in process.
#include "tests/conformance/wire_cases.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <string>

#include "emulator/protocol/pdu.hpp"
#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/tcp_framer.hpp"
#include "tests/unit/protocol/fake_unit.hpp"

namespace gonio::test {
namespace {

using conformance::ProbedLine;
using conformance::WireCase;
using modbus::Line;

/// A unit with everything that the profile `plain` names.
FakeUnit probed_unit() {
  FakeUnit unit(300, 2800);
  unit.identity.objects = {{0, "vendor"}, {1, "code"}, {2, "1.0"}, {0x80, "serial number"}};
  return unit;
}

class TcpInProcess final : public ProbedLine {
 public:
  [[nodiscard]] Line kind() const override { return Line::tcp; }
  void renew() override {
    framer_ = {};
    replies_.clear();
  }
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
        is_there ? answer(frame.pdu, unit_, Line::tcp)
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
  [[nodiscard]] Line kind() const override { return Line::serial; }
  void renew() override { (void)receive(); }
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
    const modbus::Pdu pdu = answer(frame->pdu, unit_, Line::serial);
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

std::vector<WireCase> cases(Line line) {
  return conformance::wire_cases(GONIO_SOURCE_DIR, line,
                                 conformance::shipped_profile(GONIO_SOURCE_DIR, "plain"));
}

class WireCaseOverTcp : public testing::TestWithParam<WireCase> {};
class WireCaseOnASerialLine : public testing::TestWithParam<WireCase> {};

TEST_P(WireCaseOverTcp, IsAnsweredAsExpected) {
  TcpInProcess line;
  EXPECT_EQ(failure_of(GetParam().exchange, line), "");
}

TEST_P(WireCaseOnASerialLine, IsAnsweredAsExpected) {
  SerialInProcess line;
  EXPECT_EQ(failure_of(GetParam().exchange, line), "");
}

const auto id_of = [](const auto& info) { return info.param.id; };
INSTANTIATE_TEST_SUITE_P(Wire, WireCaseOverTcp, testing::ValuesIn(cases(Line::tcp)), id_of);
INSTANTIATE_TEST_SUITE_P(Wire, WireCaseOnASerialLine, testing::ValuesIn(cases(Line::serial)),
                         id_of);

}  // namespace
}  // namespace gonio::test
