#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "tests/unit/message_of.hpp"
#include "tests/unit/store/chunks.hpp"
#include "tests/unit/store/processes.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr rlim_t room_in_bytes = 2 << 20;

/// No file of this process grows beyond the room.
void limit_files() {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{room_in_bytes, RLIM_INFINITY};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

void lift_limit() {
  const rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

/// A file system of that size in the folder, for this process alone.
/// @return  whether that is permitted here: it is for root.
bool mount_small_disk(const std::string& folder) {
  return unshare(CLONE_NEWNS) == 0 &&
         mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("none", folder.c_str(), "tmpfs", 0, "size=2m") == 0;
}

/// Adds until there is no room. @return  how many chunks went in.
std::uint64_t fill(Store& store, std::int64_t run) {
  for (std::uint64_t i = 0; i < 10000; ++i) {
    try {
      store.add(run, test::chunk(i));
    } catch (const StoreError& error) {
      EXPECT_THAT(error.what(), StartsWith(store.url() + ": no room left"));
      return i;
    }
  }
  ADD_FAILURE() << "there is room without end";
  return 0;
}

/// All that is expected of a store without room, by the process that fills it and by the next one.
void expect_intact_when_full(const std::string& url) {
  Store store(url);
  const std::int64_t run = test::run_of(store);
  const std::uint64_t added = fill(store, run);
  EXPECT_GT(added, 1U);
  EXPECT_THAT(test::message_of([&] { store.add(run, test::chunk(added)); }),
              HasSubstr("no room left"));
  test::expect_panels(store, run, test::chunks(added));
  test::expect_panels(Store(url), run, test::chunks(added));
  EXPECT_EQ(test::whole_chunks(url, run), added);
}

/// Runs it in a process of its own, whose failed expectations are failures here.
template <class Work>
void expect_in_child(Work&& work) {
  EXPECT_EQ(test::wait_for(test::forked([&] {
              work();
              std::fflush(stdout);
              _exit(testing::Test::HasFailure() ? 2 : 0);
            })),
            0);
}

TEST(FullDisk, LeavesTheStoreIntactWhenItsFileMayNotGrow) {
  const test::TemporaryFolder folder;
  const std::string url = "sqlite:" + (folder.path() / "qa.db").string();
  expect_in_child([&] {
    limit_files();
    expect_intact_when_full(url);
  });
  // With room again the run goes on.
  Store store(url);
  const std::int64_t run = test::run_of(store);
  const std::uint64_t there = test::whole_chunks(url, run);
  store.add(run, test::chunk(there));
  test::expect_panels(store, run, test::chunks(there + 1));
}

/// On a disk of 2 MiB where one may be mounted, else as above.
TEST(FullDisk, LeavesTheStoreIntact) {
  const test::TemporaryFolder folder;
  const std::string url = "sqlite:" + (folder.path() / "qa.db").string();
  expect_in_child([&] {
    const bool small = mount_small_disk(folder.path().string());
    if (!small) {
      limit_files();
    }
    expect_intact_when_full(url);
    // A report can still be had from it, and it goes on in the same process.
    if (small) {
      ASSERT_EQ(mount("none", folder.path().c_str(), "tmpfs", MS_REMOUNT, "size=8m"), 0);
    } else {
      lift_limit();
    }
    Store store(url);
    const std::int64_t run = test::run_of(store);
    const std::uint64_t there = test::whole_chunks(url, run);
    store.add(run, test::chunk(there));
    test::expect_panels(store, run, test::chunks(there + 1));
  });
}

}  // namespace
}  // namespace gonio
