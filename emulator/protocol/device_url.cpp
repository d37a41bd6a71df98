#include "emulator/protocol/device_url.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace gonio {

namespace {

constexpr std::string_view tcp_scheme = "modbus://", rtu_scheme = "modbus-rtu:";
constexpr std::array<unsigned, 10> bauds = {1200,  2400,  4800,   9600,   19200,
                                            38400, 57600, 115200, 230400, 460800};
constexpr unsigned highest_port = 65535, highest_unit = 247, any_unit = 255;

[[noreturn]] void fail(const std::string& url, std::string_view expected, std::string_view found) {
  throw std::invalid_argument(fmt::format("{}: expected {}, found '{}'", url, expected, found));
}

/// The number that `text` is, without a sign. @return  nothing if it is none.
std::optional<unsigned> number(std::string_view text) {
  unsigned value = 0;
  const char* const text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, value);
  return error == std::errc() && end == text_end ? std::optional(value) : std::nullopt;
}

/// The parts of a text before and behind the first separator.
std::pair<std::string_view, std::string_view> cut(std::string_view text, char separator) {
  const auto at = std::min(text.find(separator), text.size());
  return {text.substr(0, at), text.substr(std::min(at + 1, text.size()))};
}

/// Takes the host of HOST[:PORT]. @return  what stands behind it.
std::string_view take_host(std::string_view authority, DeviceUrl& url, const std::string& text) {
  constexpr std::string_view of_name =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._";
  constexpr std::string_view of_ipv6 = "0123456789abcdefABCDEF:.";
  const bool is_ipv6 = authority.starts_with('[');
  const auto end = is_ipv6 ? authority.find(']') : std::min(authority.find(':'), authority.size());
  const auto host = end == std::string_view::npos ? "" : authority.substr(is_ipv6, end - is_ipv6);
  // Behind '%' stands the name of a network interface.
  const auto address = host.substr(0, is_ipv6 ? host.find('%') : host.size());
  if (address.empty() ||
      address.find_first_not_of(is_ipv6 ? of_ipv6 : of_name) != std::string_view::npos) {
    fail(text, "a host name, an IPv4 address, or an IPv6 address in brackets", authority);
  }
  url.host = host;
  return authority.substr(is_ipv6 ? end + 1 : end);
}

DeviceUrl parse_tcp(std::string_view rest, const std::string& text) {
  DeviceUrl url;
  const auto [authority, path] = cut(rest, '/');
  if (const auto port = take_host(authority, url, text); !port.empty()) {
    const auto value = port.starts_with(':') ? number(port.substr(1)) : std::nullopt;
    if (!value || *value == 0 || *value > highest_port) {
      fail(text, "a port in [1, 65535]", port.substr(port.starts_with(':')));
    }
    url.port = static_cast<int>(*value);
  }
  if (rest.find('/') != std::string_view::npos) {
    const auto unit = number(path);
    if (!unit || (*unit > highest_unit && *unit != any_unit)) {
      fail(text, "a unit in [0, 247], or 255", path);
    }
    url.unit = static_cast<int>(*unit);
  }
  return url;
}

void set_line(DeviceUrl& url, std::string_view setting, const std::string& text) {
  const auto [key, value] = cut(setting, '=');
  if (key == "baud") {
    const auto baud = number(value);
    if (!baud || std::find(bauds.begin(), bauds.end(), *baud) == bauds.end()) {
      fail(text, fmt::format("a baud rate of {}", fmt::join(bauds, ", ")), value);
    }
    url.baud = static_cast<int>(*baud);
  } else if (key == "parity") {
    if (value != "none" && value != "even" && value != "odd") {
      fail(text, "a parity of none, even, odd", value);
    }
    url.parity = value == "none" ? 'N' : value == "even" ? 'E' : 'O';
  } else if (key == "unit") {
    const auto unit = number(value);
    if (!unit || *unit < 1 || *unit > highest_unit) {
      fail(text, "a unit in [1, 247]", value);
    }
    url.unit = static_cast<int>(*unit);
  } else {
    fail(text, "baud=, parity= or unit=", setting);
  }
}

DeviceUrl parse_rtu(std::string_view rest, const std::string& text) {
  DeviceUrl url;
  auto [path, settings] = cut(rest, '?');
  if (path.empty()) {
    fail(text, "the path of a serial device", path);
  }
  url.is_rtu = true;
  url.path = path;
  while (!settings.empty()) {
    const auto [setting, others] = cut(settings, '&');
    set_line(url, setting, text);
    settings = others;
  }
  return url;
}

}  // namespace

DeviceUrl DeviceUrl::parse(const std::string& text) {
  const std::string_view view = text;
  if (view.starts_with(tcp_scheme)) {
    return parse_tcp(view.substr(tcp_scheme.size()), text);
  }
  if (view.starts_with(rtu_scheme)) {
    return parse_rtu(view.substr(rtu_scheme.size()), text);
  }
  throw std::invalid_argument(
      fmt::format("expected a device as modbus://HOST[:PORT][/UNIT] or "
                  "modbus-rtu:PATH[?baud=19200&parity=even&unit=1], found '{}'",
                  text));
}

std::string DeviceUrl::text() const {
  if (is_rtu) {
    return fmt::format("{}{}?baud={}&parity={}&unit={}", rtu_scheme, path, baud,
                       parity == 'N'   ? "none"
                       : parity == 'E' ? "even"
                                       : "odd",
                       unit);
  }
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return fmt::format("{}{}{}{}:{}/{}", tcp_scheme, is_ipv6 ? "[" : "", host, is_ipv6 ? "]" : "",
                     port, unit);
}

}  // namespace gonio
