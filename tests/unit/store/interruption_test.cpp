#include <gtest/gtest.h>
#include <time.h>

#include <csignal>
#include <random>

#include "tests/unit/store/chunks.hpp"
#include "tests/unit/store/processes.hpp"
#include "tests/unit/temporary_folder.hpp"
#include "tests/unit/trials.hpp"

namespace gonio {
namespace {

using test::Pipe;

/// Without sleeping: whoever waits for so short a time keeps its processor.
void wait_us(long us) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * 1000000 + time.tv_nsec / 1000;
  };
  for (const long end = now() + us; now() < end;) {
  }
}

/// Goes on with the run, and tells each chunk that is there, until it is killed.
void add_for_ever(const std::string& url, const Pipe& pipe) {
  Store store(url);
  const std::int64_t run = test::run_of(store);
  for (std::uint64_t i = test::whole_chunks(url, run);; ++i) {
    store.add(run, test::chunk(i));
    pipe.write(i + 1);
  }
}

/// Kills it some time after it has told so many chunks. @return  how many it has told of.
std::uint64_t told_until_killed(const std::string& url, std::uint64_t chunks, long after_us) {
  Pipe pipe;
  const pid_t child = test::forked([&] { add_for_ever(url, pipe); });
  pipe.close_writing();
  std::uint64_t told = 0;
  for (std::uint64_t i = 0; i < chunks; ++i) {
    EXPECT_TRUE(pipe.read(told));
  }
  wait_us(after_us);
  kill(child, SIGKILL);
  EXPECT_EQ(test::wait_for(child), 128 + SIGKILL);
  for (std::uint64_t number = 0; pipe.read(number);) {
    told = number;
  }
  return told;
}

TEST(InterruptedStore, LosesAndDoublesNothingWhenKilledAtAnyMoment) {
  // Seed and moments: from before the store is made to the midst of a commit or checkpoint.
  std::mt19937 random(424242);
  std::uniform_int_distribution<std::uint64_t> chunks_to_wait_for(0, 3);
  std::uniform_int_distribution<long> delay_us(0, 6000);
  const test::TemporaryFolder folder;
  const std::string url = "sqlite:" + (folder.path() / "qa.db").string();
  std::uint64_t there = 0;
  for (std::size_t i = 0; i < test::trials(50); ++i) {
    const std::uint64_t told = told_until_killed(url, chunks_to_wait_for(random), delay_us(random));
    Store store(url);
    const std::uint64_t found = test::whole_chunks(url, test::run_of(store));
    ASSERT_GE(found, std::max(told, there)) << "kill " << i;
    // One more may be there: committed, and killed before it was told.
    ASSERT_LE(found, std::max(told, there) + 1) << "kill " << i;
    there = found;
  }
  Store store(url);
  const std::int64_t run = test::run_of(store);
  store.add(run, test::chunk(there));
  test::expect_panels(store, run, test::chunks(there + 1));
  EXPECT_EQ(store.runs().size(), 1U);
}

}  // namespace
}  // namespace gonio
