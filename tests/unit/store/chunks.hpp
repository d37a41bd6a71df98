#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/store/database.hpp"
#include "emulator/store/store.hpp"
#include "tests/unit/store/random_records.hpp"
#include "tests/unit/store/same_records.hpp"

// A run that is added to in chunks, whose panels everybody can tell.

namespace gonio::test {

constexpr std::uint64_t panels_in_chunk = 20;

/// @param i  from 0.
inline std::vector<PanelRecord> chunk(std::uint64_t i) {
  return RandomRecords(std::uint32_t(8000 + i))
      .panels(PanelRecord::Study::inspection, i * panels_in_chunk + 1, panels_in_chunk);
}

inline std::vector<PanelRecord> chunks(std::uint64_t n) {
  std::vector<PanelRecord> all;
  for (std::uint64_t i = 0; i < n; ++i) {
    const std::vector<PanelRecord> next = chunk(i);
    all.insert(all.end(), next.begin(), next.end());
  }
  return all;
}

/// The run of the store that is not finished, begun if there is none.
inline std::int64_t run_of(Store& store) {
  const auto run = store.unfinished("chunks");
  return run ? run->record.id : store.begin(RandomRecords(1).run("killed", "chunks"));
}

/// How many chunks are there: whole ones, with all their rows and no others.
inline std::uint64_t whole_chunks(const std::string& url, std::int64_t run) {
  const std::uint64_t panels = Store(url).panels(run, PanelRecord::Study::inspection);
  EXPECT_EQ(panels % panels_in_chunk, 0U);
  Database database(url);
  const auto rows = [&](const std::string& table) {
    long long n = 0;
    database.session() << "SELECT count(*) FROM " + table, soci::into(n);
    return static_cast<std::uint64_t>(n);
  };
  EXPECT_EQ(rows("panel"), panels);
  EXPECT_EQ(rows("panel_channel"), 3 * panels);
  EXPECT_EQ(rows("reading"), 12 * panels);
  return panels / panels_in_chunk;
}

}  // namespace gonio::test
