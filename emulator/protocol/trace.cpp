#include "emulator/protocol/trace.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

std::string describe(std::uint8_t unit, std::span<const std::uint8_t> request,
                     const Response& response) {
  std::string outcome = "nothing";
  if (response.pdu) {
    outcome = fmt::format("{:02X}", fmt::join(response.pdu->bytes(), " "));
  }
  if (response.fault) {
    outcome += fmt::format(", fault {}", name_of(response.fault->fault));
  }
  return fmt::format("unit {}, function {}: {:02X} -> {}", unit, request[0],
                     fmt::join(request, " "), outcome);
}

}  // namespace gonio
