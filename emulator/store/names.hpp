#pragma once

#include <string>

#include "emulator/quality/records.hpp"

// Values of an enum as a store keeps them, and back.

namespace gonio {

/// As a store calls it: gloss, colour_difference, haze.
[[nodiscard]] const char* channel_kind_name(BatchChannel::Kind kind);

/// @throws StoreError  with the name, if no value is called so; without the url of the store.
[[nodiscard]] RunRecord::Kind run_kind_of(const std::string& name);
[[nodiscard]] BatchChannel::Kind channel_kind_of(const std::string& name);
[[nodiscard]] ConformanceVerdict verdict_of(const std::string& name);
[[nodiscard]] PanelVerdict panel_verdict_of(const std::string& name);

}  // namespace gonio
