#include "tests/conformance/exchange.hpp"

#include <gmock/gmock.h>

#include <deque>
#include <filesystem>

#include "tests/conformance/wire_cases.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::conformance {
namespace {

using modbus::Line;
using test::message_of;
using testing::HasSubstr;
using testing::StartsWith;

/// A line that gives what it is told to; nothing each time that is an empty reply.
class ScriptedLine final : public ProbedLine {
 public:
  explicit ScriptedLine(std::deque<Bytes> replies, bool closed = false)
      : replies_(std::move(replies)), closed_(closed) {}
  [[nodiscard]] Line kind() const override { return Line::tcp; }
  void renew() override { ++renewals; }
  void send(std::span<const std::uint8_t> bytes, std::chrono::milliseconds) override {
    sent.push_back(hex(bytes));
  }
  Bytes receive() override {
    if (replies_.empty()) {
      return {};
    }
    Bytes reply = replies_.front();
    replies_.pop_front();
    return reply;
  }
  bool is_closed() override { return closed_; }

  std::vector<std::string> sent;
  int renewals = 0;

 private:
  std::deque<Bytes> replies_;
  bool closed_;
};

/// Sends 01 and expects 11; the good request is 02, to be answered with 22.
Exchange exchange() {
  Exchange result;
  result.steps = {{.sent = {1}, .replies = {{{.bytes = {0x11}}}}}};
  result.good = {.sent = {2}, .replies = {{{.bytes = {0x22}}}}};
  return result;
}

std::string failure(const Exchange& exchange, std::deque<Bytes> replies, bool closed = false) {
  ScriptedLine line(std::move(replies), closed);
  return failure_of(exchange, line);
}

TEST(FailureOfAnExchange, IsAWrongReplyOrNoneOrMore) {
  EXPECT_EQ(failure(exchange(), {{0x11}, {}, {0x22}}), "");
  EXPECT_EQ(failure(exchange(), {{0x12}}), "sent 01: expected 11 , found 12");
  EXPECT_EQ(failure(exchange(), {}), "sent 01: expected 11 , found no reply");
  EXPECT_EQ(failure(exchange(), {{0x11}, {0x33}}), "sent 01: expected no more, found 33");
}

TEST(FailureOfAnExchange, IsALineThatIsBrokenAfterwards) {
  EXPECT_EQ(failure(exchange(), {{0x11}, {}, {}}),
            "good request afterwards: sent 02: expected 22 , found no reply");
  Exchange broken = exchange();
  broken.survives = false;
  EXPECT_EQ(failure(broken, {{0x11}}), "");
  EXPECT_EQ(failure(broken, {{0x11}, {}, {0x22}}),
            "good request afterwards: sent 02: expected no more, found 22");
}

TEST(FailureOfAnExchange, IsNoneOfSeveralReplies) {
  Exchange either = exchange();
  either.steps[0].replies = {{{.bytes = {0x11}}, {.bytes = {0x12}, .is_open = true}}};
  EXPECT_EQ(failure(either, {{0x12, 0x13}, {}, {0x22}}), "");
  EXPECT_EQ(failure(either, {{0x13}}), "sent 01: expected 11 or 12 ..., found 13");
}

TEST(FailureOfAnExchange, IsALineThatStaysOpen) {
  Exchange closing = exchange();
  closing.steps[0].replies.clear();
  closing.steps[0].end = ProbeStep::End::closed;
  EXPECT_EQ(failure(closing, {}), "expected that the line is closed, found it open");
  EXPECT_EQ(failure(closing, {{}, {0x22}}, true), "");
}

TEST(FailureOfAnExchange, IsAServerThatServesNoNewConnection) {
  Exchange silent = exchange();
  silent.steps[0].replies.clear();
  silent.steps[0].end = ProbeStep::End::either;
  EXPECT_EQ(failure(silent, {{}, {0x22}}), "");
  EXPECT_EQ(failure(silent, {{}, {}}),
            "good request afterwards: sent 02: expected 22 , found no reply");
  EXPECT_EQ(failure(silent, {{0x11}}), "sent 01: expected no more, found 11");
}

const Profile& profile() {
  static const Profile gonio = shipped_profile(GONIO_SOURCE_DIR, "gonio");
  return gonio;
}

YamlNode when(const std::string& text) {
  return YamlNode::parse("{measure: exchange, " + text + "}", "mine.yaml");
}

ExchangeResult run(const std::string& text, std::deque<Bytes> replies) {
  ScriptedLine line(std::move(replies));
  return run_exchange(when(text), line, profile());
}

// The good request of the profile is the second, or the one after what is sent.
const Bytes good_reply = {0x47, 0x01, 0, 0, 0, 7, 1, 3, 4, 0xC2, 0xF6, 0xE6, 0x66};
const Bytes unknown_function = {0x47, 0x00, 0, 0, 0, 3, 1, 0x96, 1};

TEST(RunExchange, PutsTheHeaderRoundWhatIsSentAndExpected) {
  ScriptedLine line({{0x47, 0x00, 0, 0, 0, 5, 1, 3, 2, 0xAB, 0xCD}, {}, good_reply});
  const auto result = run_exchange(
      when("send: \"03 {known} 0001\", expect: {reply: \"03 02 .. ..\"}"), line, profile());
  EXPECT_TRUE(result.passed) << result.failure;
  EXPECT_EQ(line.renewals, 1);
  EXPECT_THAT(line.sent, testing::ElementsAre("47 00 00 00 00 06 01 03 01 2C 00 01",
                                              "47 01 00 00 00 06 01 03 01 2C 00 02"));
}

TEST(RunExchange, TellsWhatFails) {
  const auto result = run("send: \"41\", expect: {exception: 1}", {{0x47, 0, 0, 0, 0, 2, 1, 0x41}});
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.skipped, "");
  EXPECT_THAT(result.failure, HasSubstr("found 47 00 00 00 00 02 01 41"));
}

