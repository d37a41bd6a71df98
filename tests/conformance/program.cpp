#include "tests/conformance/program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <deque>

#include "emulator/core/progress.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/core/today.hpp"
#include "tests/conformance/device_under_test.hpp"
#include "tests/conformance/run.hpp"
#include "tests/conformance/served_device.hpp"

namespace gonio::conformance {

namespace fs = std::filesystem;

namespace {

struct Options {
  std::vector<std::string> ids;
  DeviceOptions device;
  std::optional<std::string> data_dir;
  std::string decision = "guarded";
  std::string format = "text";
  std::optional<std::string> report_dir;
  std::uint64_t seed = 1;
  bool should_counts = false;
  bool lists = false;
  bool shows_coverage = false;
};

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
  }
}

/// What was asked for: a suite, and which part of it.
struct Selected {
  ConformanceSuite suite;
  std::string prefix;
};

std::vector<Selected> select(const Options& options, const Catalog& catalog) {
  std::vector<Selected> selected;
  for (const std::string& id : options.ids) {
    for (const SuiteSelection& selection : select_suites(id, catalog)) {
      ConformanceSuite suite = load_suite(selection.clauses_file, catalog);
      const bool is_there =
          std::any_of(suite.set.clauses.begin(), suite.set.clauses.end(), [&](const Clause& c) {
            const std::string address = suite.set.id + "/" + c.id;
            return is_selected(address, selection.prefix) || is_selected(selection.prefix, address);
          });
      if (!is_there) {
        throw std::invalid_argument(
            fmt::format("expected a clause of {}, see --list, found '{}'", suite.set.id, id));
      }
      selected.push_back({.suite = std::move(suite), .prefix = selection.prefix});
    }
  }
  return selected;
}

int list(const std::vector<Selected>& selected) {
  for (const auto& [suite, prefix] : selected) {
    for (const SuiteCase& entry : suite.cases) {
      if (is_selected(entry.address, prefix)) {
        const Case& stated = suite.case_of(entry);
        print(fmt::format("{:<75} {:<11} {:<6} {}\n", entry.address, role_name(stated.role),
                          suite.clause_of(entry).level, verdict_name(stated.expected)));
      }
    }
  }
  return conforms;
}

int show_coverage(std::vector<Selected> selected) {
  std::vector<ConformanceSuite> suites;
  for (Selected& one : selected) {
    suites.push_back(std::move(one.suite));
  }
  print(coverage_table(suites));
  return conforms;
}

/// A protocol is judged on a wire. Where it is one of several, its cases are skipped instead.
void expect_server(const std::vector<Selected>& selected, const DeviceOptions& device) {
  const bool is_about_glossmeters =
      std::any_of(selected.begin(), selected.end(),
                  [](const Selected& one) { return one.suite.set.standard.has_value(); });
  if (!is_about_glossmeters && !is_device_url(device.device)) {
    throw std::invalid_argument(fmt::format(
        "--device: expected a server, modbus://HOST[:PORT] or modbus-rtu:PATH, to judge "
        "by {}, found '{}'",
        selected.front().suite.set.id, device.device));
  }
}

/// GoogleTest reports to files that were asked for; what is printed is ours. Shows the progress.
class Watcher final : public testing::EmptyTestEventListener {
 public:
  void OnTestIterationStart(const testing::UnitTest& tests, int) override {
    progress_.emplace(std::size_t(tests.test_to_run_count()), "cases");
  }
  void OnTestEnd(const testing::TestInfo&) override { progress_->advance(); }
  void OnTestIterationEnd(const testing::UnitTest&, int) override { progress_.reset(); }

 private:
  std::optional<Progress> progress_;
};

void run_tests() {
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new Watcher);
  // Whether a test has failed is no news: the report tells, and what counts there counts here.
  [[maybe_unused]] const int failed = RUN_ALL_TESTS();
}

std::string written(const std::string& format, const ConformanceReport& report) {
  return format == "json"       ? conformance_json_lines(report)
         : format == "junit"    ? conformance_junit(report)
         : format == "markdown" ? conformance_markdown(report)
                                : conformance_text(report, isatty(STDOUT_FILENO) != 0);
}

void write_reports(const fs::path& folder, const ConformanceReport& report) {
  fs::create_directories(folder);
  write_text_file(folder / "results.jsonl", conformance_json_lines(report));
  write_text_file(folder / "junit.xml", conformance_junit(report));
  write_text_file(folder / "report.md", conformance_markdown(report));
  write_text_file(folder / "report.html", conformance_page(report));
}

