#include "emulator/quality/run_record.hpp"

#include <fmt/format.h>

#include "emulator/core/file_hash.hpp"
#include "emulator/core/sha256.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/core/today.hpp"

namespace gonio {

namespace {

/// The nominal instrument of a standard has no file: the standard's stands for it.
HashedFile hashed(const Instrument& instrument) {
  return {
      .name = instrument.id,
      .sha256 = hash_of_file(instrument.file.empty() ? instrument.standard.file : instrument.file)};
}

/// Measured readings are no YAML: nothing in them names a file.
HashedFile hashed_text(const std::filesystem::path& file) {
  return {.name = file.filename().string(), .sha256 = sha256(read_text_file(file))};
}

/// Of all that changes a result.
std::string fingerprint_of(const RunRecord& run, const Batch& batch) {
  std::string all =
      fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", run_kind_name(run.kind), run.gonio_version, run.seed,
                  run.batch_text, run.sample.sha256, run.readings.sha256);
  all += hash_of_file(batch.standard.file) + "\n";
  for (const HashedFile& instrument : run.instruments) {
    all += instrument.sha256 + "\n";
  }
  return sha256(all);
}

}  // namespace

RunRecord run_record(const Batch& batch, const std::optional<std::filesystem::path>& readings,
                     std::uint64_t panels, const std::string& version) {
  RunRecord run{.kind = readings ? RunRecord::Kind::measured : RunRecord::Kind::simulated,
                .batch = batch.id,
                .title = batch.title,
                .batch_file = batch.file.string(),
                .batch_text = read_text_file(batch.file),
                .seed = batch.seed,
                .gonio_version = version,
                .standard = batch.standard.id,
                .channels = batch.channels,
                .lots = batch.plan.lots,
                .panels = panels,
                .started = utc_now()};
  if (batch.product) {
    run.sample = {.name = batch.product->sample.stem().string(),
                  .sha256 = hash_of_file(batch.product->sample)};
  }
  if (readings) {
    run.readings = hashed_text(*readings);
  } else if (batch.gauge) {
    run.gauge_panels = batch.gauge->panels;
  }
  for (const Instrument& instrument : batch.instruments) {
    run.instruments.push_back(hashed(instrument));
  }
  for (const OperatorStatement& person : batch.operators) {
    run.operators.push_back(person.id);
  }
  run.fingerprint = fingerprint_of(run, batch);
  return run;
}

}  // namespace gonio
