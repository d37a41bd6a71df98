#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emulator/protocol/dispatcher.hpp"

namespace gonio {

/// A request and what became of it in one line, e.g.
/// "unit 1, function 3: 03 00 00 00 0A -> 03 14 ...".
[[nodiscard]] std::string describe(std::uint8_t unit, std::span<const std::uint8_t> request,
                                   const Response& response);

}  // namespace gonio
