#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "emulator/core/yaml_map.hpp"
#include "emulator/protocol/modbus.hpp"
#include "tests/conformance/wire_text.hpp"

// What `measure: exchange` of a wire case says: what is sent to a Modbus server, and what must come
// back. standards/modbus/README.md tells the form.

namespace gonio::conformance {

/// What stands at which address of the device that is probed.
struct Profile {
  std::string title;
  std::uint8_t unit = 1;
  WireText::Addresses addresses = {};  ///< by the names that address_names() has
  YamlNode good;  ///< a request, and its answer, that shows whether a line still works

  /// Reads a file of schema gonio/modbus_profile/1. @throws InputError
  [[nodiscard]] static Profile load(const std::filesystem::path& path);
};

/// The names that a profile may give addresses to. A case that uses one which the profile has not
/// is skipped.
[[nodiscard]] const std::set<std::string>& address_names();

/// Something sent, ready for the line, and what must come back.
struct ProbeStep {
  enum class End { open, closed, either };

  Bytes sent = {};
  std::chrono::milliseconds silence_before{20};
  /// Whole ADUs one after another, each with all that it may be; none: nothing comes.
  std::vector<std::vector<BytePattern>> replies = {};
  End end = End::open;             ///< of the line afterwards
  std::uint8_t function_code = 0;  ///< asked for; 0 if that cannot be told
};

/// What a case sends, and what must come back.
struct Exchange {
  std::string note = {};
  std::vector<ProbeStep> steps = {};
  bool survives = true;  ///< a good request is answered afterwards, on the same line if it is open
  ProbeStep good = {};   ///< that request
  std::set<std::string> missing = {};  ///< addresses that the profile does not name
  bool is_for_tcp = true, is_for_serial = true;

  [[nodiscard]] bool is_for(modbus::Line line) const {
    return line == modbus::Line::tcp ? is_for_tcp : is_for_serial;
  }
};

/// What is probed: a server over TCP or a serial line, or its parts in process.
class ProbedLine {
 public:
  virtual ~ProbedLine() = default;
  [[nodiscard]] virtual modbus::Line kind() const = 0;
  /// Begins anew: another connection, or a line on which nothing is under way.
  virtual void renew() = 0;
  virtual void send(std::span<const std::uint8_t> bytes,
                    std::chrono::milliseconds silence_before) = 0;
  /// The next reply, whole; empty if none comes within the time one waits for it.
  virtual Bytes receive() = 0;
  /// The same where none is expected: one waits for less time.
  virtual Bytes receive_more() { return receive(); }
  /// Whether the other side has closed the line, or does so within the time one waits for it.
  virtual bool is_closed() = 0;
};

/// Reads the map `when` of a case, made ready for a line.
/// @throws InputError  for what is not as it should be, a name in braces that nobody knows too.
[[nodiscard]] Exchange read_exchange(const YamlNode& when, modbus::Line line,
                                     const Profile& profile);

/// Does what the exchange says, on a line that is new.
/// @return  what was not as expected; empty if all was.
[[nodiscard]] std::string failure_of(const Exchange& exchange, ProbedLine& line);

/// How a case on the wire went. If it was skipped, the rest says nothing.
struct ExchangeResult {
  bool passed = false;
  std::string failure = {};  ///< what was not as expected
  std::string skipped = {};  ///< why
};

/// Does what the map `when` of a case says, on a new connection of the line. Skipped is what is for
/// another kind of line, names an address that the profile has not, or asks for a function that the
/// device does not serve: it answers a good request for it with exception 01.
/// @throws InputError as read_exchange does, DeviceLost  if nobody is there to connect to.
[[nodiscard]] ExchangeResult run_exchange(const YamlNode& when, ProbedLine& line,
                                          const Profile& profile);

/// Whether the good request of the profile is answered, on a new connection.
/// @throws DeviceLost  if nobody is there to connect to.
[[nodiscard]] bool answers(ProbedLine& line, const Profile& profile);

}  // namespace gonio::conformance
