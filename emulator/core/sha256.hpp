#pragma once

#include <string>
#include <string_view>

namespace gonio {

/// SHA-256 of bytes, in 64 hexadecimal digits of lower case. @see FIPS 180-4
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace gonio
