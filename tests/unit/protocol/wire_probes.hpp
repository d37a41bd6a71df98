#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "emulator/core/yaml_map.hpp"
#include "emulator/protocol/modbus.hpp"
#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/tcp_framer.hpp"
#include "tests/unit/protocol/wire_text.hpp"

namespace gonio::test {

/// Something sent, ready for the line, and what must come back.
struct ProbeStep {
  Bytes sent = {};
  std::chrono::milliseconds silence_before{20};
  std::vector<BytePattern> replies = {};  ///< whole ADUs; none: nothing comes
  bool closes = false;
};

/// One item of fixtures/wire.
struct WireProbe {
  std::string id = {}, note = {}, source = {};
  modbus::Line line = modbus::Line::tcp;
  std::vector<ProbeStep> steps = {};
  bool survives = true;  ///< a good request is answered afterwards
  ProbeStep good = {};   ///< that request

  [[nodiscard]] bool closes() const { return steps.back().closes; }
};
inline void PrintTo(const WireProbe& probe, std::ostream* out) { *out << probe.note; }

/// What is probed: a server over TCP or a serial line, or its parts in process.
class ProbedLine {
 public:
  virtual ~ProbedLine() = default;
  virtual void send(std::span<const std::uint8_t> bytes,
                    std::chrono::milliseconds silence_before) = 0;
  /// The next reply, whole; empty if none comes within the time one waits for it.
  virtual Bytes receive() = 0;
  /// The same where none is expected: one waits for less time.
  virtual Bytes receive_more() { return receive(); }
  /// Whether the other side has closed the line, or does so within the time one waits for it.
  virtual bool is_closed() = 0;
};

/// Does what the probe says. @return  what was not as expected; empty if all was.
inline std::string failure_of(const WireProbe& probe, ProbedLine& line) {
  const auto failure_of_step = [&](const ProbeStep& step) -> std::string {
    line.send(step.sent, step.silence_before);
    for (const BytePattern& expected : step.replies) {
      const Bytes reply = line.receive();
      if (!expected.matches(reply)) {
        return fmt::format("sent {}: expected {}, found {}", hex(step.sent), expected.text(),
                           reply.empty() ? "no reply" : hex(reply));
      }
    }
    const Bytes more = line.receive_more();
    return more.empty()
               ? ""
               : fmt::format("sent {}: expected no more, found {}", hex(step.sent), hex(more));
  };
  for (const ProbeStep& step : probe.steps) {
    if (std::string failure = failure_of_step(step); !failure.empty()) {
      return failure;
    }
  }
  if (probe.closes()) {
    return line.is_closed() ? "" : "expected that the line is closed, found it open";
  }
  ProbeStep good = probe.good;
  if (!probe.survives) {
    good.replies.clear();
  }
  const std::string failure = failure_of_step(good);
  return failure.empty() ? "" : "good request afterwards: " + failure;
}

/// Reads fixtures/wire/.
class WireProbeReader {
 public:
  /// @throws InputError  for files that are not as their schema says.
  explicit WireProbeReader(std::filesystem::path folder) : folder_(std::move(folder)) {
    YamlNode::load(folder_ / "unit.yaml").read_map([&](YamlMap& map) {
      map.expect_schema("gonio/wire_unit/1");
      (void)map.optional("title");
      (void)map.optional("notes");
      unit_ = static_cast<std::uint8_t>(map.required("unit").integer(1, 247));
      map.required("addresses").for_each_entry([&](const std::string& name, const YamlNode& node) {
        addresses_[name] = static_cast<std::uint16_t>(node.integer(0, 0xFFFF));
      });
      good_ = map.required("good");
      return 0;
    });
  }

  /// All probes of the line, from all files.
  [[nodiscard]] std::vector<WireProbe> read(modbus::Line line) const {
    std::vector<WireProbe> probes;
    for (const char* file : {"functions.yaml", "tcp.yaml", "rtu.yaml"}) {
      YamlNode::load(folder_ / file).read_map([&](YamlMap& map) {
        map.expect_schema("gonio/wire_probes/1");
        (void)map.optional("title");
        (void)map.optional("notes");
        bool is_for_line = false;
        for (const YamlNode& node : map.required("lines").list()) {
          const bool is_tcp = node.choice({"tcp", "rtu"}) == "tcp";
          is_for_line = is_for_line || is_tcp == (line == modbus::Line::tcp);
        }
        for (const YamlNode& node : map.required("probes").list()) {
          WireProbe probe = read_probe(node, line);
          if (is_for_line) {
            probes.push_back(std::move(probe));
          }
        }
        return 0;
      });
    }
    return probes;
  }

