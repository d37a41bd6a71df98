#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/quality/records.hpp"

namespace gonio {

/// The store cannot go on: no room, no server, no rights. What was committed before is safe.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs, panels and readings in a database.
///
/// Whatever is added is there whole or not at all, and stays whatever happens to the program after
/// the call has returned. For one thread at a time.
class Store {
 public:
  /// Opens a store and brings its schema to the version of this program; makes it if it is not
  /// there.
  /// @param url  sqlite:PATH, or postgresql://[user[:password]@][host][:port]/database[?key=value],
  ///             as libpq has it.
  /// @throws std::invalid_argument  for another url.
  /// @throws StoreError  if it cannot be opened, is not a store of gonio, or is newer than this
  ///                     program.
  explicit Store(const std::string& url);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  /// As it is shown: without a password.
  [[nodiscard]] const std::string& url() const;

  /// @return  the id of the new run; `record.id` is not used.
  /// @throws std::invalid_argument  for a text with a zero byte.
  std::int64_t begin(const RunRecord& record);
  /// Adds panels of a run in one transaction. Of a panel, no two readings have all places in
  /// common: channel, position, repetition, instrument and operator; no two results have one
  /// channel.
  /// @throws StoreError  also if one of them is there already, or the run is finished.
  /// @throws std::invalid_argument  for a NaN, or a text with a zero byte.
  void add(std::int64_t run, std::span<const PanelRecord> panels);
  /// @throws StoreError  also for a run that is finished.
  /// @throws std::invalid_argument  for a NaN, or a text with a zero byte.
  void finish(std::int64_t run, const RunOutcome& outcome);

  /// @throws std::out_of_range  if there is no such run.
  [[nodiscard]] StoredRun run(std::int64_t id) const;
  /// The latest run of that fingerprint that is not finished.
  [[nodiscard]] std::optional<StoredRun> unfinished(const std::string& fingerprint) const;
  /// All runs, the oldest first, or those of a batch.
  [[nodiscard]] std::vector<StoredRun> runs(const std::optional<std::string>& batch = {}) const;

  [[nodiscard]] std::uint64_t panels(std::int64_t run, PanelRecord::Study study) const;
  /// Calls `read` for each panel of a study in the order of their numbers, as it was added, to the
  /// last bit; in memory that does not grow with them.
  void for_each_panel(std::int64_t run, PanelRecord::Study study,
                      const std::function<void(const PanelRecord&)>& read) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gonio
