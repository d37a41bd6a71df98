#pragma once

#include <soci/soci.h>

#include "emulator/quality/records.hpp"

// Runs and what they came to, as rows. All of it belongs in a transaction of the caller.

namespace gonio {

/// @return  the id of the new run.
std::int64_t insert_run(soci::session& session, const RunRecord& run);
void insert_outcome(soci::session& session, std::int64_t run, const RunOutcome& outcome);

/// @throws std::out_of_range  if there is no such run.
[[nodiscard]] StoredRun select_run(soci::session& session, std::int64_t id);
[[nodiscard]] bool is_finished(soci::session& session, std::int64_t run);

}  // namespace gonio
