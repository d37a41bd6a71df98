#include "tests/conformance/exchange.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

namespace gonio::conformance {

namespace {

using modbus::Line;
using Patterns = std::vector<BytePattern>;

/// What was not as expected.
struct Failure {
  std::string text = {};
  const ProbeStep* step = nullptr;  ///< where
  Bytes found = {};                 ///< what came instead
};

bool matches(const Patterns& expected, std::span<const std::uint8_t> found) {
  return std::ranges::any_of(expected, [&](const BytePattern& one) { return one.matches(found); });
}

std::string text_of(const Patterns& expected) {
  std::vector<std::string> texts;
  for (const BytePattern& one : expected) {
    texts.push_back(one.text());
  }
  return fmt::format("{}", fmt::join(texts, "or "));
}

Failure failure_of_step(const ProbeStep& step, ProbedLine& line) {
  line.send(step.sent, step.silence_before);
  for (const Patterns& expected : step.replies) {
    const Bytes reply = line.receive();
    if (!matches(expected, reply)) {
      return {fmt::format("sent {}: expected {}, found {}", hex(step.sent), text_of(expected),
                          reply.empty() ? "no reply" : hex(reply)),
              &step, reply};
    }
  }
  // Some answer noise late. Where the line may be closed, one need not wait for that to end.
  const Bytes more = step.end == ProbeStep::End::either ? line.receive() : line.receive_more();
  return more.empty() ? Failure{}
                      : Failure{fmt::format("sent {}: expected no more, found {}", hex(step.sent),
                                            hex(more)),
                                &step, more};
}

Failure failure_at_the_end(const Exchange& exchange, ProbedLine& line) {
  const ProbeStep::End end = exchange.steps.back().end;
  if (end == ProbeStep::End::closed && !line.is_closed()) {
    return {"expected that the line is closed, found it open"};
  }
  if (end != ProbeStep::End::open) {
    line.renew();
  }
  ProbeStep good = exchange.good;
  if (!exchange.survives) {
    good.replies.clear();
  }
  Failure failure = failure_of_step(good, line);
  if (!failure.text.empty()) {
    failure = {"good request afterwards: " + failure.text};
  }
  return failure;
}

Failure first_failure(const Exchange& exchange, ProbedLine& line) {
  for (const ProbeStep& step : exchange.steps) {
    if (Failure failure = failure_of_step(step, line); !failure.text.empty()) {
      return failure;
    }
  }
  return failure_at_the_end(exchange, line);
}

/// A request that a server which knows the function answers with something else than exception 01.
std::string good_request(std::uint8_t function_code) {
  static const std::map<int, std::string> requests{
      {0x01, "01 {coil} 0001"},
      {0x02, "02 {discrete} 0001"},
      {0x03, "03 {known} 0001"},
      {0x04, "04 {input} 0001"},
      {0x05, "05 {scratch_coil} 0000"},
      {0x06, "06 {scratch} 0005"},
      {0x08, "08 0000 A537"},
      {0x0F, "0F {scratch_coil} 0001 01 00"},
      {0x10, "10 {scratch} 0001 02 0005"},
      {0x11, "11"},
      {0x16, "16 {scratch} FFFF 0000"},
      {0x17, "17 {known} 0001 {scratch} 0001 02 0005"},
      {0x2B, "2B 0E 01 00"},
  };
  const auto found = requests.find(function_code);
  return found == requests.end() ? "" : found->second;
}

bool is_function_unknown(const Bytes& reply, std::uint8_t function_code, Line line) {
  const std::size_t begin = line == Line::tcp ? 7 : 1;
  return reply.size() > begin + 1 && reply[begin] == (function_code | 0x80U) &&
         reply[begin + 1] == 1;
}

/// Asks for a function in the right way. @return  whether the answer is exception 01.
bool lacks_function(std::uint8_t function_code, ProbedLine& line, const Profile& profile) {
  const std::string request = good_request(function_code);
  const auto name_end = request.find('}');
  if (request.empty() || (name_end != std::string::npos &&
                          !profile.addresses.contains(request.substr(4, name_end - 4)))) {
    return false;
  }
  const YamlNode when = YamlNode::parse(
      fmt::format("{{measure: exchange, send: \"{}\", expect: silence}}", request), "good request");
  line.renew();
  const Exchange exchange = read_exchange(when, line.kind(), profile);
  line.send(exchange.steps.front().sent, exchange.steps.front().silence_before);
  return is_function_unknown(line.receive(), function_code, line.kind());
}

}  // namespace

std::string failure_of(const Exchange& exchange, ProbedLine& line) {
  return first_failure(exchange, line).text;
}

bool answers(ProbedLine& line, const Profile& profile) {
  const YamlNode nothing =
      YamlNode::parse("{measure: exchange, bytes: \"00\", expect: silence}", "good request");
  line.renew();
  return failure_of_step(read_exchange(nothing, line.kind(), profile).good, line).text.empty();
}

ExchangeResult run_exchange(const YamlNode& when, ProbedLine& line, const Profile& profile) {
  const Exchange exchange = read_exchange(when, line.kind(), profile);
  if (!exchange.is_for(line.kind())) {
    return {.skipped = line.kind() == Line::tcp ? "not for TCP" : "not for a serial line"};
  }
  if (!exchange.missing.empty()) {
    return {.skipped = fmt::format("the profile of the device names no address {}",
                                   fmt::join(exchange.missing, ", "))};
  }
  line.renew();
  const Failure failure = first_failure(exchange, line);
  if (failure.step != nullptr && failure.step->function_code != 0 &&
      is_function_unknown(failure.found, failure.step->function_code, line.kind()) &&
      lacks_function(failure.step->function_code, line, profile)) {
    return {.skipped = fmt::format("the device does not serve function code {:02X}h",
                                   failure.step->function_code)};
  }
  return {.passed = failure.text.empty(), .failure = failure.text};
}

}  // namespace gonio::conformance
