#include <fmt/format.h>
#include <unistd.h>

#include <iostream>

#include "emulator/app/bars.hpp"
#include "emulator/app/qa_options.hpp"
#include "emulator/app/qa_workplace.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/quality/panel_pipeline.hpp"
#include "emulator/quality/product_panels.hpp"
#include "emulator/store/store_url.hpp"
#include "reports/qa_history.hpp"
#include "reports/qa_readings.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

/// A store that is there: whoever asks for what is in it does not want a new one.
Store existing_store(const std::string& url) {
  const StoreUrl place = parse_store_url(url);
  if (place.server == StoreUrl::Server::sqlite && !fs::exists(place.connection)) {
    throw std::invalid_argument(
        fmt::format("--store: expected a store, found nothing at {}", place.connection));
  }
  return Store(url);
}

StoredRun stored_run(const Store& store, std::int64_t id) {
  try {
    return store.run(id);
  } catch (const std::out_of_range&) {
    throw std::invalid_argument(
        fmt::format("run: expected the number of a run in {}, see `gonio qa history`, found '{}'",
                    store.url(), id));
  }
}

void for_each_panel(const Store& store, const RunRecord& run,
                    const std::function<void(const PanelRecord&)>& take) {
  for (const auto study : {PanelRecord::Study::gauge, PanelRecord::Study::inspection}) {
    store.for_each_panel(run.id, study, take);
  }
}

void write_json(std::ostream& out, const Store& store, const RunRecord& run) {
  QaReadingsJson writer(out, run);
  for_each_panel(store, run, [&](const PanelRecord& panel) { writer.add(panel); });
  writer.finish();
}

void write_csv(std::ostream& out, const Store& store, const RunRecord& run) {
  QaReadingsCsv writer(out, run);
  for_each_panel(store, run, [&](const PanelRecord& panel) { writer.add(panel); });
}

/// @throws std::system_error  if it cannot be written.
void print_stream(const std::function<void(std::ostream&)>& write) {
  write(std::cout);
  if (!std::cout.flush()) {
    throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
  }
}

}  // namespace

void write_readings(const fs::path& file, const Store& store, const RunRecord& run) {
  write_file(file, [&](std::ostream& out) { write_csv(out, store, run); });
}

void print_readings(const Store& store, const RunRecord& run) {
  print_stream([&](std::ostream& out) { write_csv(out, store, run); });
}

ExitStatus run_qa_history(const QaOptions& options) {
  const Store store = existing_store(options.store);
  const std::vector<StoredRun> runs = store.runs(options.of_batch);
  if (options.of_batch && runs.empty()) {
    throw std::invalid_argument(fmt::format("--batch: expected a batch with runs in {}, found '{}'",
                                            store.url(), *options.of_batch));
  }
  if (options.report) {
    const std::string page = history_page(runs, store.url(), GONIO_VERSION);
    fs::create_directories(*options.report);
    write_text_file(fs::path(*options.report) / "history.html", page);
    write_text_file(fs::path(*options.report) / "history.json", history_json(runs, store.url()));
  }
  if (options.format == "json") {
    print(history_json(runs, store.url()));
  } else if (options.format == "csv") {
    print(history_csv(runs));
  } else {
    print(history_text(runs, store.url(), isatty(STDOUT_FILENO) != 0));
  }
  return done;
}

ExitStatus run_qa_export(const QaOptions& options) {
  const Store store = existing_store(options.store);
  const RunRecord run = stored_run(store, options.run).record;
  const auto write = [&](std::ostream& out) {
    options.format == "json" ? write_json(out, store, run) : write_csv(out, store, run);
  };
  if (options.output) {
    write_file(*options.output, write);
  } else {
    print_stream(write);
  }
  return done;
}

ExitStatus run_qa_verify(const QaOptions& options, const CommonOptions& common) {
  const Store store = existing_store(options.store);
  const RunRecord run = stored_run(store, options.run).record;
  if (run.kind != RunRecord::Kind::simulated) {
    throw std::invalid_argument(
        fmt::format("run: expected a simulated one, found {}, which was measured", run.id));
  }
  const Catalog catalog = common.catalog();
  const Workplace place = simulated_workplace(run.batch_file, run.seed, catalog);
  if (run_record(place, GONIO_VERSION).fingerprint != run.fingerprint) {
    throw std::invalid_argument(
        fmt::format("run {}: expected gonio {}, {} and all files as they were then, found others",
                    run.id, run.gonio_version, run.batch_file));
  }
  Bars bars;
  const ProductOptics optics = product_optics(place, bars);
  const ProductPanels panels(place.batch, optics, place.uncertainties);
  std::uint64_t compared = 0, differing = 0;
  for_each_panel(store, run, [&](const PanelRecord& stored) {
    const PanelRecord again = stored.study == PanelRecord::Study::gauge
                                  ? panels.gauge(stored.number)
                                  : panels.inspect(stored.number);
    ++compared;
    differing += again == stored ? 0 : 1;
    bars.show("panels", compared, run.gauge_panels + run.panels);
  });
  print(fmt::format("run {}: {} of {} panels are the same to the last bit\n", run.id,
                    compared - differing, compared));
  return differing == 0 ? done : does_not_conform;
}

}  // namespace gonio::app
