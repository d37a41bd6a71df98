#pragma once

#include <filesystem>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/records.hpp"

namespace gonio {

/// Readings of a file, lot by lot and panel by panel, both in the order in which they first come;
/// not judged. Where the batch file does not say how to read it, its columns are called as the
/// roles and channels are. The file is a table in UTF-8, or UTF-16 with a byte order mark, as
/// instruments and spreadsheets export it.
/// @throws InputError  with line and column for anything that is not as the batch file says: a
///                     missing column, a number that is none, an instrument or operator that the
///                     batch has not, a reading that is there twice, a panel without a reading of
///                     a channel.
[[nodiscard]] std::vector<PanelRecord> load_measured_readings(const std::filesystem::path& file,
                                                              const Batch& batch);

}  // namespace gonio
