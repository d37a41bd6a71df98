// `gonio qa` as its user runs it: panels of 6 readings at three geometries, simulated, judged and
// stored in an SQLite file, risks and answers included.

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "tests/unit/temporary_folder.hpp"

namespace gonio::bench {
namespace {

struct Cost {
  double seconds = 0.0;
  double peak_mib = 0.0;
};

std::string batch_of(int lots) {
  return fmt::format(
      "schema: gonio/batch/1\nid: large\ntitle: Large\nstandard: iso_2813/2014\n"
      "product:\n  sample: black_semi_gloss\n"
      "  spread: {{roughness: {{lots: 0.01, panels: 0.008, within_panel: 0.006}}}}\n"
      "  correlation_length: 20 mm\n"
      "specification: {{gloss: {{20 deg: \">= 5 GU\", 60 deg: 52 +- 4 GU, 85 deg: \">= 10 "
      "GU\"}}}}\n"
      "sampling: {{lots: {}, panels: 100, positions: 6}}\n"
      "measuring: {{instruments: [triangle_gloss], operators: [anna, ben]}}\n",
      lots);
}

Cost run(int lots) {
  const test::TemporaryFolder folder;
  const std::string batch = folder.file("large.yaml", batch_of(lots)).string();
  std::vector<std::string> words{
      GONIO_PROGRAM, "qa",  batch, "--store", "sqlite:" + (folder.path() / "qa.db").string(),
      "--format",    "json"};
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const auto start = std::chrono::steady_clock::now();
  pid_t process = 0;
  int status = 0;
  rusage usage{};
  if (posix_spawn(&process, GONIO_PROGRAM, &actions, nullptr, arguments.data(), environ) != 0 ||
      wait4(process, &status, 0, &usage) != process || status != 0) {
    throw std::runtime_error("gonio qa failed");
  }
  posix_spawn_file_actions_destroy(&actions);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          double(usage.ru_maxrss) / 1024.0};
}

void hundred_thousand_panels(benchmark::State& state) {
  constexpr double at_most_s = 60.0, at_most_growth = 1.2;
  Cost tenth, all;
  for (auto _ : state) {
    tenth = run(100);
    all = run(1000);
    state.SetIterationTime(all.seconds);
  }
  state.counters["peak_mib"] = all.peak_mib;
  state.counters["peak_of_ten_times_the_panels"] = all.peak_mib / tenth.peak_mib;
  state.counters["readings_per_s"] = 1.8e6 / all.seconds;
  const bool met = all.seconds < at_most_s && all.peak_mib < at_most_growth * tenth.peak_mib;
  state.SetLabel(met ? "met" : "missed");
}
BENCHMARK(hundred_thousand_panels)->UseManualTime()->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace gonio::bench
