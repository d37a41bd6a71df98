#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "emulator/app/command.hpp"
#include "emulator/quality/records.hpp"
#include "emulator/store/store.hpp"

namespace gonio::app {

/// What `gonio qa` was asked for.
struct QaOptions {
  std::optional<std::string> batch;
  std::string store = "sqlite:qa.db";
  std::optional<std::string> readings;
  bool resume = false;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> risk_lots;  ///< 0: no risks
  std::string format = "text";
  std::optional<std::string> report;
  /// Of `history`, `export` and `verify`.
  std::optional<std::string> of_batch;
  std::int64_t run = 0;
  std::optional<std::string> output;
};

/// Simulates or judges a batch, keeps and reports it.
ExitStatus run_qa(const QaOptions& options, const CommonOptions& common);
/// Trends over the runs of a store.
ExitStatus run_qa_history(const QaOptions& options);
/// All readings of a run.
ExitStatus run_qa_export(const QaOptions& options);
/// Computes a simulated run again and compares it with what is stored, to the last bit.
ExitStatus run_qa_verify(const QaOptions& options, const CommonOptions& common);

/// The readings of a run as CSV, in a file whole or not at all, or on standard output.
void write_readings(const std::filesystem::path& file, const Store& store, const RunRecord& run);
void print_readings(const Store& store, const RunRecord& run);

}  // namespace gonio::app
