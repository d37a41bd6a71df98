#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "emulator/store/store.hpp"
#include "tests/system/program.hpp"
#include "tests/system/qa_batches.hpp"
#include "tests/unit/postgres_server.hpp"

namespace gonio {

namespace {

using test::Outcome;
using test::Program;
using testing::HasSubstr;
using Study = PanelRecord::Study;

constexpr std::uint64_t panels = 60'000;

/// A batch of so many panels, in the program's folder.
std::string large_batch(const Program& program) {
  return program
      .file("large.yaml", test::batch_text({.sampling = "{lots: 6000, panels: 10, positions: 3}"}))
      .string();
}

std::vector<std::string> arguments(const std::string& batch, const std::string& store,
                                   const std::vector<std::string>& more) {
  return test::with({"qa", batch, "--store", store, "--risk-lots", "0", "--format", "json"}, more);
}

/// What has to be the same after all that may happen on the way.
nlohmann::json numbers_of(const Outcome& outcome) {
  nlohmann::json result = nlohmann::json::parse(outcome.out);
  for (const char* key : {"store", "run", "provenance"}) {
    result.erase(key);
  }
  return result;
}

/// Runs the program until its run has so many panels, then ends it. Nobody sleeps: the store is
/// asked again and again.
/// @param end  of the world: called with the process, returns its status.
template <class End>
int run_until(const Program& program, const std::vector<std::string>& command,
              const std::function<std::uint64_t()>& stored, std::uint64_t enough, End end) {
  const int nowhere = open("/dev/null", O_WRONLY);
  const pid_t process = program.start(command, nowhere);
  close(nowhere);
  int status = 0;
  while (stored() < enough && waitpid(process, &status, WNOHANG) == 0) {
    sched_yield();
  }
  return stored() < enough ? -1 : end(process);
}

}  // namespace

// Killed at fifty moments, each as soon as the store has a random number of panels more.
TEST(QaResume, LosesAndDoublesNothingWhenKilled) {
  constexpr int kills = 50;
  constexpr std::uint64_t seed = 50;
  const Program program;
  const std::string batch = large_batch(program);
  const std::string url = "sqlite:" + (program.folder() / "killed.db").string();
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::uint64_t> step(1, panels / kills / 3);
  std::unique_ptr<Store> store = std::make_unique<Store>(url);  // it is there before any run
  std::uint64_t enough = 1;
  const auto stored = [&] {
    const auto runs = store->runs();
    return runs.empty() ? 0 : store->panels(runs.front().record.id, Study::inspection);
  };
  int killed = 0;
  for (int i = 0; i < kills && enough < panels; ++i, enough = stored() + step(random)) {
    const std::uint64_t before = stored();
    const int status = run_until(
        program,
        arguments(batch, url,
                  i == 0 ? std::vector<std::string>{} : std::vector<std::string>{"--resume"}),
        stored, std::min(enough, panels), [](pid_t process) {
          kill(process, SIGKILL);
          return Program::wait(process);
        });
    EXPECT_GE(stored(), before) << "a panel was lost";
    killed += status == 128 + SIGKILL ? 1 : 0;
  }
  EXPECT_GE(killed, kills - 5) << "the run was too short to be killed often";
  const Outcome resumed = program.run(arguments(batch, url, {"--resume"}));
  ASSERT_EQ(resumed.err, "");
  const Outcome at_once = program.run(arguments(batch, "sqlite:at_once.db", {}));
  EXPECT_EQ(numbers_of(resumed), numbers_of(at_once));
  EXPECT_EQ(store->runs().size(), 1U);
  EXPECT_EQ(store->panels(1, Study::inspection), panels);
  EXPECT_EQ(program.run({"qa", "verify", "1", "--store", url}).status, 0);
}

TEST(QaResume, GoesOnAfterPostgresqlWasLost) {
  test::PostgresServer server;
  const Program program;
  const std::string batch = large_batch(program);
  const auto first = arguments(batch, server.url(), {});
  auto store = std::make_unique<Store>(server.url());
  const auto stored = [&]() -> std::uint64_t {
    const auto runs = store->runs();
    return runs.empty() ? 0 : store->panels(runs.front().record.id, Study::inspection);
  };
  std::uint64_t kept = 0;
  const int status = run_until(program, first, stored, 2000, [&](pid_t process) {
    kept = stored();
    store.reset();
    server.stop(SIGQUIT);
    return Program::wait(process);
  });
  EXPECT_EQ(status, 3);
  server.start();
  store = std::make_unique<Store>(server.url());
  EXPECT_GE(stored(), kept) << "a panel was lost";
  EXPECT_LT(stored(), panels);
  const Outcome resumed = program.run(arguments(batch, server.url(), {"--resume"}));
  ASSERT_EQ(resumed.err, "");
  const Outcome at_once = program.run(arguments(batch, "sqlite:at_once.db", {}));
  EXPECT_EQ(numbers_of(resumed), numbers_of(at_once)) << "and both databases say the same";
  EXPECT_EQ(stored(), panels);
  EXPECT_EQ(program.run({"qa", "verify", "1", "--store", server.url()}).status, 0);
}

TEST(QaResume, ALostServerIsTold) {
  const Program program;
  const Outcome outcome =
      program.run(arguments("coil_coating_60", "postgresql://gonio@/qa?host=/nowhere", {}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("/nowhere"));
  EXPECT_EQ(outcome.out, "");
}

// A disk of 300 blocks of 1024 bytes, as far as this program is concerned.
TEST(QaResume, GoesOnAfterTheDiskWasFull) {
  const Program program;
  const std::string batch = large_batch(program);
  const Program shell("/bin/bash");
  std::string command = "trap '' XFSZ; ulimit -f 3000; exec " GONIO_PROGRAM;
  const std::string url = "sqlite:" + (program.folder() / "full.db").string();
  for (const std::string& word : arguments(batch, url, {})) {
    command += " '" + word + "'";
  }
  const Outcome full = shell.run({"-c", command});
  EXPECT_EQ(full.status, 3);
  EXPECT_THAT(full.err, HasSubstr("no room"));
  EXPECT_EQ(full.out, "");
  const Outcome resumed = program.run(arguments(batch, url, {"--resume"}));
  ASSERT_EQ(resumed.err, "");
  EXPECT_EQ(nlohmann::json::parse(resumed.out).at("panels"), panels);
  EXPECT_EQ(program.run({"qa", "verify", "1", "--store", url}).status, 0);
}

TEST(QaResume, SaysThatAStoppedRunIsThere) {
  const Program program;
  const std::string batch = large_batch(program);
  const std::string url = "sqlite:" + (program.folder() / "qa.db").string();
  const Store store(url);
  const auto stored = [&]() -> std::uint64_t {
    return store.runs().empty() ? 0 : store.panels(1, Study::inspection);
  };
  ASSERT_EQ(run_until(program, arguments(batch, url, {}), stored, 1,
                      [](pid_t process) {
                        kill(process, SIGINT);
                        return Program::wait(process);
                      }),
            128 + SIGINT);
  const Outcome anew = program.run(arguments(batch, url, {}));
  EXPECT_THAT(anew.err, HasSubstr("run 1 of this batch was stopped; --resume would go on with it"));
  EXPECT_EQ(store.panels(2, Study::inspection), panels);
}

}  // namespace gonio
