#pragma once

#include <string>

namespace gonio {

/// Where a device is: modbus://HOST[:PORT][/UNIT] (port 502, unit 1 if not given; IPv6 in brackets)
/// or modbus-rtu:PATH[?baud=19200&parity=even&unit=1].
struct DeviceUrl {
  bool is_rtu = false;
  std::string host, path;
  int port = 502;
  int baud = 19200;
  char parity = 'E';  ///< N, E or O
  int unit = 1;       ///< 0 to 247 or 255 over TCP, 1 to 247 on a serial line

  /// @throws std::invalid_argument  saying what was expected and what was found.
  [[nodiscard]] static DeviceUrl parse(const std::string& text);
  [[nodiscard]] std::string text() const;
};

}  // namespace gonio
