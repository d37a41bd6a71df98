#include "emulator/store/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/message_of.hpp"
#include "tests/unit/store/older_store.hpp"
#include "tests/unit/store/processes.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

std::string url_in(const TemporaryFolder& folder, const std::string& name = "qa.db") {
  return "sqlite:" + (folder.path() / name).string();
}

TEST(Schema, OfAnOlderStoreIsBroughtUpWithItsData) {
  const TemporaryFolder folder;
  test::expect_older_store_goes_on(url_in(folder));
}

TEST(Schema, OfANewerStoreIsRefused) {
  const TemporaryFolder folder;
  test::expect_newer_store_is_refused(url_in(folder));
}

TEST(Schema, ThatFailsHalfWayLeavesTheVersionBefore) {
  const TemporaryFolder folder;
  Database database(url_in(folder));
  std::vector<Migration> steps(migrations().begin(), migrations().end());
  steps.push_back({"CREATE TABLE half (id BIGINT)", "CREATE TABLE run (id BIGINT)"});
  EXPECT_THAT(message_of([&] { migrate(database, steps); }), HasSubstr("already exists"));
  long long tables = 0;
  database.session() << "SELECT count(*) FROM sqlite_master WHERE name = 'half'",
      soci::into(tables);
  EXPECT_EQ(tables, 0);
  EXPECT_NO_THROW(Store{url_in(folder)});
}

TEST(Schema, OfAnotherDatabaseIsRefusedAndLeftAlone) {
  const TemporaryFolder folder;
  Database(url_in(folder)).session() << "CREATE TABLE customers (id BIGINT)";
  const std::string before = test::contents(folder.path() / "qa.db");
  EXPECT_EQ(message_of([&] { Store{url_in(folder)}; }),
            url_in(folder) + ": not a store of gonio: it holds tables of something else");
  EXPECT_EQ(test::contents(folder.path() / "qa.db"), before);
}

TEST(Schema, OfAFileThatIsNoDatabaseIsRefusedAndLeftAlone) {
  const TemporaryFolder folder;
  const std::string text(5000, 'x');
  const auto path = folder.file("qa.db", text);
  EXPECT_THAT(message_of([&] { Store{url_in(folder)}; }),
              HasSubstr("not a database of SQLite, so no store of gonio"));
  EXPECT_EQ(test::contents(path), text);
}

TEST(Schema, IsMadeInAnEmptyFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(test::contents(folder.file("qa.db", "")), "");
  EXPECT_NO_THROW(Store{url_in(folder)});
}

TEST(Schema, IsMadeOnceByManyProgramsAtATime) {
  constexpr int programs = 8;
  const TemporaryFolder folder;
  test::Pipe gate;
  std::vector<pid_t> children;
  for (int i = 0; i < programs; ++i) {
    children.push_back(test::forked([&] {
      gate.close_writing();
      gate.wait_for_end();
      Store{url_in(folder)};
    }));
  }
  gate.close_writing();
  for (const pid_t child : children) {
    EXPECT_EQ(test::wait_for(child), 0);
  }
  EXPECT_NO_THROW(Store{url_in(folder)});
}

}  // namespace
}  // namespace gonio
