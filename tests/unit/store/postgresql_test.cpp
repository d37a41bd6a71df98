#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <span>

#include "tests/unit/postgres_server.hpp"
#include "tests/unit/store/older_store.hpp"
#include "tests/unit/store/processes.hpp"
#include "tests/unit/store/scenario.hpp"

// Few tests, since each starts a server.

namespace gonio {
namespace {

using test::message_of;
using test::PostgresServer;
using test::RandomRecords;
using testing::HasSubstr;
using Study = PanelRecord::Study;

/// An empty database.
std::string made(const PostgresServer& server, const std::string& database) {
  Database(server.url()).session() << "CREATE DATABASE " + database;
  return server.url(database);
}

void expect_others_in_the_database_are_left_alone(const std::string& url) {
  Database(url).session() << "CREATE TABLE customers (id BIGINT)";
  EXPECT_NO_THROW(Store{url});
  EXPECT_NO_THROW(Database(url).session() << "SELECT id FROM customers");
}

/// The server tells, and nothing of the chunk is there.
void expect_text_must_be_unicode(const std::string& url) {
  Store store(url);
  const std::int64_t run = store.begin({.batch = "latin1"});
  std::vector<PanelRecord> panels = RandomRecords(3).panels(Study::inspection, 1, 2);
  panels.back().label =
      "Pr\xFC"
      "ftafel";
  EXPECT_THAT(message_of([&] { store.add(run, panels); }),
              HasSubstr(": the server refuses (invalid byte sequence for encoding \"UTF8\""));
  EXPECT_EQ(store.panels(run, Study::inspection), 0U);
}

void expect_made_once_by_many(const std::string& url) {
  test::Pipe gate;
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i) {
    children.push_back(test::forked([&] {
      gate.close_writing();
      gate.wait_for_end();
      Store{url};
    }));
  }
  gate.close_writing();
  for (const pid_t child : children) {
    EXPECT_EQ(test::wait_for(child), 0);
  }
}

TEST(PostgresqlStore, DoesAllThatAStoreMust) {
  const PostgresServer server;
  test::Scenario(server.url()).runs();
  test::expect_older_store_goes_on(made(server, "older"));
  test::expect_newer_store_is_refused(made(server, "newer"));
  expect_others_in_the_database_are_left_alone(made(server, "shared"));
  expect_text_must_be_unicode(made(server, "unicode"));
  expect_made_once_by_many(made(server, "many"));
  EXPECT_THAT(message_of([&] { Store{server.url("nowhere")}; }),
              HasSubstr("no connection (connection to server on socket"));
}

/// A server that ends between two chunks, in order or not: the store says so, the chunks before are
/// there when it is back, and the run goes on.
void expect_going_on_after(PostgresServer& server, const std::string& url, int signal) {
  RandomRecords random(1701);
  const std::vector<PanelRecord> panels = random.panels(Study::inspection, 1, 900);
  const auto chunk = [&](std::size_t i) { return std::span(panels).subspan(300 * i, 300); };
  RunRecord run = random.run("coil", "lost");
  Store store(url);
  run.id = store.begin(run);
  store.add(run.id, chunk(0));
  server.stop(signal);
  for (int tries = 0; tries < 2; ++tries) {
    const std::string message = message_of([&] { store.add(run.id, chunk(1)); });
    EXPECT_THAT(message, testing::StartsWith(url + ": the server closed the connection"));
  }
  EXPECT_THROW(static_cast<void>(store.runs()), StoreError);
  EXPECT_THAT(message_of([&] { Store{url}; }), HasSubstr(": no connection ("));
  server.start();
  Store again(url);
  EXPECT_EQ(again.unfinished("lost")->record, run);
  test::expect_panels(again, run.id, {panels.begin(), panels.begin() + 300});
  again.add(run.id, chunk(1));
  again.add(run.id, chunk(2));
  test::expect_panels(again, run.id, panels);
  again.finish(run.id, random.outcome());
}

TEST(PostgresqlStore, GoesOnAfterTheServerWasLost) {
  PostgresServer server;
  expect_going_on_after(server, server.url(), SIGINT);
  expect_going_on_after(server, server.url(), SIGQUIT);
}

}  // namespace
}  // namespace gonio
