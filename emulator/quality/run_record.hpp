#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/records.hpp"

namespace gonio {

/// What a run of a batch rests on, with hashes of all files.
/// @param readings  the file of measured readings; nothing: the run is simulated.
/// @param panels    of the inspection.
/// @param version   of gonio.
/// @throws InputError  for a file that cannot be read.
[[nodiscard]] RunRecord run_record(const Batch& batch,
                                   const std::optional<std::filesystem::path>& readings,
                                   std::uint64_t panels, const std::string& version);

}  // namespace gonio