/// The gravest of all; what could not be tried at all counts only if nothing else could either.
int status_of(const std::vector<ConformanceVerdict>& verdicts) {
  ConformanceVerdict gravest = ConformanceVerdict::not_applicable;
  for (const ConformanceVerdict verdict : verdicts) {
    gravest = worse(gravest, verdict);
  }
  switch (gravest) {
    case ConformanceVerdict::pass:
    case ConformanceVerdict::not_applicable:
      return conforms;
    case ConformanceVerdict::error:
      return environment_failed;
    default:
      return does_not_conform;
  }
}

/// One standard, tried on one device.
struct Trial {
  std::string prefix;  ///< of what was asked for
  DeviceUnderTest device;
  ConformanceRun run;
};

/// Reports go to a folder, or to one for each standard below it.
ConformanceVerdict tell(const Trial& trial, const Options& options, bool is_alone) {
  ConformanceReport report = trial.run.report(trial.prefix);
  if (options.report_dir || options.format == "json" || options.format == "markdown") {
    add_optics(report, trial.run.suite(), trial.device);
  }
  if (options.report_dir) {
    std::string name = report.standard_id;
    std::replace(name.begin(), name.end(), '/', '_');
    const fs::path folder = *options.report_dir;
    write_reports(is_alone ? folder : folder / name, report);
  }
  print(written(options.format, report));
  return report.verdict;
}

int run(std::vector<Selected> selected, const Options& options, const Catalog& catalog) {
  const RunOptions run_options{
      .rule = options.decision == "simple" ? DecisionRule::simple : DecisionRule::guarded,
      .should_counts = options.should_counts,
      .seed = options.seed,
      .version = GONIO_VERSION,
      .date = today()};
  std::deque<Trial> trials;  // the tests refer to them
  for (Selected& one : selected) {
    const DeviceUnderTest device = find_device(options.device, one.suite, options.seed, catalog);
    trials.push_back(
        {one.prefix, device, ConformanceRun(std::move(one.suite), device, run_options, catalog)});
    register_tests(trials.back().run, one.prefix);
  }
  run_tests();
  if (testing::GTEST_FLAG(list_tests)) {
    return conforms;
  }
  std::vector<ConformanceVerdict> verdicts;
  for (const Trial& trial : trials) {
    verdicts.push_back(tell(trial, options, trials.size() == 1));
  }
  return status_of(verdicts);
}

void add_options(CLI::App& program, Options& options) {
  program
      .add_option("ID", options.ids,
                  "A standard, one of its clauses, a family, or all: iso_2813/2014, "
                  "iso_2813/2014/geometry/receptor_60, modbus")
      ->required();
  add_device_options(program, options.device);
  program
      .add_option("--decision", options.decision,
                  "How uncertainty is taken into account at a limit")
      ->check(CLI::IsMember({"guarded", "simple"}))
      ->capture_default_str();
  program.add_flag("--should", options.should_counts,
                   "Clauses of level `should` count towards the verdict too");
  program.add_option("--format", options.format, "How the result is printed")
      ->check(CLI::IsMember({"text", "json", "junit", "markdown"}))
      ->capture_default_str();
  program.add_option("--report", options.report_dir,
                     "Folder for report.html, report.md, results.jsonl and junit.xml");
  program.add_option("--seed", options.seed, "Of the noise of a device in process")
      ->check(CLI::Range(std::uint64_t(0), std::uint64_t(1'000'000'000)))
      ->capture_default_str();
  program.add_flag("--list", options.lists, "Lists the cases and ends");
  program.add_flag("--coverage", options.shows_coverage,
                   "Prints how many clauses are covered, and how, and ends");
  program.add_option("--data", options.data_dir,
                     "Folder with standards and fixtures, searched first");
}

}  // namespace

int run_program(int argc, char** argv) {
  CLI::App program{"Judges a glossmeter, emulated or real, clause by clause", "gonio-conformance"};
  program.set_version_flag("--version", "gonio-conformance " GONIO_VERSION);
  Options options;
  add_options(program, options);
  program.footer(
      "Example: gonio-conformance iso_2813/2014 --device triangle_gloss --report out\n"
      "         gonio-conformance iso_2813/2014/geometry --device modbus://127.0.0.1:1502\n"
      "Exit status: 0 conforms, 1 does not conform or inconclusive, 2 bad input, 3 the device or "
      "the environment failed\n"
      "Options of GoogleTest, e.g. --gtest_filter and --gtest_output, work as usual.");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? conforms : bad_input;
  }
  const Catalog catalog = Catalog::standard_places(options.data_dir);
  std::vector<Selected> selected = select(options, catalog);
  if (options.lists) {
    return list(selected);
  }
  if (options.shows_coverage) {
    return show_coverage(std::move(selected));
  }
  expect_server(selected, options.device);
  return run(std::move(selected), options, catalog);
}

}  // namespace gonio::conformance
