#pragma once

#include <string>

namespace gonio {

/// The day it is, YYYY-MM-DD, or that of $SOURCE_DATE_EPOCH for a report that can be made again.
[[nodiscard]] std::string today();
/// The time it is, YYYY-MM-DDThh:mm:ssZ, or that of $SOURCE_DATE_EPOCH.
[[nodiscard]] std::string utc_now();

}  // namespace gonio
