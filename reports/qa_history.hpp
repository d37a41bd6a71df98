#pragma once

#include <string>
#include <vector>

#include "emulator/quality/records.hpp"

// What a store tells over its runs: the runs, the oldest first, and how each channel went from run
// to run. A run that is not finished is shown as one that can be resumed.

namespace gonio {

/// For a terminal. @param store  its url, without a password.
[[nodiscard]] std::string history_text(const std::vector<StoredRun>& runs, const std::string& store,
                                       bool styled);
/// Schema gonio/qa_history/1, numbers at full precision.
[[nodiscard]] std::string history_json(const std::vector<StoredRun>& runs,
                                       const std::string& store);
/// One row for each run and channel; one for a run that has no channel yet.
[[nodiscard]] std::string history_csv(const std::vector<StoredRun>& runs);
/// A page of its own that prints on A4; charts inside, no network and no script needed.
/// @param version  of the gonio that writes it.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string history_page(const std::vector<StoredRun>& runs, const std::string& store,
                                       const std::string& version);

}  // namespace gonio
