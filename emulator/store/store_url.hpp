#pragma once

#include <string>
#include <vector>

namespace gonio {

/// Where a store is.
struct StoreUrl {
  enum class Server { sqlite, postgresql };
  Server server = Server::sqlite;
  std::string connection = {};              ///< path of the file, or what libpq connects by
  std::string shown = {};                   ///< the url without its passwords
  std::vector<std::string> passwords = {};  ///< as they stand in it
};

/// @param url  as for Store.
/// @throws std::invalid_argument  if it is not one, without its passwords.
[[nodiscard]] StoreUrl parse_store_url(const std::string& url);

}  // namespace gonio
