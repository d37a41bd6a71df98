#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/store/panel_rows.hpp"
#include "emulator/store/run_rows.hpp"
#include "emulator/store/schema.hpp"
#include "emulator/store/store.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/store/random_records.hpp"
#include "tests/unit/store/same_records.hpp"

// Stores of other versions, in any database. Each is made in an empty one.

namespace gonio::test {

/// A run in a store of version 1, which knows no outcomes, is there in this version, and goes on.
inline void expect_older_store_goes_on(const std::string& url) {
  RandomRecords random(4711);
  RunRecord run = random.run("coil", "f1");
  std::vector<PanelRecord> panels = random.panels(PanelRecord::Study::inspection, 1, 100);
  {
    Database database(url);
    migrate(database, migrations().first(1));
    EXPECT_THROW(database.guarded([&] { database.session() << "SELECT run FROM run_outcome"; }),
                 StoreError);
    database.transaction(Database::Access::write, [&] {
      run.id = insert_run(database.session(), run);
      PanelWriter(database.session()).write(run.id, panels);
    });
  }
  Store store(url);
  EXPECT_EQ(store.unfinished("f1")->record, run);
  expect_panels(store, run.id, panels);
  const std::vector<PanelRecord> more = random.panels(PanelRecord::Study::inspection, 101, 3);
  store.add(run.id, more);
  panels.insert(panels.end(), more.begin(), more.end());
  const RunOutcome outcome = random.outcome();
  store.finish(run.id, outcome);
  const Store again(url);
  expect_panels(again, run.id, panels);
  EXPECT_TRUE(is_same(*again.run(run.id).outcome, outcome));
}

inline void expect_newer_store_is_refused(const std::string& url) {
  {
    Database database(url);
    std::vector<Migration> steps(migrations().begin(), migrations().end());
    steps.push_back({"CREATE TABLE of_the_future (id {counted_key})"});
    migrate(database, steps);
  }
  EXPECT_THAT(message_of([&] { Store{url}; }),
              testing::EndsWith("the store is of version 3, newer than this gonio, which knows 2"));
}

}  // namespace gonio::test
