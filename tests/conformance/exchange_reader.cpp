#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/tcp_framer.hpp"
#include "emulator/protocol/wire_number.hpp"
#include "tests/conformance/exchange.hpp"

namespace gonio::conformance {

namespace {

using modbus::Line;

/// What is known of a request when its replies are read.
struct Request {
  std::uint16_t transaction = 0;
  std::uint8_t unit = 1;
  std::uint8_t function_code = 0;
};

class Reader {
 public:
  Reader(Line line, const Profile& profile) : line_(line), profile_(profile) {}

  Exchange read(YamlMap& map) {
    (void)map.required("measure").choice({"exchange"});
    Exchange exchange;
    if (const auto note = map.optional("note")) {
      exchange.note = note->text();
    }
    read_lines(map, exchange);
    if (const auto steps = map.optional("steps")) {
      for (const YamlNode& step : steps->list()) {
        exchange.steps.push_back(
            step.read_map([&](YamlMap& step_map) { return read_step(step_map); }));
      }
    } else {
      exchange.steps.push_back(read_step(map));
    }
    if (const auto survives = map.optional("survives")) {
      exchange.survives = survives->boolean();
    }
    exchange.good = profile_.good.read_map([&](YamlMap& step) { return read_step(step); });
    exchange.missing = std::move(missing_);
    return exchange;
  }

 private:
  static void read_lines(YamlMap& map, Exchange& exchange) {
    if (const auto lines = map.optional("lines")) {
      exchange.is_for_tcp = exchange.is_for_serial = false;
      for (const YamlNode& line : lines->list()) {
        (line.choice({"tcp", "rtu"}) == "tcp" ? exchange.is_for_tcp : exchange.is_for_serial) =
            true;
      }
    }
  }

  ProbeStep read_step(YamlMap& map) {
    ProbeStep step;
    Request request{.transaction = next_transaction_++, .unit = profile_.unit};
    if (const auto unit = map.optional("unit")) {
      request.unit = static_cast<std::uint8_t>(unit->integer(0, 255));
    }
    if (const auto silence = map.optional("silence_before")) {
      step.silence_before = std::chrono::milliseconds(int(1000 * silence->time_s()));
    }
    if (const auto bytes = map.optional("bytes")) {
      step.sent = read_text(*bytes, &WireText::bytes);
    } else {
      const Bytes pdu = read_text(map.required("send"), &WireText::bytes);
      step.function_code = request.function_code = pdu.at(0);
      step.sent = framed(pdu, request);
    }
    read_expectation(map.required("expect"), request, step);
    return step;
  }

  [[nodiscard]] Bytes framed(const Bytes& pdu, const Request& request) const {
    Bytes adu(modbus::max_tcp_adu);
    adu.resize(line_ == Line::tcp
                   ? modbus::write_tcp_frame(request.transaction, request.unit, pdu, adu)
                   : modbus::write_rtu_frame(request.unit, pdu, adu));
    return adu;
  }

  void read_expectation(const YamlNode& node, const Request& request, ProbeStep& step) {
    if (node.is_scalar()) {
      const std::string end = node.choice({"silence", "close", "no_reply"});
      step.end = end == "close"      ? ProbeStep::End::closed
                 : end == "no_reply" ? ProbeStep::End::either
                                     : ProbeStep::End::open;
      return;
    }
    node.read_map([&](YamlMap& map) {
      if (const auto adus = map.optional("adus")) {
        for (const YamlNode& adu : adus->list()) {
          step.replies.push_back({read_text(adu, &WireText::pattern)});
        }
      } else if (const auto choices = map.optional("one_of")) {
        step.replies.emplace_back();
        for (const YamlNode& choice : choices->list()) {
          step.replies.back().push_back(
              choice.read_map([&](YamlMap& one) { return read_reply(one, request); }));
        }
      } else {
        step.replies.push_back({read_reply(map, request)});
      }
      return 0;
    });
  }

