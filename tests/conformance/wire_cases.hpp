#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/conformance/exchange.hpp"

namespace gonio::conformance {

/// A case of standards/modbus, made ready for a line.
struct WireCase {
  std::string id, clause;
  Exchange exchange;
};
void PrintTo(const WireCase& wire_case, std::ostream* out);

/// All cases that can be tried on a line with a profile: not those that name an address which it
/// has not.
/// @param root  the folder above standards/.
[[nodiscard]] std::vector<WireCase> wire_cases(const std::filesystem::path& root, modbus::Line line,
                                               const Profile& profile);

/// standards/modbus/v1_1b3/profiles/<name>.yaml.
[[nodiscard]] Profile shipped_profile(const std::filesystem::path& root, const std::string& name);

}  // namespace gonio::conformance
