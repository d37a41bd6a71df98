#pragma once

#include <string>

#include "emulator/protocol/register_map.hpp"

namespace gonio {

/// The map as a page for people, in Markdown.
[[nodiscard]] std::string register_page(const RegisterMap& map);

/// The map as a table, one line per point, after a line of column names. @see RFC 4180
[[nodiscard]] std::string register_csv(const RegisterMap& map);

/// "0 = warm_up, 1 = idle", or "bit 0 = ready, bit 1 = busy"; empty without symbols.
[[nodiscard]] std::string symbol_list(const Point& point);

}  // namespace gonio
