#include <benchmark/benchmark.h>
#include <sqlite3.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/store/store.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::bench {
namespace {

constexpr std::uint64_t panels_in_chunk = 500;
constexpr std::uint32_t channels = 3;
constexpr std::uint32_t positions = 6;

/// A chunk of panels as a run of three geometries and six readings leaves them.
std::vector<PanelRecord> first_chunk() {
  std::vector<PanelRecord> panels(panels_in_chunk);
  for (std::uint64_t i = 0; i < panels_in_chunk; ++i) {
    PanelRecord& panel = panels[i];
    panel.number = 1 + i;
    for (std::uint32_t channel = 0; channel < channels; ++channel) {
      for (std::uint32_t position = 1; position <= positions; ++position) {
        panel.readings.push_back({.channel = channel,
                                  .position = position,
                                  .value = 85.0 + 1e-9 * double(i * position)});
      }
      panel.channels.push_back({.channel = channel, .n = positions, .mean = 85.1, .truth = 85.2});
    }
  }
  return panels;
}

void renumber(std::vector<PanelRecord>& panels) {
  for (PanelRecord& panel : panels) {
    panel.number += panels_in_chunk;
  }
}

/// A prepared statement of the C interface, executed row by row.
class Insertion {
 public:
  Insertion(sqlite3* database, const std::string& sql) {
    if (sqlite3_prepare_v2(database, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) {
      throw std::runtime_error(sqlite3_errmsg(database));
    }
  }
  ~Insertion() { sqlite3_finalize(statement_); }
  Insertion(const Insertion&) = delete;
  Insertion& operator=(const Insertion&) = delete;

  template <class... Cells>
  void add(const Cells&... cells) {
    int at = 0;
    (bind(++at, cells), ...);
    if (sqlite3_step(statement_) != SQLITE_DONE) {
      throw std::runtime_error("no row was added");
    }
    sqlite3_reset(statement_);
  }

 private:
  void bind(int at, double number) { sqlite3_bind_double(statement_, at, number); }
  void bind(int at, std::uint64_t number) {
    sqlite3_bind_int64(statement_, at, std::int64_t(number));
  }
  void bind(int at, const char* text) {
    sqlite3_bind_text(statement_, at, text, -1, SQLITE_STATIC);
  }

  sqlite3_stmt* statement_ = nullptr;
};

/// What Store::add does, written down with the C interface.
class PlainStore {
 public:
  explicit PlainStore(const std::string& path) {
    if (sqlite3_open(path.c_str(), &database_) != SQLITE_OK) {
      throw std::runtime_error("no database");
    }
    execute("PRAGMA synchronous = FULL");
    execute("PRAGMA foreign_keys = ON");
  }
  ~PlainStore() { sqlite3_close_v2(database_); }
  PlainStore(const PlainStore&) = delete;
  PlainStore& operator=(const PlainStore&) = delete;

  void add(std::uint64_t run, const std::vector<PanelRecord>& panels) {
    Insertion panel_rows(database_, "INSERT INTO panel VALUES (?, ?, ?, ?, ?, ?)");
    Insertion channel_rows(database_,
                           "INSERT INTO panel_channel VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    Insertion reading_rows(database_, "INSERT INTO reading VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    execute("BEGIN IMMEDIATE");
    for (const PanelRecord& panel : panels) {
      const char* study = study_name(panel.study);
      panel_rows.add(run, study, panel.number, panel.lot, panel.label.c_str(),
                     verdict_name(panel.verdict));
      for (const ChannelResult& channel : panel.channels) {
        channel_rows.add(run, study, panel.number, std::uint64_t(channel.channel),
                         std::uint64_t(channel.n), channel.mean, channel.range,
                         channel.standard_deviation, panel_verdict_name(channel.uniformity),
                         verdict_name(channel.verdict), *channel.truth);
      }
      std::uint64_t place = 0;
      for (const ReadingRecord& reading : panel.readings) {
        reading_rows.add(run, study, panel.number, std::uint64_t(reading.channel),
                         std::uint64_t(reading.position), std::uint64_t(reading.repetition),
                         std::uint64_t(reading.instrument), std::uint64_t(reading.operator_),
                         place++, reading.value);
      }
    }
    execute("COMMIT");
  }

 private:
  void execute(const char* sql) {
    if (sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
      throw std::runtime_error(sqlite3_errmsg(database_));
    }
  }

  sqlite3* database_ = nullptr;
};

std::vector<PanelRecord> panels_of(const Store& store, std::int64_t run) {
  std::vector<PanelRecord> panels;
  store.for_each_panel(run, PanelRecord::Study::inspection,
                       [&](const PanelRecord& panel) { panels.push_back(panel); });
  return panels;
}

/// Both add the same panels to a run of theirs, each in a file of its own.
void AddPanels(benchmark::State& state) {
  const test::TemporaryFolder folder;
  const std::string plain_path = (folder.path() / "plain.db").string();
  Store plain_store("sqlite:" + plain_path);
  const std::int64_t plain_run = plain_store.begin({});
  PlainStore plain(plain_path);
  Store store("sqlite:" + (folder.path() / "store.db").string());
  const std::int64_t run = store.begin({});
  std::vector<PanelRecord> plain_chunk = first_chunk();
  std::vector<PanelRecord> chunk = first_chunk();
  compare(
      state, cost_at_most(1.0),
      [&] {
        plain.add(std::uint64_t(plain_run), plain_chunk);
        renumber(plain_chunk);
      },
      [&] {
        store.add(run, chunk);
        renumber(chunk);
      });
  state.counters["readings_per_s"] =
      double(panels_in_chunk) * channels * positions / state.counters["subject_s"];
  if (panels_of(store, run) != panels_of(plain_store, plain_run)) {
    state.SkipWithError("the stores differ");
  }
}
BENCHMARK(AddPanels)->Iterations(40);

}  // namespace
}  // namespace gonio::bench
