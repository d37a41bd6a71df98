#pragma once

#include <string>

#include "emulator/quality/qa_result.hpp"

namespace gonio {

/// For a terminal: verdict, what was judged, channels, control charts in words, gauge R&R, risks,
/// what was asked, and where it is stored. Rounded.
[[nodiscard]] std::string qa_text(const QaResult& result, bool styled);
/// Schema gonio/qa/1: everything, numbers at full precision; null where there is nothing.
[[nodiscard]] std::string qa_json(const QaResult& result);
/// A page of its own that prints on A4; charts inside, no network and no script needed.
/// @param version  of the gonio that writes it.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string qa_page(const QaResult& result, const std::string& version);

}  // namespace gonio
