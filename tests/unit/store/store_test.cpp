#include "emulator/store/store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/message_of.hpp"
#include "tests/unit/store/chunks.hpp"
#include "tests/unit/store/processes.hpp"
#include "tests/unit/store/scenario.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using testing::HasSubstr;
using Study = PanelRecord::Study;

class StoreOnSqlite : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  std::string url = "sqlite:" + (folder.path() / "qa.db").string();
};

TEST_F(StoreOnSqlite, DoesAllThatAStoreMust) { test::Scenario(url).runs(); }

TEST_F(StoreOnSqlite, ShowsItsUrl) { EXPECT_EQ(Store(url).url(), url); }

TEST_F(StoreOnSqlite, CanBeMoved) {
  Store store(url);
  const std::int64_t run = test::run_of(store);
  store.add(run, test::chunk(0));
  Store moved = std::move(store);
  moved.add(run, test::chunk(1));
  test::expect_panels(moved, run, test::chunks(2));
}

/// A panel that cannot be stored as it is takes its chunk with it, and nothing else.
TEST_F(StoreOnSqlite, RefusesWhatItCannotGiveBack) {
  Store store(url);
  const std::int64_t run = test::run_of(store);
  store.add(run, test::chunk(0));
  const auto message = [&](auto spoil) {
    std::vector<PanelRecord> panels = test::chunk(1);
    spoil(panels.back());
    return message_of([&] { store.add(run, panels); });
  };
  EXPECT_EQ(message([](PanelRecord& panel) { panel.readings[3].value = std::nan(""); }),
            "store: expected a number, found NaN");
  EXPECT_EQ(message([](PanelRecord& panel) { panel.channels[1].truth = std::nan(""); }),
            "store: expected a number, found NaN");
  EXPECT_EQ(message([](PanelRecord& panel) { panel.label = std::string("a\0b", 3); }),
            "store: expected a text without zero bytes");
  EXPECT_EQ(message([](PanelRecord& panel) { panel.lot = std::uint64_t{1} << 63U; }),
            "store: expected a number below 2^63, found 9223372036854775808");
  for (const std::string& text :
       {message([](PanelRecord& panel) { panel.number = 1; }),
        message([](PanelRecord& panel) { panel.readings[1] = panel.readings[0]; }),
        message([](PanelRecord& panel) { panel.channels[1].channel = 0; })}) {
    EXPECT_THAT(text, HasSubstr("something of it is there already (UNIQUE constraint failed"));
  }
  store.add(run, test::chunk(1));
  test::expect_panels(store, run, test::chunks(2));
}

TEST_F(StoreOnSqlite, TellsWhatInItIsDamaged) {
  Store store(url);
  const std::int64_t run = test::run_of(store);
  store.add(run, test::chunk(0));
  Database(url).session() << "UPDATE panel SET verdict = 'good' WHERE panel = 7";
  EXPECT_EQ(message_of([&] { test::panels_of(store, run, Study::inspection); }),
            "the store is damaged: expected a verdict, found 'good'");
  {
    Database database(url);
    database.session() << "PRAGMA foreign_keys = OFF";
    database.session() << "DELETE FROM panel WHERE panel = 7";
  }
  EXPECT_EQ(message_of([&] { test::panels_of(store, run, Study::inspection); }),
            "the store is damaged: panel 7 is missing, not what is on it");
  Database(url).session() << "UPDATE run SET seed = '-1'";
  EXPECT_EQ(message_of([&] { static_cast<void>(store.run(run)); }),
            "the store is damaged: expected a seed, found '-1'");
}

/// As a run that is resumed does while it reads what it has.
TEST_F(StoreOnSqlite, MayBeAddedToWhileItsPanelsAreRead) {
  Store store(url);
  const std::int64_t run = test::run_of(store);
  store.add(run, test::chunks(30));
  std::vector<PanelRecord> read;
  store.for_each_panel(run, Study::inspection, [&](const PanelRecord& panel) {
    if (read.empty()) {
      store.add(run, test::chunk(30));
    }
    read.push_back(panel);
  });
  EXPECT_EQ(read, test::chunks(31));
}

TEST_F(StoreOnSqlite, IsOfUseAfterItsReaderHasThrown) {
  Store store(url);
  const std::int64_t run = test::run_of(store);
  store.add(run, test::chunk(0));
  EXPECT_THROW(store.for_each_panel(run, Study::inspection,
                                    [](const PanelRecord&) { throw std::domain_error("enough"); }),
               std::domain_error);
  store.add(run, test::chunk(1));
  test::expect_panels(store, run, test::chunks(2));
}

TEST_F(StoreOnSqlite, TakesRunsOfTwoProgramsAtATime) {
  constexpr std::uint64_t chunks = 30;
  static_cast<void>(Store(url).runs());
  std::vector<pid_t> programs;
  for (int i = 0; i < 2; ++i) {
    programs.push_back(test::forked([&] {
      Store store(url);
      const std::int64_t run = store.begin({.batch = "both"});
      for (std::uint64_t k = 0; k < chunks; ++k) {
        store.add(run, test::chunk(k));
      }
      store.finish(run, {});
    }));
  }
  for (const pid_t program : programs) {
    EXPECT_EQ(test::wait_for(program), 0);
  }
  const Store store(url);
  const std::vector<StoredRun> runs = store.runs("both");
  ASSERT_EQ(runs.size(), 2U);
  for (const StoredRun& run : runs) {
    EXPECT_TRUE(run.outcome.has_value());
    test::expect_panels(store, run.record.id, test::chunks(chunks));
  }
}

}  // namespace
}  // namespace gonio