  BytePattern read_reply(YamlMap& map, const Request& request) {
    if (const auto exception = map.optional("exception")) {
      const auto code = static_cast<std::uint8_t>(exception->integer(1, 11));
      const auto function_code = static_cast<std::uint8_t>(request.function_code | 0x80U);
      return with_frame({.bytes = {function_code, code}}, request);
    }
    return with_frame(read_text(map.required("reply"), &WireText::pattern), request);
  }

  /// A name that the profile has not stands for 0: such a case is not run.
  template <class Result>
  Result read_text(const YamlNode& node, Result (WireText::*kind)(const std::string&)) {
    WireText::Addresses addresses = profile_.addresses;
    for (const std::string& name : address_names()) {
      if (addresses.emplace(name, std::uint16_t{0}).second &&
          node.line().find(fmt::format("{{{}}}", name)) != std::string::npos) {
        missing_.insert(name);
      }
    }
    try {
      WireText reader(addresses, profile_.unit);
      return (reader.*kind)(node.line());
    } catch (const WireTextError& error) {
      node.fail(error.expected(), error.found());
    }
  }

  /// A PDU with its header, or with unit and CRC: any where it cannot be known.
  [[nodiscard]] BytePattern with_frame(const BytePattern& pdu, const Request& request) const {
    BytePattern adu = pdu;
    const auto before = [&](std::initializer_list<std::optional<std::uint8_t>> bytes) {
      adu.bytes.insert(adu.bytes.begin(), bytes);
    };
    if (line_ == Line::serial) {
      before({request.unit});
      if (!adu.is_open) {
        adu.bytes.resize(adu.bytes.size() + 2);  // the line judges the CRC
      }
      return adu;
    }
    const auto length =
        pdu.is_open ? std::nullopt : std::optional(static_cast<std::uint8_t>(pdu.bytes.size() + 1));
    before({modbus::high_byte(request.transaction), modbus::low_byte(request.transaction), 0, 0, 0,
            length, request.unit});
    return adu;
  }

  Line line_;
  const Profile& profile_;
  std::uint16_t next_transaction_ = 0x4700;
  std::set<std::string> missing_;
};

}  // namespace

const std::set<std::string>& address_names() {
  static const std::set<std::string> names{
      "known",          // two holding registers that can be read
      "input",          // two input registers
      "scratch",        // a holding register that takes any number from 2 to 9, and keeps it
      "coil",           // a coil that can be read
      "scratch_coil",   // one that takes both values without harm
      "memory_coil",    // one that keeps them
      "discrete",       // a discrete input
      "many",           // the first of 125 holding registers that take any number, and keep it
      "many_input",     // the first of 125 input registers
      "many_coils",     // the first of 2000 coils that take both values, and keep them
      "many_discrete",  // the first of 2000 discrete inputs
      "nowhere",        // no table has anything here
  };
  return names;
}

Profile Profile::load(const std::filesystem::path& path) {
  return YamlNode::load(path).read_map([](YamlMap& map) {
    map.expect_schema("gonio/modbus_profile/1");
    Profile profile{.title = map.required("title").line(), .good = map.required("good")};
    (void)map.optional("notes");
    profile.unit = static_cast<std::uint8_t>(map.required("unit").integer(0, 255));
    map.required("addresses").for_each_entry([&](const std::string& name, const YamlNode& node) {
      if (!address_names().contains(name)) {
        node.fail(fmt::format("an address named {}", fmt::join(address_names(), ", ")), name);
      }
      profile.addresses[name] = static_cast<std::uint16_t>(node.integer(0, 0xFFFF));
    });
    return profile;
  });
}

Exchange read_exchange(const YamlNode& when, modbus::Line line, const Profile& profile) {
  return when.read_map([&](YamlMap& map) { return Reader(line, profile).read(map); });
}

}  // namespace gonio::conformance
