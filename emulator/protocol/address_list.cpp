#include "emulator/protocol/address_list.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace gonio {

namespace {

template <class Network, class Address>
bool holds(const Network& network, const Address& address) {
  return Network(address, network.prefix_length()).canonical() == network.canonical();
}

}  // namespace

AddressList::AddressList(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const bool is_v6 = text.find(':') != std::string::npos;
    const bool is_network = text.find('/') != std::string::npos;
    asio::error_code error;
    if (is_v6) {
      v6_.push_back(asio::ip::make_network_v6(is_network ? text : text + "/128", error));
    } else {
      v4_.push_back(asio::ip::make_network_v4(is_network ? text : text + "/32", error));
    }
    if (error) {
      throw std::invalid_argument(fmt::format(
          "--allow: expected an address or a network such as 10.0.0.0/8, found '{}'", text));
    }
  }
}

bool AddressList::contains(const asio::ip::address& address) const {
  if (v4_.empty() && v6_.empty()) {
    return true;
  }
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    return contains(asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()));
  }
  if (address.is_v4()) {
    for (const auto& network : v4_) {
      if (holds(network, address.to_v4())) {
        return true;
      }
    }
    return false;
  }
  for (const auto& network : v6_) {
    if (holds(network, address.to_v6())) {
      return true;
    }
  }
  return false;
}

}  // namespace gonio
