#pragma once

#include <string>

namespace gonio {

/// Text as one cell of a CSV file: in quotes, its own quotes doubled, if it holds a comma, a quote
/// or a line break; unchanged else. @see RFC 4180
[[nodiscard]] std::string csv_cell(const std::string& text);

}  // namespace gonio
