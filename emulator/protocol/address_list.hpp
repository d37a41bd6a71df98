#pragma once

#include <asio/ip/address.hpp>
#include <asio/ip/network_v4.hpp>
#include <asio/ip/network_v6.hpp>
#include <string>
#include <vector>

namespace gonio {

/// Addresses that may connect: single ones and networks, of IPv4 and IPv6. An empty list allows
/// all.
class AddressList {
 public:
  /// @param texts  e.g. 10.1.2.3, 10.0.0.0/8, fd00::/8.
  /// @throws std::invalid_argument  for anything else.
  explicit AddressList(const std::vector<std::string>& texts);

  [[nodiscard]] bool contains(const asio::ip::address& address) const;

 private:
  std::vector<asio::ip::network_v4> v4_;
  std::vector<asio::ip::network_v6> v6_;
};

}  // namespace gonio
