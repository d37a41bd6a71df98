#include "emulator/store/store_url.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace gonio {
namespace {

/// Takes what stands after the user's colon, and after password= in the query, out of what is
/// shown.
void hide_passwords(StoreUrl& url) {
  std::string& shown = url.shown;
  const auto hide = [&](std::size_t from, std::size_t to) {
    url.passwords.push_back(shown.substr(from, to - from));
    shown.replace(from, to - from, "***");
  };
  const std::size_t authority = shown.find("://") + 3;
  const std::size_t authority_end = std::min(shown.find_first_of("/?#", authority), shown.size());
  for (std::size_t at = authority_end; (at = shown.find("password=", at)) != std::string::npos;) {
    at += std::string_view("password=").size();
    hide(at, std::min(shown.find('&', at), shown.size()));
  }
  // A password may hold an @ that should have been written as %40.
  const std::size_t user_end = shown.substr(0, authority_end).rfind('@');
  const std::size_t colon = shown.find(':', authority);
  if (user_end != std::string::npos && user_end >= authority && colon < user_end) {
    hide(colon + 1, user_end);
  }
}

/// With what a program wants that must not wait for ever for a server that is gone.
std::string with_defaults(std::string url) {
  constexpr std::array<std::array<const char*, 2>, 4> defaults{{{"connect_timeout", "10"},
                                                                {"tcp_user_timeout", "30000"},
                                                                {"application_name", "gonio"},
                                                                {"client_encoding", "UTF8"}}};
  for (const auto& [key, value] : defaults) {
    if (url.find(fmt::format("{}=", key)) == std::string::npos) {
      const bool begins = url.ends_with('?') || url.ends_with('&');
      const char* separator = begins ? "" : url.find('?') == std::string::npos ? "?" : "&";
      url += fmt::format("{}{}={}", separator, key, value);
    }
  }
  return url;
}

StoreUrl sqlite_file(const std::string& url, const std::string& path) {
  // SOCI takes a text with = for a list of keys and values, and reads no way to write a quote in
  // it.
  const bool keys = path.find('=') != std::string::npos;
  if (path.empty() || (keys && path.find('"') != std::string::npos)) {
    throw std::invalid_argument(fmt::format(
        "store {}: expected a path after sqlite:, not empty and not with both = and \"", url));
  }
  return {StoreUrl::Server::sqlite, keys ? fmt::format("db=\"{}\"", path) : path, url};
}

}  // namespace

StoreUrl parse_store_url(const std::string& url) {
  constexpr std::string_view sqlite = "sqlite:";
  if (url.starts_with(sqlite)) {
    return sqlite_file(url, url.substr(sqlite.size()));
  }
  StoreUrl server{StoreUrl::Server::postgresql, with_defaults(url), url};
  if (url.find("://") != std::string::npos) {
    hide_passwords(server);
  }
  if (url.starts_with("postgresql://") || url.starts_with("postgres://")) {
    return server;
  }
  throw std::invalid_argument(fmt::format(
      "store: expected sqlite:PATH or postgresql://[user[:password]@][host][:port]/database[?...], "
      "found '{}'",
      server.shown));
}

}  // namespace gonio
