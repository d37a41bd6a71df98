#include "emulator/app/device_session.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace gonio::app {

ModbusClient DeviceOptions::connect() const {
  const auto answer_time = parse_duration("--timeout", timeout, Range::closed(0.001, 600.0));
  return {DeviceUrl::parse(url), answer_time};
}

void add_device_options(CLI::App& command, DeviceOptions& options) {
  command
      .add_option("url", options.url,
                  "modbus://HOST[:PORT][/UNIT] or modbus-rtu:PATH[?baud=19200&parity=even&unit=1]")
      ->required();
  command.add_option("--timeout", options.timeout, "Longest wait for an answer")
      ->capture_default_str();
}

std::chrono::milliseconds parse_duration(const std::string& option, const std::string& text,
                                         const Range& range_s) {
  auto seconds = parse_quantity(text, Dimension::time);
  if (!seconds) {
    seconds = parse_quantity(text, Dimension::number);
  }
  if (!seconds || !range_s.contains(*seconds)) {
    throw std::invalid_argument(fmt::format("{}: expected {}{}, found '{}'", option,
                                            expected_quantity(Dimension::time), range_s.text(),
                                            text));
  }
  return std::chrono::milliseconds(std::llround(*seconds * 1e3));
}

}  // namespace gonio::app
