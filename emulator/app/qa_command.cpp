#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "emulator/app/bars.hpp"
#include "emulator/app/command.hpp"
#include "emulator/app/qa_options.hpp"
#include "emulator/app/qa_workplace.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/core/today.hpp"
#include "emulator/quality/batch_studies.hpp"
#include "emulator/quality/batch_summary.hpp"
#include "emulator/quality/panel_pipeline.hpp"
#include "emulator/quality/product_panels.hpp"
#include "emulator/store/store.hpp"
#include "reports/qa_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

Workplace workplace(const QaOptions& options, const Catalog& catalog) {
  return options.readings ? measured_workplace(options.batch.value(), *options.readings, catalog)
                          : simulated_workplace(options.batch.value(), options.seed, catalog);
}

/// The run in the store: a new one, or the one that was stopped.
StoredRun open_run(const QaOptions& options, const RunRecord& record, Store& store) {
  const auto stopped = store.unfinished(record.fingerprint);
  if (options.resume) {
    if (!stopped) {
      throw std::invalid_argument(
          fmt::format("--resume: expected a stopped run of {} with this seed and these files in "
                      "{}, found none",
                      record.batch, store.url()));
    }
    return *stopped;
  }
  if (stopped) {
    fmt::print(stderr, "gonio: run {} of this batch was stopped; --resume would go on with it\n",
               stopped->record.id);
  }
  return store.run(store.begin(record));
}

/// Takes panels that are new: judged, kept, shown.
class Desk {
 public:
  Desk(const Workplace& place, Store& store, std::int64_t run, Bars& bars)
      : judge_(place.batch, place.uncertainties),
        summary_(place.batch, judge_),
        store_(store),
        run_(run),
        bars_(bars) {}

  /// What the store has of a study already. @return  panels.
  std::uint64_t take_stored(PanelRecord::Study study) {
    std::uint64_t n = 0;
    store_.for_each_panel(run_, study, [&](const PanelRecord& panel) {
      summary_.add(panel);
      ++n;
    });
    return n;
  }

  void take(std::span<const PanelRecord> panels, std::uint64_t total) {
    store_.add(run_, panels);
    for (const PanelRecord& panel : panels) {
      summary_.add(panel);
    }
    bars_.show("panels", panels.back().number, total);
  }

  [[nodiscard]] const PanelJudge& judge() const { return judge_; }
  [[nodiscard]] QaResult result() const { return summary_.result(); }

 private:
  PanelJudge judge_;
  BatchSummary summary_;
  Store& store_;
  std::int64_t run_;
  Bars& bars_;
};

/// @return  the largest error of the polynomials that stand for the optics.
double simulate(const Workplace& place, const RunRecord& record, Desk& desk, Bars& bars) {
  const ProductOptics optics = product_optics(place, bars);
  const ProductPanels panels(place.batch, optics, place.uncertainties);
  const auto work = [&](PanelRecord::Study study, std::uint64_t total, const auto& compute) {
    compute_panels(desk.take_stored(study) + 1, total, compute,
                   [&](std::span<const PanelRecord> chunk) { desk.take(chunk, total); });
  };
  work(PanelRecord::Study::gauge, record.gauge_panels,
       [&](std::uint64_t number) { return panels.gauge(number); });
  work(PanelRecord::Study::inspection, record.panels,
       [&](std::uint64_t number) { return panels.inspect(number); });
  return optics.error();
}

void judge_measured(const Workplace& place, const RunRecord& record, Desk& desk) {
  compute_panels(
      desk.take_stored(PanelRecord::Study::inspection) + 1, record.panels,
      [&](std::uint64_t number) {
        PanelRecord panel = place.measured.at(number - 1);
        desk.judge().judge(panel);
        return panel;
      },
      [&](std::span<const PanelRecord> chunk) { desk.take(chunk, record.panels); });
}

/// Panels that tell risks cost as much as panels that are kept.
RiskOptions risk_options(const QaOptions& options, const Batch& batch, Bars& bars) {
  constexpr std::uint64_t most_panels = 20'000, fewest_lots = 200;
  const RiskOptions usual;
  const auto fitting = [&](std::uint64_t lots) {
    return std::clamp(most_panels / batch.plan.panels, std::min(lots, fewest_lots), lots);
  };
  return {.lots = options.risk_lots.value_or(fitting(usual.lots)),
          .lots_per_point = options.risk_lots.value_or(fitting(usual.lots_per_point)),
          .advance = [&bars](const char* work, std::size_t done, std::size_t total) {
            bars.show(work, done, total);
          }};
}

QaResult judged(const QaOptions& options, const Workplace& place, const StoredRun& run,
                Store& store) {
  Bars bars;
  Desk desk(place, store, run.record.id, bars);
  double surrogate_error = 0.0;
  if (run.record.kind == RunRecord::Kind::measured) {
    judge_measured(place, run.record, desk);
  } else {
    surrogate_error = simulate(place, run.record, desk, bars);
  }
  QaResult result = desk.result();
  result.run = run.record;
  result.store = store.url();
  result.surrogate_error = surrogate_error;
  if (options.risk_lots != 0U) {
    const RiskOptions risk = risk_options(options, place.batch, bars);
    if (run.record.kind == RunRecord::Kind::measured) {
      study_readings(place.batch, place.uncertainties, risk, result);
    } else {
      study_product(place.batch, place.observer, place.uncertainties, risk, result);
    }
  }
  return result;
}

void write_report(const QaOptions& options, const QaResult& result, const Store& store) {
  if (!options.report) {
    return;
  }
  const fs::path folder = *options.report;
  const std::string page = qa_page(result, GONIO_VERSION);
  fs::create_directories(folder);
  write_readings(folder / "readings.csv", store, result.run);
  write_text_file(folder / "qa.html", page);
  write_text_file(folder / "qa.json", qa_json(result));
  write_text_file(folder / "qa.txt", qa_text(result, false));
}

}  // namespace

ExitStatus run_qa(const QaOptions& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  const Workplace place = workplace(options, catalog);
  const RunRecord record = run_record(place, GONIO_VERSION);
  Store store(options.store);
  const StoredRun run = open_run(options, record, store);
  const QaResult result = judged(options, place, run, store);
  store.finish(run.record.id, result.outcome(utc_now()));
  write_report(options, result, store);
  if (options.format == "csv") {
    print_readings(store, run.record);
  } else {
    print(options.format == "json" ? qa_json(result) : qa_text(result, isatty(STDOUT_FILENO) != 0));
  }
  return result.verdict == ConformanceVerdict::pass ? done : does_not_conform;
}

}  // namespace gonio::app