TEST(RunExchange, SkipsWhatIsForAnotherLine) {
  EXPECT_EQ(run("lines: [rtu], send: \"03\", expect: silence", {}).skipped, "not for TCP");
}

TEST(RunExchange, SkipsWhatTheProfileHasNot) {
  EXPECT_EQ(run("send: \"03 {many} 007D\", expect: {reply: \"03 ...\"}", {}).skipped,
            "the profile of the device names no address many");
}

TEST(RunExchange, SkipsAFunctionThatTheDeviceRefusesInTheRightFormToo) {
  const std::string mask = "send: \"16 {scratch} FFFD\", expect: {exception: 3}";
  EXPECT_EQ(run(mask, {unknown_function, unknown_function}).skipped,
            "the device does not serve function code 16h");
  const Bytes served = {0x47, 0, 0, 0, 0, 8, 1, 0x16, 0x03, 0xEB, 0xFF, 0xFF, 0, 0};
  const auto result = run(mask, {unknown_function, served});
  EXPECT_EQ(result.skipped, "");
  EXPECT_FALSE(result.passed);
}

TEST(Answers, TellsWhetherAGoodRequestIsServed) {
  ScriptedLine there({good_reply}), silent({});
  EXPECT_TRUE(answers(there, profile()));
  EXPECT_EQ(there.renewals, 1);
  EXPECT_FALSE(answers(silent, profile()));
}

TEST(ReadExchange, RefusesWhatNobodyKnows) {
  const auto message = [&](const std::string& text) {
    return message_of([&] { (void)read_exchange(when(text), Line::tcp, profile()); });
  };
  EXPECT_EQ(message("send: \"03 {knwon} 0001\", expect: silence"),
            "mine.yaml:1:27: send: expected the name of an address, found 'knwon'");
  EXPECT_THAT(message("send: \"03\""), HasSubstr("expect"));
  EXPECT_THAT(message("send: \"03\", expect: noise"), HasSubstr("silence, close, no_reply"));
  EXPECT_THAT(message("send: \"03\", expect: silence, repeat: 3"), HasSubstr("repeat"));
  EXPECT_THAT(message("lines: [udp], send: \"03\", expect: silence"), HasSubstr("udp"));
}

TEST(Profile, RefusesNamesThatNoCaseUses) {
  EXPECT_TRUE(profile().addresses.contains("nowhere"));
  for (const char* name : {"gonio", "plain"}) {
    EXPECT_EQ(shipped_profile(GONIO_SOURCE_DIR, name).unit, 1) << name;
  }
  EXPECT_THROW((void)shipped_profile(GONIO_SOURCE_DIR, "absent"), InputError);
}

TEST(WireCases, AreAllOfTheirFiles) {
  // A case whose clause nobody knows would be left out.
  const Profile plain = shipped_profile(GONIO_SOURCE_DIR, "plain");
  std::set<std::string> ids;
  for (const Line line : {Line::tcp, Line::serial}) {
    for (const WireCase& one : wire_cases(GONIO_SOURCE_DIR, line, plain)) {
      ids.insert(one.id);
    }
  }
  std::size_t stated = 0;
  const std::filesystem::path folder =
      std::filesystem::path(GONIO_SOURCE_DIR) / "standards/modbus/v1_1b3/cases";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    YamlNode::load(file.path()).read_map([&](YamlMap& map) {
      map.expect_schema("gonio/cases/1");
      stated += map.required("cases").list().size();
      return 0;
    });
  }
  EXPECT_EQ(ids.size(), stated);
}

}  // namespace
}  // namespace gonio::conformance