 private:
  [[nodiscard]] WireProbe read_probe(const YamlNode& node, modbus::Line line) const {
    return node.read_map([&](YamlMap& map) {
      WireProbe probe;
      probe.id = map.required("id").id();
      probe.line = line;
      probe.source = map.required("source").line();
      if (const auto note = map.optional("note")) {
        probe.note = note->text();
      }
      if (const auto steps = map.optional("steps")) {
        for (const YamlNode& step : steps->list()) {
          probe.steps.push_back(step.read_map(
              [&](YamlMap& step_map) { return read_step(step_map, line, probe.steps.size()); }));
        }
      } else {
        probe.steps.push_back(read_step(map, line, 0));
      }
      if (const auto survives = map.optional("survives")) {
        probe.survives = survives->boolean();
      }
      probe.good = good_->read_map(
          [&](YamlMap& step_map) { return read_step(step_map, line, probe.steps.size()); });
      return probe;
    });
  }

  /// What is known of a request when its replies are read.
  struct Context {
    modbus::Line line;
    std::uint16_t transaction;
    std::uint8_t unit;
    std::uint8_t function_code;
  };

  [[nodiscard]] ProbeStep read_step(YamlMap& map, modbus::Line line, std::size_t index) const {
    ProbeStep step;
    Context context{line, static_cast<std::uint16_t>(0x4700 + index), unit_, 0};
    if (const auto unit = map.optional("unit")) {
      context.unit = static_cast<std::uint8_t>(unit->integer(0, 255));
    }
    if (const auto silence = map.optional("silence_before")) {
      step.silence_before = std::chrono::milliseconds(int(1000 * silence->time_s()));
    }
    if (const auto bytes = map.optional("bytes")) {
      step.sent = read_text(*bytes, &WireText::bytes);
    } else {
      const Bytes pdu = read_text(map.required("send"), &WireText::bytes);
      context.function_code = pdu.at(0);
      step.sent.resize(modbus::max_tcp_adu);
      step.sent.resize(
          line == modbus::Line::tcp
              ? modbus::write_tcp_frame(context.transaction, context.unit, pdu, step.sent)
              : modbus::write_rtu_frame(context.unit, pdu, step.sent));
    }
    read_expectation(map.required("expect"), context, step);
    return step;
  }

  void read_expectation(const YamlNode& node, const Context& context, ProbeStep& step) const {
    if (node.is_scalar()) {
      step.closes = node.choice({"silence", "close"}) == "close";
      return;
    }
    node.read_map([&](YamlMap& map) {
      if (const auto adus = map.optional("adus")) {
        for (const YamlNode& adu : adus->list()) {
          step.replies.push_back(read_text(adu, &WireText::pattern));
        }
      } else if (const auto exception = map.optional("exception")) {
        const auto code = static_cast<std::uint8_t>(exception->integer(1, 11));
        const auto function_code = static_cast<std::uint8_t>(context.function_code | 0x80U);
        step.replies.push_back(with_frame({.bytes = {function_code, code}}, context));
      } else {
        step.replies.push_back(
            with_frame(read_text(map.required("reply"), &WireText::pattern), context));
      }
      return 0;
    });
  }

  template <class Result>
  [[nodiscard]] Result read_text(const YamlNode& node,
                                 Result (WireText::*kind)(const std::string&)) const {
    try {
      WireText reader(addresses_, unit_);
      return (reader.*kind)(node.line());
    } catch (const std::invalid_argument& error) {
      node.fail(error.what());
    }
  }

  /// A PDU with its header, or with unit and CRC: any where it cannot be known.
  [[nodiscard]] static BytePattern with_frame(const BytePattern& pdu, const Context& context) {
    BytePattern adu = pdu;
    const auto before = [&](std::initializer_list<std::optional<std::uint8_t>> bytes) {
      adu.bytes.insert(adu.bytes.begin(), bytes);
    };
    if (context.line == modbus::Line::serial) {
      before({context.unit});
      if (!adu.is_open) {
        adu.bytes.resize(adu.bytes.size() + 2);  // the line judges the CRC
      }
      return adu;
    }
    const auto length =
        pdu.is_open ? std::nullopt : std::optional(static_cast<std::uint8_t>(pdu.bytes.size() + 1));
    before({modbus::high_byte(context.transaction), modbus::low_byte(context.transaction), 0, 0, 0,
            length, context.unit});
    return adu;
  }

  std::filesystem::path folder_;
  std::uint8_t unit_ = 1;
  WireText::Addresses addresses_ = {};
  std::optional<YamlNode> good_ = {};
};

}  // namespace gonio::test
